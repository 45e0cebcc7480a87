# figures/lobatto/lobatto_orders.gp -- Chapter 17: the order for every alpha.
# Input: figures/lobatto/lobatto_orders.c. Output: figures/lobatto/lobatto_orders.svg.
width = 900; height = 430
load 'figures/style.gp'
least(a, b) = a < b ? a : b
set samples 400
set xlabel "α"
set xrange [-0.03:1.03]
set yrange [0:6.6]
set xtics 0.25
set multiplot layout 1,2 margins 0.065,0.985,0.25,0.89 spacing 0.07
set key at graph 0.5, graph -0.23 center top horizontal samplen 3

set title "Order of x, and min(2s − 2, s + 2 − 2α)"
set ylabel "fitted order"
plot for [s=2:4] least(2*s - 2, s + 2 - 2*x) with lines ls s + 12 notitle, \
     for [s=2:4] dat index s-2 using 1:2 with points ls s + 12 ps 1 title sprintf("s = %d", s)

set title "Order of p, and min(2s − 2, s + 1 − 2α)"
unset ylabel
plot for [s=2:4] least(2*s - 2, s + 1 - 2*x) with lines ls s + 12 notitle, \
     for [s=2:4] dat index s-2 using 1:3 with points ls s + 12 ps 1 title sprintf("s = %d", s)
unset multiplot
