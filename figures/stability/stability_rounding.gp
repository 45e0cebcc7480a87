# figures/stability/stability_rounding.gp -- H 14: the rounding errors of three forms of the same integrator.
# Input: figures/stability/stability_rounding.c. Output: figures/stability/stability_rounding.svg.
load 'figures/style.gp'
set logscale xy
set format y "10^{%L}"
set xlabel "steps N on [0, 20]"
set ylabel "max |x − truth| / max |truth|"
set title "Bagley-Torvik: the error that rounding alone makes"
set fit quiet logfile '/dev/null'
l(x) = la + b * x
la = -36; b = 2
fit l(x) dat using (log($1)):(log($2)) via la, b
f(x) = exp(la) * x**b
m(x) = ma + c * x
ma = -36; c = 0.5
fit m(x) dat using (log($1)):(log($3)) via ma, c
g(x) = exp(ma) * x**c
set xrange [100:20000]
set yrange [2e-17:2e-10]
unset key
set label 1 sprintf("second difference: N^{%.1f}", b) at 900,3e-12 right tc rgb RED
set label 2 sprintf("momentum form, memory on increments (ours): N^{%.1f}", c) at 18000,5e-15 right tc rgb BLUE
set label 3 "the same, compensated sums" at 18000,5e-17 right tc rgb GREEN
plot dat using 1:2 with linespoints ls 2, \
     f(x) with lines ls 8, \
     dat using 1:3 with linespoints ls 1, \
     g(x) with lines ls 8, \
     dat using 1:4 with linespoints ls 3
