# figures/structures/structures_bench.gp -- Chapter 27: what `make bench` measured.
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
set key top left
set title "more unknowns"
set xlabel "unknowns d"
set xrange [50:2e6]
plot tsv index 0 using 1:4 with linespoints ls 1 title "wave, 1000 steps, explicit", \
     '' index 2 using 1:3 with linespoints ls 2 title "membrane, fvi-stable, factors"
set title "more steps, each with the whole past"
set xlabel "steps N"
set xrange [50:2e5]
plot tsv index 1 using 2:4 with linespoints ls 1 title "wave, 1000 unknowns"
unset multiplot
