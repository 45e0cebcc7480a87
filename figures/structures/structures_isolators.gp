# figures/structures/structures_isolators.gp -- H 27: five storeys on isolators of four orders.
# Input: figures/structures/structures_isolators.c. Output: figures/structures/structures_isolators.svg.
width = 1000; height = 400
load 'figures/style.gp'
set multiplot layout 1,3
set title "an earthquake: the isolators"
set xlabel "shift of the slab"
set ylabel "force"
set xtics 0.2
unset key
set label 1 "α = 0.1" at graph 0.05,0.93 tc ls 1
set label 2 "α = 0.4" at graph 0.05,0.86 tc ls 2
plot dat index 0 using 1:2 with lines ls 1, '' index 9 using 1:2 with lines ls 2
unset label
set title "an earthquake: the roof"
set xlabel "frequency in Hz"
set ylabel "largest acceleration"
set logscale xy
set xtics autofreq
set xrange [0.2:15]
set yrange [0.1:100]
set key bottom right # no names at the curves, because they lie on each other
plot dat index 12 using 1:2 with lines ls 7 title "no isolators", \
     '' index 2 using 1:2 with lines ls 1 title "α = 0.1", \
     '' index 11 using 1:2 with lines ls 2 title "α = 0.4"
set title "a lasting wind: the slab"
set xlabel "t"
set ylabel "shift"
unset logscale y
set xrange [0.1:100000]
set yrange [0:*]
set format x "10^{%T}"
set key top left # no names at the curves, because they lie on each other
plot dat index 1 using 1:2 with lines ls 1 title "α = 0.1", \
     '' index 4 using 1:2 with lines ls 3 title "α = 0.2", \
     '' index 7 using 1:2 with lines ls 4 title "α = 0.3", \
     '' index 10 using 1:2 with lines ls 2 title "α = 0.4"
unset multiplot
