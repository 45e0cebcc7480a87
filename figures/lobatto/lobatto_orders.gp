# figures/lobatto/lobatto_orders.gp -- H 17: the observed orders of three methods with stages, for every alpha.
# Input: figures/lobatto/lobatto_orders.c. Output: figures/lobatto/lobatto_orders.svg.
width = 900; height = 390
load 'figures/style.gp'
least(a, b) = a < b ? a : b
set samples 400
set xlabel "α"
set xrange [-0.03:1.03]
set yrange [0:6.6]
set xtics 0.25
set multiplot layout 1,2 margins 0.065,0.985,0.14,0.9 spacing 0.07
unset key

set title "Order of x, and min(2s − 2, s + 2 − 2α)"
set ylabel "fitted order"
set label 1 "s = 2" at 0.02,1.6 tc ls 14
set label 2 "s = 3" at 0.02,3.6 tc rgb "#606060"
set label 3 "s = 4" at 0.02,5.15 tc ls 16
plot for [s=2:4] least(2*s - 2, s + 2 - 2*x) with lines ls s + 12, \
     for [s=2:4] dat index s-2 using 1:2 with points ls s + 12 ps 1

set title "Order of p, and min(2s − 2, s + 1 − 2α)"
unset ylabel
set label 2 at 0.02,3.4
set label 3 at 0.02,5.3
plot for [s=2:4] least(2*s - 2, s + 1 - 2*x) with lines ls s + 12, \
     for [s=2:4] dat index s-2 using 1:3 with points ls s + 12 ps 1
unset multiplot
