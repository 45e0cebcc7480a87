# figures/structures/structures.gp -- H 27: a clamped beam that is bent and let go.
# Input: figures/structures/structures.c. Output: figures/structures/structures.svg.
width = 900; height = 420
load 'figures/style.gp'
set multiplot layout 1,2
set title "the beam, six times within half a swing"
set xlabel "along the beam"
set ylabel "deflection"
set xrange [0:1.28] # the times stand to the right of the curves
set xtics 0,0.2,1
set yrange [-1.05:1.05]
unset key
stats dat index 3 every :::0::0 using 1 nooutput
tip = STATS_records - 1
plot for [i=0:5] dat index 3 every :::i::i using 1:2 with lines ls 1 lw (3.2 - 0.45 * i), \
     for [i=0:5] '' index 3 every ::tip:i:tip:i using (1.02):2:(sprintf(i ? "t = %.2f" : "t = 0", i * 71 / 400.)) with labels left tc ls 1 font ",11"
set xtics autofreq
set title "its tip"
set xlabel "t"
set xrange [0:8]
set yrange [-1.6:1.05]
set key bottom right # no names at the curves, because they cross
plot dat index 0 using 1:2 with lines ls 1 title "α = 0.05", \
     dat index 1 using 1:2 with lines ls 2 title "α = 0.25", \
     dat index 2 using 1:2 with lines ls 3 title "α = 0.5"
unset multiplot
