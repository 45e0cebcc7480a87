# figures/lobatto/lobatto.gp -- Chapter 17: error against step, Bagley-Torvik.
# Input: figures/lobatto/lobatto.c. Output: figures/lobatto/lobatto.svg.
width = 900; height = 500
load 'figures/style.gp'
alpha = 0.75
x_order(s) = (o = s + 2 - 2*alpha, o < 2*s - 2 ? o : 2*s - 2)
p_order(s) = (o = s + 1 - 2*alpha, o < 2*s - 2 ? o : 2*s - 2)
array hx[3]; array q[3]; array q0[3]; array p[3]; array p0[3]; array hm[3]
do for [i=1:3] { # slopes over all but the first two steps, above rounding
    stats dat index i-1 every ::2 using (log($1)):($2 > 1e-12 ? log($2) : NaN) name "X" nooutput
    stats dat index i-1 every ::2 using (log($1)):(log($3)) name "P" nooutput
    q[i] = X_slope; q0[i] = X_intercept; hx[i] = X_mean_x
    p[i] = P_slope; p0[i] = P_intercept; hm[i] = P_mean_x
}
# the line of order o through the middle of the points
line(h, o, slope, intercept, mean) = exp(intercept + slope*mean + o*(log(h) - mean))
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [3e-3:0.7]
set xlabel "h"
set multiplot layout 1,2 margins 0.095,0.985,0.32,0.92 spacing 0.1
set key at graph 0.5, graph -0.2 center top vertical maxrows 3 samplen 4

set title "Positions"
set ylabel "largest error for 2 ≤ t ≤ 20"
set yrange [1e-14:1e1]
set ytics 1e2
plot for [i=1:3] line(x, x_order(i+1), q[i], q0[i], hx[i]) with lines ls 13 + i notitle, \
     for [i=1:3] dat index i-1 using 1:2 with points ls 13 + i ps 0.9 \
         title sprintf("s = %d: slope %.2f, line %.1f", i+1, q[i], x_order(i+1))

set title "Momenta; open circles: corrected"
unset ylabel
plot for [i=1:3] line(x, p_order(i+1), p[i], p0[i], hm[i]) with lines ls 13 + i notitle, \
     for [i=1:3] dat index i-1 using 1:3 with points ls 13 + i ps 0.9 \
         title sprintf("s = %d: slope %.2f, line %.1f", i+1, p[i], p_order(i+1)), \
     for [i=1:3] dat index i-1 using 1:4 with points ls 13 + i pt 6 ps 0.5 notitle
unset multiplot
