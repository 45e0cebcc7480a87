# figures/stability/stability_stages.gp -- H 14: the stable steps of fvi-lobatto3 with friction.
# Input: figures/stability/stability_stages.c. Output: figures/stability/stability_stages.svg.
width = 620; height = 360
load 'figures/style.gp'
set title "fvi-lobatto3, α = 1/2: friction closes the gap"
set xlabel "hω"
set ylabel "R = ρ h / m"
set xrange [2:5.8]
set yrange [0:1]
unset key
set label 1 "alternates" at 3.15,0.12 center textcolor rgb "#555555"
set label 2 "decays" at 4.2,0.5 center textcolor rgb "#555555"
set label 3 "grows, one sign" at 5.0,0.5 left textcolor rgb "#555555"
set label 4 "(h^2ω^2 − 8)(h^2ω^2 − 12) + 8R^2 = 0" at 3.15,0.82 center tc rgb RED
set label 5 "h^2ω^2 = 24" at 4.85,0.93 right tc rgb BLUE
set label 6 "marks: measured" at 4.8,0.06 right tc rgb "#222222"
set arrow 1 from sqrt(24),0 to sqrt(24),1 nohead lc rgb BLUE lw 1.8
plot dat index 0 using 1:2 with lines ls 2, \
     '' index 1 using 1:2 with points ls 2 ps 0.8, \
     '' index 2 using 1:2 with points ls 1 ps 0.9
