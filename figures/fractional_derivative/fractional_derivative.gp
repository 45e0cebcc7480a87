# figures/fractional_derivative/fractional_derivative.gp -- H 1: derivatives of a sine of orders between 0 and 1, and
# the convergence of the Grünwald-Letnikov sum.
# Input: figures/fractional_derivative/fractional_derivative.c. Output:
# figures/fractional_derivative/fractional_derivative.svg.
width = 900; height = 480
load 'figures/style.gp'
array A[6]
array C[6]
array S[6]
array open[3] = [6, 4, 8] # the open markers that belong to the filled ones of ls 1, 2, 3
do for [i=1:6] { # read one number of block 2 at a time
    row = (i - 1) % 3
    col = i > 3 ? 4 : 2
    stats dat index 2 every ::row::row using 1 nooutput
    A[i] = STATS_max
    stats dat index 2 every ::row::row using col nooutput
    C[i] = STATS_max
    stats dat index 2 every ::row::row using col + 1 nooutput
    S[i] = STATS_max
}
least = 9; most = 0
do for [i=1:6] { least = S[i] < least ? S[i] : least; most = S[i] > most ? S[i] : most }
set multiplot layout 1,2 margins 0.065,0.985,0.13,0.91 spacing 0.115

set title "D^{α} sin t, begun at t = 0: α = 0, 1/4, 1/2, 3/4, 1"
set xlabel "t"
set xrange [0:3*pi]
set yrange [-1.15:1.6]
set xtics ("0" 0, "π" pi, "2π" 2*pi, "3π" 3*pi)
set ytics -1,0.5,1
unset key
set label 1 "α = 1, the cosine" at 2*pi - 0.1,1.12 right tc rgb BROWN
set label 2 "α = 0, the sine" at 2.5*pi + 0.1,1.12 left tc rgb BLUE
set label 3 "3/4" at 2.125*pi,1.28 center tc rgb PINK # each name stands above its crest, at its own height, so that the names do not touch
set label 4 "1/2" at 2.25*pi,1.44 center tc rgb GREEN
set label 5 "1/4" at 2.375*pi,1.28 center tc rgb RED
set arrow 1 from 2.125*pi,1.22 to 2.125*pi,1.01 nohead lc rgb PINK lw 0.7
set arrow 2 from 2.25*pi,1.38 to 2.25*pi,1.01 nohead lc rgb GREEN lw 0.7
set arrow 3 from 2.375*pi,1.22 to 2.375*pi,1.01 nohead lc rgb RED lw 0.7
plot for [i=1:5] dat index 0 using 1:(column(1+i)) with lines ls i, \
     '' index 0 using 1:7 with lines ls 8 dt (1,3)

set title "Error of Δ^{α} f(t) at t = 1: slope 1"
set xlabel "h"
set ylabel "|Δ^{α} f − D^{α} f|" offset 1.2,0
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xtics autofreq
set ytics autofreq
set xrange [0.00012:0.4]
set yrange [3e-6:0.3]
unset label; unset arrow
set label 1 "sine, α = 0.3" at 0.0008,2.1e-5 right tc rgb BLUE font ",11"
set label 2 "cosine, 0.3" at 0.0008,4.5e-5 right tc rgb BLUE font ",11"
set label 3 "sine, 0.6" at 0.0008,8.0e-5 right tc rgb RED font ",11"
set label 5 "cosine, 0.6" at 0.0008,1.6e-4 right tc rgb RED font ",11"
set label 6 "sine, 0.9" at 0.0008,2.5e-4 right tc rgb GREEN font ",11"
set label 7 "cosine, 0.9" at 0.0008,4.2e-4 right tc rgb GREEN font ",11"
set label 8 "lines: predicted, (1.13)" at 0.006,2e-5 tc rgb "#222222"
set label 4 sprintf("fitted slopes: %.2f to %.2f", least, most) at 0.006,8e-6 tc rgb "#222222"
plot for [i=1:6] C[i] * (x < 0.0009 ? NaN : x) with lines ls 8, \
     for [i=1:3] dat index 1 using 1:(column(1+i)) with points ls i, \
     for [i=4:6] dat index 1 using 1:(column(1+i)) with points ls i-3 pt open[i-3] ps 1 lw 1.2
unset multiplot
