# figures/exact_solution/exact_solution.gp -- H 11: a solution as the sum of an oscillation and a tail.
# Input: figures/exact_solution/exact_solution.c. Output: figures/exact_solution/exact_solution.svg.
width = 860; height = 400
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.075,0.985,0.14,0.9 spacing 0.06
set xrange [0:30]
set yrange [-0.85:1.25]
set xlabel "t"
set xzeroaxis lc rgb "#888888"
unset key
set title "α = 1/4"
set ylabel "x" offset 1.5
set label 1 "their sum" at 6.6,0.42 tc rgb BLUE
set label 2 "tail: the integral along the cut" at 12.5,0.3 tc rgb RED
set label 3 "oscillation: 2 Re a e^{st}" at 4.2,-0.42 tc rgb SKY
plot dat index 0 using 1:3 with lines ls 6, \
     '' index 0 using 1:4 with lines ls 2, \
     '' index 0 using 1:2 with lines ls 1 lw 2.4
set title "α = 3/4"
unset ylabel
unset label
plot dat index 1 using 1:3 with lines ls 6 notitle, \
     '' index 1 using 1:4 with lines ls 2 notitle, \
     '' index 1 using 1:2 with lines ls 1 lw 2.4 notitle
unset multiplot
