# figures/damping_laws/damping_laws_motion.gp -- H 26: the motion of one mass and spring with four laws of damping.
# Input: figures/damping_laws/damping_laws_motion.c. Output: figures/damping_laws/damping_laws_motion.svg.
width = 900; height = 460
load 'figures/style.gp'
set multiplot layout 1,2
name(i) = i == 0 ? "springpot" : i == 1 ? "fractional Zener" : i == 2 ? "Maxwell" : "orders 0 to 1"
set title "held at 1, let go: the swing"
set xlabel "t"
set ylabel "x"
set xrange [0:32]
set yrange [-0.9:1.1]
unset key
plot for [i=0:3] dat index i using 1:2 with lines ls i+1
set title "and what is left of it"
set ylabel "|x|"
set logscale xy
set format "10^{%T}"
set xrange [1:1000]
set yrange [1e-6:1.5]
set key bottom left samplen 2 width -4 # no names at the curves, because they cross
plot for [i=0:3] dat index i using 1:(abs($2)) with lines ls i+1 title name(i)
unset multiplot
