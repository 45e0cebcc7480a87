# figures/past/past.gp -- H 19: four pasts and the motions that follow them.
# Input: figures/past/past.c. Output: figures/past/past.svg.
width = 900; height = 420
load 'figures/style.gp'
set xlabel "t"
set xrange [-4:12]
set yrange [-1.1:1.9]
set arrow 1 from 0,-1.1 to 0,1.9 nohead lc rgb "#888888" lw 0.8
set multiplot layout 1,2 margins 0.06,0.985,0.13,0.9 spacing 0.06
unset key
set title "α = 1/4"
set label 1 "held at 1, and so Caputo" at 1,1.35 tc rgb BLUE
set label 2 "at 0, Riemann-Liouville" at 2.3,-0.75 tc rgb RED
set ylabel "x"
plot dat index 0 using 1:2 with lines ls 1, \
     dat index 1 using 1:2 with lines ls 2
set title "α = 3/4"
set label 1 "held at 1" at -3.8,1.12 tc rgb BLUE
set label 2 "along a line, Caputo" at 1.6,1.25 tc rgb GREEN
unset ylabel
plot dat index 2 using 1:2 with lines ls 1, \
     dat index 3 using 1:2 with lines ls 3
unset multiplot
