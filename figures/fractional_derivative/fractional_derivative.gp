# figures/fractional_derivative/fractional_derivative.gp -- Chapter 1: a sine becomes a cosine; the
# Grunwald-Letnikov sum converges. Input: figures/fractional_derivative/fractional_derivative.c.
# Output: figures/fractional_derivative/fractional_derivative.svg.
width = 900; height = 480
load 'figures/style.gp'
array A[6]
array C[6]
array S[6]
array open[3] = [6, 4, 8] # the markers of ls 1, 2, 3, not filled
do for [i=1:6] { # one number of block 2 at a time
    row = (i - 1) % 3
    col = i > 3 ? 4 : 2
    stats dat index 2 every ::row::row using 1 nooutput
    A[i] = STATS_max
    stats dat index 2 every ::row::row using col nooutput
    C[i] = STATS_max
    stats dat index 2 every ::row::row using col + 1 nooutput
    S[i] = STATS_max
}

set multiplot layout 1,2 margins 0.065,0.985,0.13,0.91 spacing 0.1

set title "D^{α} sin t, begun at t = 0"
set xlabel "t"
set xrange [0:4*pi]
set yrange [-1.15:1.75]
set xtics ("0" 0, "π" pi, "2π" 2*pi, "3π" 3*pi, "4π" 4*pi)
set ytics -1,0.5,1
set key at graph 1.0, graph 1.0 right top Left reverse maxrows 2 samplen 1.8 width -4
name(i) = word("0 1/4 1/2 3/4 1", i)
plot for [i=1:5] dat index 0 using 1:(column(1+i)) with lines ls i \
         title "α = ".name(i), \
     '' index 0 using 1:7 with lines ls 8 dt (1,3) title "sin(t + π/4)"

set title "Error of Δ^{α} f(t) at t = 1: slope 1"
set xlabel "h"
set ylabel "|Δ^{α} f − D^{α} f|" offset 1.2,0
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xtics autofreq
set ytics autofreq
set xrange [0.0008:0.4]
set yrange [3e-9:0.3]
set key at graph 0.985, graph 0.02 right bottom Left reverse maxrows 7 samplen 1 width 0
what(i) = sprintf("%s, α = %.1f: fitted slope %.3f", i <= 3 ? "sin" : "cos", A[i], S[i])
plot for [i=1:6] C[i] * x with lines ls 8 title (i == 1 ? "predicted, (1.13)" : ""), \
     for [i=1:3] dat index 1 using 1:(column(1+i)) with points ls i title what(i), \
     for [i=4:6] dat index 1 using 1:(column(1+i)) with points ls i-3 pt open[i-3] ps 1 lw 1.2 title what(i)
unset multiplot
