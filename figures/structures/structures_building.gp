# figures/structures/structures_building.gp -- H 27: twenty storeys on moving ground, without and with dampers.
# Input: figures/structures/structures_building.c. Output: figures/structures/structures_building.svg.
width = 900; height = 480
load 'figures/style.gp'
set multiplot
set origin 0, 0.66; set size 0.66, 0.34
set title "the ground's acceleration"
set ylabel "m/s²"
set ytics 3
set xrange [0:30]
unset key
plot dat index 0 using 1:2 with lines ls 7 lw 0.8
set origin 0, 0; set size 0.66, 0.66
set title "the roof against the ground"
set ylabel "m"
set ytics 1
set xlabel "t in s"
set yrange [-1.4:2.8]
set key top left # no names at the curves, because they cross
plot dat index 0 using 1:3 with lines ls 2 title "bare", \
     dat index 0 using 1:4 with lines ls 1 title "six dampers, α = 0.3"
set origin 0.66, 0; set size 0.34, 1
set title "largest drift"
set xlabel "m"
set xtics 0.05
set ylabel "storey"
set xrange [0:*]
set yrange [0.5:20.5]
set ytics 2
unset key
plot dat index 1 using 2:1 with linespoints ls 2, '' index 1 using 3:1 with linespoints ls 1
unset multiplot
