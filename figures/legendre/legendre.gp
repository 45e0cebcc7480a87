# figures/legendre/legendre.gp -- H 8: the errors of three definitions of the momentum, and of their energies.
# Input: figures/legendre/legendre.c. Output: figures/legendre/legendre.svg.
width = 1000; height = 430
load 'figures/style.gp'
array slope[9]; array last[9] # three for p of block 0, three for E of block 0, three for p of block 1
do for [j=1:9] {
    stats dat index (j > 6) using (log($1)):(log(column((j - 1) % 6 + 2))) name "S" nooutput
    slope[j] = S_slope
    stats dat index (j > 6) every ::4::4 using (log(column((j - 1) % 6 + 2)) - log($1) * (j == 7 ? 2 : 1)) name "L" nooutput
    last[j] = L_min # a line of the predicted slope goes through the last point
}
set logscale xy
set format y "10^{%L}"
set xrange [0.005:0.125]
set xtics ("0.00625" 0.00625, "0.0125" 0.0125, "0.025" 0.025, "0.05" 0.05, "0.1" 0.1)
set xlabel "h"
unset key
set multiplot layout 1,3 margins 0.075,0.985,0.14,0.9 spacing 0.055
array ink[3] = [BLUE, RED, GREEN]
mark(j) = j == 2 ? 4 : 9 - 2 * (j == 1)
size(j) = j == 2 ? 1.5 : 0.9
fit(j) = sprintf("%.2f", slope[j])
set yrange [1e-4:1]

set title "damped, momentum: all have order 1"
set ylabel "largest error" offset 1,0
set label 1 "m (x_k − x_{k−1}) / h: ".fit(3) at 0.006,0.03 tc rgb GREEN
set label 2 "matched: ".fit(1) at 0.016,0.0013 tc rgb BLUE
set label 3 "D_2 L_d alone: ".fit(2) at 0.016,0.0006 tc rgb RED
plot for [j=1:3] exp(last[j]) * x with lines ls 8, \
     for [j=1:3] dat index 0 using 1:(column(1 + j)) with points ls j pt mark(j) ps size(j) lw 1.5

set title "damped, energy: matched is the best"
unset ylabel
set label 1 "m (x_k − x_{k−1}) / h: ".fit(6) at 0.006,0.03
set label 2 "matched: ".fit(4) at 0.035,0.0009
set label 3 "squares: D_2 L_d alone: ".fit(5)
set label 3 at 0.02,0.0004
plot for [j=1:3] exp(last[3 + j]) * x with lines ls 8, \
     for [j=1:3] dat index 0 using 1:(column(4 + j)) with points ls j pt mark(j) ps size(j) lw 1.5
unset label 3

set title "no damping, Duffing, t ≤ 5: an order lost"
set label 1 "m (x_k − x_{k−1}) / h: ".fit(9) at 0.006,0.2
set label 2 "matched: ".fit(7) at 0.03,0.0015
plot for [j=1:3:2] exp(last[6 + j]) * x**(j == 1 ? 2 : 1) with lines ls 8, \
     for [j=1:3:2] dat index 1 using 1:(column(1 + j)) with points ls j pt mark(j) ps size(j) lw 1.5
unset multiplot
