# figures/structures/structures_order.gp -- H 27: the time that a run needs for each further digit.
# Input: figures/structures/structures_order.tsv. Output: figures/structures/structures_order.svg.
width = 900; height = 420
load 'figures/style.gp'
tsv = 'figures/structures/structures_order.tsv'
array style[6] = [1, LOBATTO3, LOBATTO4, LOBATTO6, LOBATTO8, 5]
set datafile separator "\t"
set logscale xy
set format x "%g"
set format y "10^{%L}"
set multiplot layout 1,2
set ylabel "largest error of an unknown"
set xlabel "milliseconds of the processor, with the start"
set yrange [1e-14:1e-1]
unset key
set title "five storeys, three kinds of dampers"
set xrange [0.08:60]
set label 1 "fvi-stable" at 16,6e-6 tc ls style[1]
set label 2 "3d" at 1.7,2.4e-6 tc ls style[2]
set label 3 "4d" at 2,1.2e-9 tc ls style[3]
set label 4 "6d" at 0.85,6e-12 right tc ls style[4]
set label 5 "8d" at 0.55,4e-14 right tc ls style[5]
set label 6 "fvi-adaptive" at 2.1,3e-14 tc ls style[6]
plot for [i=0:5] tsv index i using 3:4 with linespoints ls style[i+1]
set title "clamped beam, 16 elements, C = K/100"
set xrange [0.08:300]
set label 1 at 38,4e-7
set label 2 at 25,1e-8
set label 3 at 26,9e-12
set label 4 at 15,5e-13 left
set label 5 at 7.5,1.2e-12 left
set label 6 at 0.75,2e-8 right
plot for [i=6:11] tsv index i using 3:4 with linespoints ls style[i-5]
unset multiplot
