# figures/experiments/experiments_bagley_torvik.gp -- Chapter 10: the problem with order 3/2.
# Input: figures/experiments/experiments_bagley_torvik.c.
# Output: figures/experiments/experiments_bagley_torvik.svg.
width = 960; height = 480
load 'figures/style.gp'
stats dat index 4 using 1 nooutput; slope = STATS_min
stats dat index 4 using 2 nooutput; K = STATS_min
stats dat index 4 using 3 nooutput; two = STATS_min
stats dat index 4 using 4 nooutput; four = STATS_min
stats dat index 3 using 4 nooutput; own = STATS_min
set multiplot layout 1,2 margins 0.065,0.985,0.14,0.915 spacing 0.085
set title "x″ + x + D^{3/2}x = F"
set xlabel "t"
set ylabel "x"
set xrange [0:20]
set yrange [-3:7]
set key top right
plot dat index 2 using 1:2 with lines ls MATRIX title "benchmark: matrix method, h = 0.005", \
     '' index 1 using 1:2 with lines ls FVI title "FVI, h = 0.1", \
     '' index 0 using 1:2 with points lc rgb "#000000" pt 6 ps 0.6 title "exact"
set title "largest error at t = 0, 0.1, ..., 20"
set logscale xy
set xlabel "h"
unset ylabel
set xrange [0.004:0.13]
set yrange [0.004:6]
set xtics (0.1, 0.05, 0.025, 0.0125, 0.00625)
set key top left Left reverse width -4
plot dat index 3 using 1:4 with points ls MATRIX ps 1 title "matrix method: error", \
     '' index 3 using 1:3 with linespoints ls PRINTED title sprintf("FVI: distance from the benchmark (first four: slope %.2f)", four), \
     '' index 3 using 1:2 with points ls FVI ps 0.9 title sprintf("FVI: error, slope %.3f (first two: %.3f)", slope, two), \
     [0.005:0.1] K * x**slope with lines ls FVI notitle, \
     own with lines ls MATRIX title "error of the benchmark"
unset multiplot
