# figures/damping_laws/damping_laws_creep.gp -- H 26: the relaxation, the creep and the loss factor of four laws.
# Input: figures/damping_laws/damping_laws_creep.c. Output: figures/damping_laws/damping_laws_creep.svg.
width = 1080; height = 420
load 'figures/style.gp'
set multiplot layout 1,3
name(i) = i == 0 ? "springpot" : i == 1 ? "fractional Zener" : i == 2 ? "Maxwell" : "orders 0 to 1"
set logscale xy
set format "10^{%T}"
set xlabel "t"
set xrange [1e-3:1e3]
set yrange [1e-3:1e1]
set title "held at 1: the force"
unset key
plot for [i=0:3] dat index i using 1:2 with lines ls i+1
set yrange [1e-1:1e4]
set title "pulled with 1: the stretch"
set key top left # no names at the curves, because they cross
plot for [i=0:3] dat index i using 1:3 with lines ls i+1 title name(i)
set xlabel "ω"
set yrange [1e-2:1e3]
set title "shaken: the loss factor"
unset key
plot for [i=0:3] dat index i using 1:4 with lines ls i+1
unset multiplot
