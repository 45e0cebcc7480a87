# figures/balance/balance_differences.gp -- What a variational scheme gains: errors of x, and errors of gradients.
# Input: figures/balance/balance_differences.c. Output: figures/balance/balance_differences.svg.
width = 960; height = 480
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.075,0.985,0.29,0.92 spacing 0.085
set logscale xy
set format y "10^{%T}"
set xlabel "steps N"
set xrange [27:610]
set xtics (32, 64, 128, 256, 512)
set key at graph 0.5, graph -0.2 center top # one key for both panels, half of it below each

set title "The largest error of x for t ≤ 10"
set yrange [3e-10:1]
plot dat index 0 using 1:2 with linespoints ls 8 pt 1 title "node scheme", \
     '' index 0 using 1:3 with linespoints ls 4 pt 2 title "mean scheme", \
     '' index 0 using 1:4 with linespoints ls 2 pt 3 title "back scheme", \
     '' index 0 using 1:5 with linespoints ls FVI notitle, \
     '' index 0 using 1:6 with linespoints ls SHIFTED notitle, \
     '' index 0 using 1:7 with linespoints ls LOBATTO4 notitle

set title "The gradient from the same scheme run backwards: its error"
set yrange [1e-16:1e-1]
plot dat index 1 using 1:2 with linespoints ls 8 pt 1 notitle, \
     '' index 1 using 1:3 with linespoints ls 4 pt 2 notitle, \
     '' index 1 using 1:4 with linespoints ls 2 pt 3 notitle, \
     '' index 1 using 1:5 with linespoints ls FVI title "fvi", \
     keyentry with linespoints ls SHIFTED title "fvi-shifted", \
     keyentry with linespoints ls LOBATTO4 title "fvi-lobatto4"
unset multiplot
