# figures/stability/stability.gp -- Chapter 14: the stability map, and growth outside it.
# Input: figures/stability/stability.c. Output: figures/stability/stability.svg.
width = 920; height = 450
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.085,0.985,0.125,0.92 spacing 0.10

set title "The largest stable damping"
set xlabel "α"
set ylabel "R = ρ h^{2−2α} / m"
set xrange [0:1]
set yrange [0:4.4]
set key top right
set label 1 "unstable" at 0.62,3.0 textcolor rgb "#555555"
set label 2 "stable for both κ" at 0.06,0.5 textcolor rgb "#555555"
plot dat index 0 using 1:3 with lines ls 1 title "4^{1−α}: κ = 1/2, any W", \
     '' index 0 using 1:2 with points ls 1 ps 0.9 title "measured", \
     '' index 0 using 1:5 with lines ls 2 title "(4 − W)/4^α: κ = 0, W = 1", \
     '' index 0 using 1:4 with points ls 2 ps 0.8 title "measured"
unset label 1
unset label 2

set title "Growth a step outside, κ = 1/2, W = 1"
set xlabel "R / bound"
set ylabel "|x_{k+1} / x_k|"
set xrange [1:1.205]
set yrange [1:*]
set key top left
plot for [i=1:3] dat index i using 1:3 with lines ls i title sprintf("1/|z|, α = %.2f", i / 4.0), \
     for [i=1:3] '' index i using 1:2 with points ls i ps 0.9 title "measured"
unset multiplot
