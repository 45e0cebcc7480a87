# figures/damping_laws/damping_laws.gp -- H 26: the storage and loss moduli of four laws.
# Input: figures/damping_laws/damping_laws.c. Output: figures/damping_laws/damping_laws.svg.
width = 900; height = 460
load 'figures/style.gp'
set multiplot layout 1,2
name(i) = i == 0 ? "springpot" : i == 1 ? "fractional Zener" : i == 2 ? "Maxwell" : "orders 0 to 1"
set logscale xy
set format "10^{%T}"
set xlabel "ω"
set xrange [1e-3:1e3]
set yrange [1e-4:2e1]
set key bottom right # no names at the curves, because they cross
set title "storage modulus Re C(iω): a spring"
plot for [i=0:3] dat index i using 1:2 with lines ls i+1 title name(i)
set title "loss modulus Im C(iω): a damper"
unset key
set label 1 "made equal at ω = 1" at 0.8, 0.6 right tc rgb "#222222"
plot for [i=0:3] dat index i using 1:3 with lines ls i+1, '+' using (1):(0.2) every ::0::0 with points pt 7 ps 0.9 lc rgb "#000000"
unset multiplot
