# figures/stability/stability_explicit.gp -- H 14: the stable steps of Euler's explicit method.
# Input: figures/stability/stability_explicit.c. Output: figures/stability/stability_explicit.svg.
width = 620; height = 420
load 'figures/style.gp'
set title "Euler's explicit method: a step must be damped enough, and not too much"
set xlabel "hω"
set ylabel "R = ρ h / m"
set xrange [0:2.4]
set yrange [0:4.4]
unset key
set label 4 "R = h^2ω^2" at 1.24,1.15 left tc rgb BLUE
set label 5 "R = 2 + h^2ω^2/2" at 0.75,2.65 right tc rgb RED
set label 6 "fvi, lda: R = 2, whatever hω is" at 2.35,1.85 right tc rgb "#606060"
set label 7 "marks: measured" at 2.35,0.2 right tc rgb "#222222"
set label 1 "decays" at 0.75,1.3 textcolor rgb "#555555"
set label 2 "swings up" at 1.86,2.6 textcolor rgb "#555555"
set label 3 "alternates" at 0.5,3.2 textcolor rgb "#555555"
plot dat index 0 using 1:2 with lines ls 1, \
     '' index 0 using 1:3 with lines ls 2, \
     '' index 1 using 1:2 with points ls 1 ps 0.9, \
     '' index 1 using 1:3 with points ls 2 ps 0.9, \
     2 with lines ls 8
