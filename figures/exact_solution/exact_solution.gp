# figures/exact_solution/exact_solution.gp -- Chapter 11: the two parts of a solution.
# Input: figures/exact_solution/exact_solution.c. Output: figures/exact_solution/exact_solution.svg.
width = 860; height = 440
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.075,0.985,0.22,0.91 spacing 0.06
set xrange [0:30]
set yrange [-0.85:1.25]
set xlabel "t"
set xzeroaxis lc rgb "#888888"
set key at screen 0.5, screen 0.015 center bottom maxrows 1 width -4
set title "α = 1/4"
set ylabel "x" offset 1.5
plot dat index 0 using 1:3 with lines ls 6 title "oscillation 2 Re a e^{st}", \
     '' index 0 using 1:4 with lines ls 2 title "tail: integral along the cut", \
     '' index 0 using 1:2 with lines ls 1 lw 2.4 title "their sum x"
set title "α = 3/4"
unset ylabel
plot dat index 1 using 1:3 with lines ls 6 notitle, \
     '' index 1 using 1:4 with lines ls 2 notitle, \
     '' index 1 using 1:2 with lines ls 1 lw 2.4 notitle
unset multiplot
