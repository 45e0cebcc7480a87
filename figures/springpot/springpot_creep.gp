# figures/springpot/springpot_creep.gp -- H 0: ladders under a force, and after it.
# Input: figures/springpot/springpot_creep.c. Output: figures/springpot/springpot_creep.svg.
width = 900; height = 420
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.08,0.985,0.14,0.9 spacing 0.13
unset key
set title "a force comes, and stays"
set xlabel "t, in units of η / k"
set ylabel "x"
set logscale xy
set format "10^{%T}"
set xrange [0.1:3000]
set yrange [0.1:200]
set label 1 "β = 3/4" at 3600,170 tc rgb "#222222"
set label 2 "β = 1/2" at 3600,60 tc rgb "#222222"
set label 3 "β = 1/4" at 3600,17 tc rgb "#222222"
plot for [i=0:2] dat index i using 1:3 with lines ls word("3 1 2", i+1)+0, \
     for [i=0:2] dat index i using 1:2 with points ls 7 pt 6 ps 0.6
unset label
set title "a force comes, and goes"
set xlabel "t"
unset logscale
set format "%g"
set xrange [-0.2:3]
set yrange [-0.05:1.3]
set label 1 "spring" at 0.03,1.06 tc rgb "#222222"
set label 2 "dashpot" at 2.05,1.06 tc rgb "#222222"
set label 3 "springpot, β = 1/2" at 1.65,0.66 tc rgb "#222222"
plot dat index 5 using 1:2 with lines ls 4, \
     dat index 6 using 1:2 with lines ls 8, \
     dat index 4 using 1:2 with lines ls 1, \
     dat index 3 using 1:2 with points ls 7 pt 6 ps 0.6
unset multiplot
