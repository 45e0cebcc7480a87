# figures/memory/memory_bench.gp -- Chapter 12: what `make bench` measured.
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
# the guides go through the last measured point of their own curve
stats tsv index 0 using 2:3 nooutput; n1 = STATS_max_x; t1 = STATS_max_y
stats tsv index 2 using 2:3 nooutput; n3 = STATS_max_x; t3 = STATS_max_y

set title "Run time, Bagley-Torvik to T = 20"
set ylabel "seconds"
set xrange [20:2e7]
set yrange [1e-6:1e3]
set key right bottom
plot tsv index 0 using 2:3 with linespoints ls 2 notitle, \
     '' index 1 using 2:3 with linespoints ls 3 notitle, \
     '' index 2 using 2:3 with linespoints ls 1 notitle, \
     x > n1 / 20 ? t1 * (x / n1)**2 : NaN with lines ls 8 title "slopes 1 and 2", \
     x > n3 / 1e4 ? t3 * (x / n3) : NaN with lines ls 8 notitle

set title "What the memory takes"
set ylabel "bytes"
set yrange [1e2:1e10]
set key left top
plot tsv index 0 using 2:5 with linespoints ls 2 notitle, \
     '' index 1 using 2:5 with linespoints ls 3 notitle, \
     '' index 2 using 2:5 with linespoints ls 1 notitle, \
     16 * x with lines ls 8 title "two doubles a step"

set title "Run time against the error of x(T)"
set xlabel "error"
set ylabel "seconds"
set xrange [1:1e-7]
set xtics (1, 1e-2, 1e-4, 1e-6)
set yrange [1e-6:1e3]
plot tsv index 0 using 6:3 with linespoints ls 2 title "direct sum", \
     '' index 1 using 6:3 with linespoints ls 3 title "FFT blocks", \
     '' index 2 using 6:3 with linespoints ls 1 title "exponentials"
unset multiplot
