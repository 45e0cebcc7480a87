# figures/experiments/experiments_bagley_torvik.gp -- H 10: the problem of Bagley and Torvik, by the FVI and by the
# matrix method.
# Input: figures/experiments/experiments_bagley_torvik.c. Output: figures/experiments/experiments_bagley_torvik.svg.
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
unset key
set label 1 "line: FVI, h = 0.1" at 4,5.2 tc ls FVI
set label 2 "dashes: benchmark, matrix method, h = 0.005" at 4,4.6 tc ls MATRIX
set label 3 "circles: exact" at 4,4 tc rgb "#222222"
plot dat index 2 using 1:2 with lines ls MATRIX, \
     '' index 1 using 1:2 with lines ls FVI, \
     '' index 0 using 1:2 with points lc rgb "#000000" pt 6 ps 0.6
set title "largest error at t = 0, 0.1, ..., 20"
set logscale xy
set xlabel "h"
unset ylabel
set xrange [0.004:0.13]
set yrange [0.004:6]
set xtics (0.1, 0.05, 0.025, 0.0125, 0.00625)
set label 1 "matrix method: error" at 0.016,0.2 right tc ls MATRIX
set label 2 "benchmark: error" at 0.0043,0.0215 tc ls MATRIX
set label 3 sprintf("FVI: distance from the\nbenchmark, first four:\nslope %.2f", four) at 0.129,0.024 right tc ls PRINTED
set label 4 sprintf("FVI: error, slope %.3f\n(first two: %.3f)", slope, two) at 0.0085,0.0085 tc ls FVI
plot dat index 3 using 1:4 with points ls MATRIX ps 1, \
     '' index 3 using 1:3 with linespoints ls PRINTED, \
     '' index 3 using 1:2 with points ls FVI ps 0.9, \
     [0.005:0.1] K * x**slope with lines ls FVI, \
     own with lines ls MATRIX
unset multiplot
