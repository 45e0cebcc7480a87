# figures/fvi/fvi_kick.gp -- H 9: a run from x(0) = 1 with four steps.
# Input: figures/fvi/fvi_kick.c. Output: figures/fvi/fvi_kick.svg.
width = 900; height = 380
load 'figures/style.gp'
array h[4]
do for [i=1:4] {
    stats dat index i-1 using 1 name "H" nooutput
    h[i] = H_min
}
set xrange [0:15]
set xlabel "t"
set multiplot layout 1,2 margins 0.065,0.985,0.15,0.89 spacing 0.06
unset key

set title "as printed, the damping acts on x"
set label 1 "h = 0.004" at 2.6,14.5 tc rgb BLUE
set label 2 "0.02" at 4.9,-5.6 tc rgb RED
set label 3 "0.1" at 4.9,-2.6 tc rgb GREEN
set ylabel "x" offset 1,0
set yrange [-16:16]
plot for [i=1:4] dat index i-1 using 2:3 with lines ls 5-i

set title "held, on x − x_{0}; ten times the scale"
unset label
set label 1 "h = 0.5" at 9.6,0.55 tc rgb PINK
set label 2 "0.1, 0.02, 0.004" at 9.2,0.9 tc rgb BLUE
unset ylabel
set yrange [-1.6:1.6]
plot for [i=1:4] dat index i-1 using 2:4 with lines ls 5-i
unset multiplot
