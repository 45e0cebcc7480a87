# figures/blocks/blocks_bench.gp -- H 28: the times that `make bench` measured for the memory by blocks.
# Input: figures/blocks/blocks_bench.tsv. Output: figures/blocks/blocks_bench.svg.
width = 1000; height = 430
load 'figures/style.gp'
tsv = 'figures/blocks/blocks_bench.tsv'
set datafile separator "\t"
set multiplot layout 1,2 margins 0.075,0.985,0.15,0.9 spacing 0.095
set logscale xy

set title "One push of d coordinates, 72 modes"
set xlabel "d"
set ylabel "ns a coordinate"
set format x "10^{%L}"
set xrange [10:2e6]
set yrange [5:200]
unset key
set label 1 "one by one" at 1.5e4,32 right tc ls 2
set label 2 "by blocks" at 1.5e4,10.5 right tc ls 1
plot tsv index 1 using 1:2 with linespoints ls 2, \
     '' index 1 using 1:3 with linespoints ls 1
unset label

# The table has one row for each upper bound of the speed, in this order.
stats tsv index 2 every ::0::0 using (peak = $2) nooutput
stats tsv index 2 every ::1::1 using (wide = $2) nooutput
set title "The roofline at d = 10^6"
set xlabel "operations a byte"
set ylabel "operations a nanosecond"
set format x "%g"
set xrange [0.1:20]
set yrange [1:100]
set key right bottom # two marks have no curve that could carry their names
set label 1 sprintf("%.0f GFLOP/s", peak) at 5,peak * 1.25
set label 2 sprintf("%.0f GB/s", wide) at 0.5,wide * 0.5 * 1.5 right
plot (x * wide < peak ? x * wide : peak) with lines ls 7 title "no program is above", \
     tsv index 3 every ::0::0 using 4:6 with points ls 2 ps 1.4 title "one by one", \
     '' index 3 every ::1::1 using 4:6 with points ls 1 ps 1.4 title "by blocks"
unset multiplot
