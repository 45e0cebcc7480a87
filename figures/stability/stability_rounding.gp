# figures/stability/stability_rounding.gp -- Chapter 14: rounding in three forms.
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
set yrange [1e-17:1e-8]
set key top left
plot dat using 1:2 with linespoints ls 2 title "second difference, memory on positions", \
     f(x) with lines ls 8 title sprintf("fit, N^{%.1f}", b), \
     dat using 1:3 with linespoints ls 1 title "momentum form, memory on increments (ours)", \
     g(x) with lines ls 8 title sprintf("fit, N^{%.1f}", c), \
     dat using 1:4 with linespoints ls 3 title "the same, compensated sums"
