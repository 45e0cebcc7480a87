# figures/control/control.gp -- H 25: the least force that brings a spring to rest, and the least torque that swings
# up a pendulum.
# Input: figures/control/control.c. Output: figures/control/control.svg.
width = 900; height = 440
load 'figures/style.gp'
set xlabel "t"
set multiplot layout 1,2 margins 0.055,0.985,0.12,0.91 spacing 0.07
set title "to rest at T = 10, and afterwards"
set key top right # no names at the curves, because they cross
set xrange [0:20]
set yrange [-0.25:0.35]
set arrow 1 from 10,-0.25 to 10,0.35 nohead lc rgb "#888888" lw 0.8
plot dat index 0 using 1:2 with lines ls 1 title "x", \
     dat index 1 using 1:2 with lines ls 1 dt (8,4) title "x, let go", \
     dat index 0 using 1:3 with lines ls 2 dt 1 title "the least force", \
     dat index 2 using 1:2 with lines ls 2 dt (4,3) title "the force that holds"
unset arrow 1
set title "a pendulum, from hanging to standing"
set key bottom right # no names at the curves, because they cross
set xrange [0:16]
set yrange [-1:1.25]
set label 1 "standing" at 0.4,1.06 left tc rgb "#666666" font ",12"
set arrow 2 from 0,1 to 16,1 nohead lc rgb "#888888" lw 0.8
plot dat index 3 using 1:2 with lines ls 1 title "x / π", \
     dat index 3 using 1:3 with lines ls 2 dt 1 title "the least torque"
unset multiplot
