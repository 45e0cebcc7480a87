# figures/convergence/convergence_orders.gp -- H 20: the observed orders of two methods for a held body, for every
# alpha.
# Input: figures/convergence/convergence_orders.c. Output: figures/convergence/convergence_orders.svg.
width = 900; height = 420
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.06,0.985,0.13,0.9 spacing 0.07
set xlabel "α"
set xrange [0:1]
set yrange [0:4.6]
unset key
set samples 401
left(a, q) = a < 0.5 ? q : NaN
right(a, q) = a > 0.5 ? q : NaN
set title "order at a fixed t"
set label 1 "fvi-lobatto3d" at 0.05,4.3 left tc rgb RED
set label 2 "fvi-stable" at 0.05,2.3 left tc rgb GREEN
set label 3 "5 − 2α" at 0.9,3.6 left tc rgb "#606060"
plot left(x, 4) with lines ls 8, right(x, 5 - 2*x) with lines ls 8, 2 with lines ls 8, \
     dat index 0 using 1:2 with points ls 3, dat index 0 using 1:3 with points ls 3 pt 8, \
     dat index 1 using 1:2 with points ls 2, dat index 1 using 1:3 with points ls 2 pt 4
unset label
set title "order over all t"
set label 1 "x: 3 − 2α" at 0.2,2.8 left tc rgb RED
set label 2 "x: 5 − 4α" at 0.67,2.65 left tc rgb RED
set label 3 "x of fvi-stable: 2" at 0.03,2.15 left tc rgb GREEN
set label 4 "p: 2 − 2α" at 0.05,1.35 left tc rgb "#606060"
set label 5 "p: 4 − 4α" at 0.58,0.78 left tc rgb "#606060"
plot left(x, 3 - 2*x) with lines ls 8, right(x, 5 - 4*x) with lines ls 8, \
     left(x, 2 - 2*x) with lines ls 8, right(x, 4 - 4*x) with lines ls 8, \
     (x < 0.75 ? 2 : NaN) with lines ls 8, \
     dat index 0 using 1:4 with points ls 3, dat index 0 using 1:5 with points ls 3 pt 8, \
     dat index 1 using 1:4 with points ls 2, dat index 1 using 1:5 with points ls 2 pt 4
unset multiplot
