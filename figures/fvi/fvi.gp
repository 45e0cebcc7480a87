# figures/fvi/fvi.gp -- Chapter 9: x(0) != 0, Riemann-Liouville against held.
# Input: figures/fvi/fvi.c. Output: figures/fvi/fvi.svg.
width = 900; height = 540
load 'figures/style.gp'
array a[5]; array printed[5]; array p0[5]; array held[5]; array h0[5]
do for [i=1:5] { # slopes over the finer half of the steps
    stats dat index i-1 every ::4 using (log($2)):(log($3)) name "P" nooutput
    stats dat index i-1 every ::4 using (log($2)):(log($4)) name "H" nooutput
    stats dat index i-1 using 1 name "A" nooutput
    a[i] = A_min
    printed[i] = P_slope; p0[i] = P_intercept
    held[i] = H_slope; h0[i] = H_intercept
}
signed(v) = sprintf(v < 0 ? "−%.2f" : "%.2f", abs(v))
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [3e-4:0.13]
set xlabel "h"
set multiplot layout 1,2 margins 0.08,0.985,0.39,0.92 spacing 0.075
set key at graph 0.5, graph -0.24 center top vertical maxrows 5 samplen 5 width -1 Left reverse

set title "As printed: the damping acts on x"
set ylabel "largest error of x for t ≤ 2"
set yrange [4e-6:4e2]
plot for [i=1:5] exp(p0[i]) * x**(1 - 2*a[i]) * exp((printed[i] - 1 + 2*a[i]) * log(1e-3)) \
         with lines ls i notitle, \
     for [i=1:5] dat index i-1 using 2:3 with points ls i ps 0.9 notitle, \
     for [i=1:5] keyentry with linespoints ls i ps 0.9 \
         title sprintf("α = %.2f: slope %s, line %s", a[i], signed(printed[i]), signed(1 - 2*a[i]))

set title "Held: it acts on x − x_{0}"
unset ylabel
plot for [i=1:5] exp(h0[i]) * x * exp((held[i] - 1) * log(1e-3)) with lines ls i notitle, \
     for [i=1:5] dat index i-1 using 2:4 with points ls i ps 0.9 notitle, \
     for [i=1:5] keyentry with linespoints ls i ps 0.9 \
         title sprintf("α = %.2f: slope %.2f, line 1", a[i], held[i])
unset multiplot
