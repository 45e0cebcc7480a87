# figures/response/response_paths.gp -- H 30: the paths of the poles of three storeys as a damper grows.
# Input: figures/response/response_paths.c. Output: figures/response/response_paths.svg.
width = 900; height = 460
load 'figures/style.gp'
set multiplot layout 1,2
unset key
set title "the three poles while ρ grows from 0"
set xlabel "Re s"
set ylabel "Im s"
set xrange [-1.1:0.25]
set yrange [0:2.6]
set label 1 "no damper" at 0.03, 1.25 tc rgb "#222222"
set label 2 "floor held" at 0.03, 0.62 tc rgb "#222222"
set label 3 "ρ = 1" at -0.16, 0.50 right tc rgb "#222222"
set label 4 "first" at -0.02, 0.28 right tc rgb BLUE
set label 5 "second" at -0.17, 1.25 right tc rgb RED
set label 6 "third" at -0.45, 2.28 left tc rgb GREEN
plot for [i=0:2] dat index i using 2:3 with lines ls i+1, \
     '' index 3 using 2:3 with points pt 6 ps 0.9 lc rgb "#000000", \
     '' index 4 using 2:3 with points pt 7 ps 0.7 lc rgb "#000000"
set title "their damping ratios"
set logscale x
set format x "10^{%T}"
set xlabel "ρ"
set ylabel "−Re s / |s|"
unset label
set xrange [1e-3:1e3]
set yrange [0:0.55]
set label 1 "third" at 2.6,0.4 right tc rgb GREEN
set label 2 "second" at 0.7,0.095 right tc rgb RED
set label 3 "first" at 9,0.06 left tc rgb BLUE
plot for [i=0:2] dat index i using 1:4 with lines ls i+1
unset multiplot
