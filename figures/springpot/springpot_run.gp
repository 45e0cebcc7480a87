# figures/springpot/springpot_run.gp -- H 0: the first run, by the library and by a ladder.
# Input: figures/springpot/springpot_run.c. Output: figures/springpot/springpot_run.svg.
width = 900; height = 420
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.075,0.985,0.14,0.9 spacing 0.07
unset key
set xlabel "t"
set ylabel "x"
set xrange [0:20]
set yrange [-0.6:1.1]
set title "the body, and what its ladder remembers"
set label 1 "rung 30" at 6.3,0.5 tc rgb "#222222"
set label 2 "rung 100" at 12.2,0.6 tc rgb "#222222"
set label 3 "rung 300" at 12.2,1.02 tc rgb "#222222"
set label 4 "body" at 3.6,-0.36 tc rgb "#222222"
plot dat index 1 using 1:3 with lines ls 6 dt 1 lc rgb "#56799c" lw 1.2, \
     '' index 1 using 1:4 with lines ls 8 dt (8,4), \
     '' index 1 using 1:5 with lines ls 8 dt 1, \
     dat index 0 using 1:2 with lines ls 1, \
     dat index 1 every 6 using 1:2 with points ls 7 pt 6 ps 0.6
unset label
set title "one place, one velocity, two pasts"
unset ylabel
set xrange [0:15]
set arrow 1 from 2.8,-0.6 to 2.8,1.1 nohead lc rgb "#777777" lw 0.8
set label 1 "held there until t = 2.8" at 6.3,-0.42 left tc rgb "#222222"
set label 2 "in motion since t = 0" at 6.3,0.42 left tc rgb "#222222"
plot dat index 0 using 1:2 with lines ls 1, \
     dat index 2 using 1:2 with lines ls 2, \
     dat index 3 every 6 using 1:2 with points ls 7 pt 6 ps 0.6
unset multiplot
