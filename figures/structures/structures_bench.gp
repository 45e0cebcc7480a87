# figures/structures/structures_bench.gp -- H 27: the times that `make bench` measured for structures.
# Input: figures/structures/structures_bench.tsv. Output: figures/structures/structures_bench.svg.
width = 900; height = 400
load 'figures/style.gp'
tsv = 'figures/structures/structures_bench.tsv'
set datafile separator "\t"
set logscale xy
set format x "10^{%L}"
set multiplot layout 1,2
set ylabel "ns per unknown and step"
set yrange [1:3000]
unset key
set label 1 "membrane, fvi-stable, factors" at 70,300 tc ls 2
set label 2 "wave, 1000 steps, explicit" at 1.4e6,13 right tc ls 1
set title "more unknowns"
set xlabel "unknowns d"
set xrange [50:2e6]
plot tsv index 0 using 1:4 with linespoints ls 1, \
     '' index 2 using 1:3 with linespoints ls 2
set title "more steps, each with the whole past"
set xlabel "steps N"
set xrange [50:2e5]
unset label 1
set label 2 "wave, 1000 unknowns" at 1.4e5,13
plot tsv index 1 using 2:4 with linespoints ls 1
unset multiplot
