# figures/lobatto/lobatto.gp -- H 17: the error against h of three methods with stages, for the problem of Bagley and
# Torvik.
# Input: figures/lobatto/lobatto.c. Output: figures/lobatto/lobatto.svg.
width = 900; height = 440
load 'figures/style.gp'
alpha = 0.75
x_order(s) = (o = s + 2 - 2*alpha, o < 2*s - 2 ? o : 2*s - 2)
p_order(s) = (o = s + 1 - 2*alpha, o < 2*s - 2 ? o : 2*s - 2)
array hx[3]; array q[3]; array q0[3]; array p[3]; array p0[3]; array hm[3]
do for [i=1:3] { # fit the slopes to all steps but the first two, where the errors are above rounding
    stats dat index i-1 every ::2 using (log($1)):($2 > 1e-12 ? log($2) : NaN) name "X" nooutput
    stats dat index i-1 every ::2 using (log($1)):(log($3)) name "P" nooutput
    q[i] = X_slope; q0[i] = X_intercept; hx[i] = X_mean_x
    p[i] = P_slope; p0[i] = P_intercept; hm[i] = P_mean_x
}
# Return the line of order o through the middle of the points.
line(h, o, slope, intercept, mean) = exp(intercept + slope*mean + o*(log(h) - mean))
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [3e-3:0.7]
set xlabel "h"
set multiplot layout 1,2 margins 0.095,0.985,0.13,0.92 spacing 0.1
unset key
name(i, slope, order) = sprintf("s = %d: slope %.2f, line %.1f", i + 1, slope, order)

set title "Positions"
set ylabel "largest error for 2 ≤ t ≤ 20"
set yrange [1e-14:1e1]
set ytics 1e2
set label 1 name(1, q[1], x_order(2)) at 4.5e-3,1e-2 tc ls 14
set label 2 name(2, q[2], x_order(3)) at 4.5e-3,7e-7 tc rgb "#606060"
set label 3 name(3, q[3], x_order(4)) at 0.6,1e-12 right tc ls 16
plot for [i=1:3] line(x, x_order(i+1), q[i], q0[i], hx[i]) with lines ls 13 + i notitle, \
     for [i=1:3] dat index i-1 using 1:2 with points ls 13 + i ps 0.9

set title "Momenta; open circles: corrected"
unset ylabel
set label 1 name(1, p[1], p_order(2)) at 4.5e-3,2e-1
set label 2 name(2, p[2], p_order(3)) at 0.095,3.2e-4 center rotate by 21
set label 3 name(3, p[3], p_order(4)) at 0.6,2e-12 right
plot for [i=1:3] line(x, p_order(i+1), p[i], p0[i], hm[i]) with lines ls 13 + i notitle, \
     for [i=1:3] dat index i-1 using 1:3 with points ls 13 + i ps 0.9, \
     for [i=1:3] dat index i-1 using 1:4 with points ls 13 + i pt 6 ps 0.5 notitle
unset multiplot
