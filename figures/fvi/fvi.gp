# figures/fvi/fvi.gp -- H 9: the error of the paper's problem with x(0) != 0, Riemann-Liouville's past against a held
# body.
# Input: figures/fvi/fvi.c. Output: figures/fvi/fvi.svg.
width = 900; height = 440
load 'figures/style.gp'
array a[5]; array printed[5]; array p0[5]; array held[5]; array h0[5]
do for [i=1:5] { # fit the slopes to the finer half of the steps
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
set multiplot layout 1,2 margins 0.08,0.985,0.13,0.92 spacing 0.075
unset key

set title "As printed: the damping acts on x; lines of slope 1 − 2α"
set ylabel "largest error of x for t ≤ 2"
set yrange [4e-6:4e2]
do for [i=1:5] { # a name is turned along its curve; a decade of h is 4 times as long as a decade of the error
    set label i sprintf("α = %.2f: slope %s", a[i], signed(printed[i])) tc ls i center \
        at 2.4e-3, 2.4 * exp(p0[i]) * 2.4e-3**printed[i] rotate by atan(printed[i] / 4) * 180 / pi
}
plot for [i=1:5] exp(p0[i]) * x**(1 - 2*a[i]) * exp((printed[i] - 1 + 2*a[i]) * log(1e-3)) \
         with lines ls i notitle, \
     for [i=1:5] dat index i-1 using 2:3 with points ls i ps 0.9

set title "Held: it acts on x − x_{0}; lines of slope 1"
unset ylabel
unset label
set label 1 sprintf("α = 0.25: slope %.2f", held[1]) at 4e-3,3e-5 tc ls 1
set label 2 sprintf("α = 0.40 to 0.90: slopes %.2f to %.2f", held[2], held[5]) at 4e-4,7e-3
plot for [i=1:5] exp(h0[i]) * x * exp((held[i] - 1) * log(1e-3)) with lines ls i notitle, \
     for [i=1:5] dat index i-1 using 2:4 with points ls i ps 0.9
unset multiplot
