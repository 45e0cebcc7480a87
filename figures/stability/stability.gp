# figures/stability/stability.gp -- H 14: the largest stable step of fvi, and the growth beyond it.
# Input: figures/stability/stability.c. Output: figures/stability/stability.svg.
width = 920; height = 450
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.085,0.985,0.125,0.92 spacing 0.10

set title "The largest stable damping"
set xlabel "α"
set ylabel "R = ρ h^{2−2α} / m"
set xrange [0:1]
set yrange [0:4.4]
unset key
set label 3 "κ = 1/2, any W: 4^{1−α}" at 0.34,2.75 tc rgb BLUE
set label 4 "κ = 0, W = 1: (4 − W) / 4^α" at 0.02,1.35 tc rgb RED
set label 5 "marks: measured" at 0.98,4.1 right tc rgb "#222222"
set label 1 "unstable" at 0.68,3.3 textcolor rgb "#555555"
set label 2 "stable for both κ" at 0.06,0.5 textcolor rgb "#555555"
plot dat index 0 using 1:3 with lines ls 1, \
     '' index 0 using 1:2 with points ls 1 ps 0.9, \
     '' index 0 using 1:5 with lines ls 2, \
     '' index 0 using 1:4 with points ls 2 ps 0.8
unset label

set title "Growth a step outside, κ = 1/2, W = 1"
set xlabel "R / bound"
set ylabel "|x_{k+1} / x_k|"
set xrange [1:1.205]
set yrange [1:*]
set label 1 "α = 1/4" at 1.13,1.53 right tc rgb BLUE
set label 2 "1/2" at 1.15,1.345 right tc rgb RED
set label 3 "3/4" at 1.17,1.19 left tc rgb GREEN
set label 4 "lines: 1/|z_*|, marks: measured" at 1.01,1.67 tc rgb "#222222"
plot for [i=1:3] dat index i using 1:3 with lines ls i, \
     for [i=1:3] '' index i using 1:2 with points ls i ps 0.9
unset multiplot
