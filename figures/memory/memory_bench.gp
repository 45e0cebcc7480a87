# figures/memory/memory_bench.gp -- H 12: the times that `make bench` measured for the memory.
# Input: figures/memory/memory_bench.tsv. Output: figures/memory/memory_bench.svg.
width = 1000; height = 400
load 'figures/style.gp'
tsv = 'figures/memory/memory_bench.tsv'
set datafile separator "\t"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "steps N"
set multiplot layout 1,3 margins 0.075,0.985,0.15,0.9 spacing 0.095
unset key
# Each guide line goes through the last measured point of its curve.
stats tsv index 0 using 2:3 nooutput; n1 = STATS_max_x; t1 = STATS_max_y
stats tsv index 2 using 2:3 nooutput; n3 = STATS_max_x; t3 = STATS_max_y

set title "Run time, Bagley-Torvik to T = 20"
set ylabel "seconds"
set xrange [20:2e7]
set yrange [1e-6:1e3]
set label 1 "direct sum" at 1.2e4,2e-1 right tc ls 2
set label 2 "FFT blocks" at 1.9e7,2e1 right tc ls 3
set label 3 "exponentials" at 1.9e7,2e-4 right tc ls 1
set label 4 "slope 2" at 6e4,2e1 right tc rgb "#606060"
set label 5 "slope 1" at 1.9e7,6e-3 right tc rgb "#606060"
plot tsv index 0 using 2:3 with linespoints ls 2, \
     '' index 1 using 2:3 with linespoints ls 3, \
     '' index 2 using 2:3 with linespoints ls 1, \
     x > n1 / 20 && x < 12 * n1 ? t1 * (x / n1)**2 : NaN with lines ls 8, \
     x > n3 / 1e4 ? t3 * (x / n3) : NaN with lines ls 8

set title "What the memory takes"
set ylabel "bytes"
set yrange [1e2:1e10]
unset label
set label 1 "direct sum,\ntwo doubles a step" at 1.9e7,5e4 right tc ls 2
set label 2 "FFT blocks" at 1e4,6e7 right tc ls 3
set label 3 "exponentials" at 1.9e7,7e2 right tc ls 1
plot tsv index 0 using 2:5 with linespoints ls 2, \
     '' index 1 using 2:5 with linespoints ls 3, \
     '' index 2 using 2:5 with linespoints ls 1, \
     16 * x with lines ls 8

set title "Run time against the error of x(T)"
set xlabel "error"
set ylabel "seconds"
set xrange [1:1e-7]
set xtics (1, 1e-2, 1e-4, 1e-6)
set yrange [1e-6:1e3]
unset label
set label 1 "direct sum" at 6e-4,1.5e-1 right tc ls 2
set label 2 "FFT blocks" at 5e-5,1e1 right tc ls 3
set label 3 "exponentials" at 1e-4,3e-4 tc ls 1
plot tsv index 0 using 6:3 with linespoints ls 2, \
     '' index 1 using 6:3 with linespoints ls 3, \
     '' index 2 using 6:3 with linespoints ls 1
unset multiplot
