# figures/events/events.gp -- H 22: a ball that bounces on springpots.
# Input: figures/events/events.c. Output: events.svg.
width = 900; height = 400
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.08,0.985,0.14,0.9 spacing 0.09
set xrange [0:5]
set xlabel "t"
set title "The height"
set ylabel "x" offset 1.5
set yrange [-0.04:1.05]
unset key
set label 1 "undamped" at 2.75,0.68 tc ls 1
set label 2 "order 3/5" at 2.48,0.4 center tc ls 2
set label 3 "order 7/5" at 2.3,0.14 center tc ls 3
plot dat index 0 using 1:2 with lines ls 1 notitle, \
     dat index 2 using 1:2 with lines ls 2 notitle, \
     dat index 4 using 1:2 with lines ls 3 notitle, \
     dat index 1 using 1:2 with points ls 1 pt 7 ps 0.7 notitle, \
     dat index 3 using 1:2 with points ls 2 pt 7 ps 0.7 notitle, \
     dat index 5 using 1:2 with points ls 3 pt 7 ps 0.7 notitle
set title "The velocity"
set ylabel "v" offset 1.5
set yrange [-1.55:1.3]
set label 1 "undamped" at 1.55,1.18 left
set label 2 "order 3/5" at 3.5,0.78 right
set label 3 "order 7/5" at 1.5,0.72 right
plot dat index 0 using 1:3 with lines ls 1 notitle, \
     dat index 2 using 1:3 with lines ls 2 notitle, \
     dat index 4 using 1:3 with lines ls 3 notitle
unset multiplot
