# figures/discrete_mechanics/discrete_mechanics.gp -- Chapter 2: energy over 10^5 steps.
# Input: figures/discrete_mechanics/discrete_mechanics.c. Output: figures/discrete_mechanics/discrete_mechanics.svg.
width = 900; height = 500
load 'figures/style.gp'
array rise[4]; array level[4]; array kappa[4]; array h[4]
do for [i=1:4] { # a line through the intervals: its rise over the whole run
    stats dat index i using 1:2 name "B" nooutput
    stats dat index i using 3:4 name "A" nooutput
    rise[i] = B_slope * B_max_x; level[i] = B_mean_y
    kappa[i] = A_min_x; h[i] = A_min_y
}
set logscale y
set xrange [0:1e5]
set xtics ("0" 0, "25 000" 25000, "50 000" 50000, "75 000" 75000, "10^5" 1e5)
set xlabel "step k"
set multiplot layout 1,2 margins 0.09,0.975,0.31,0.92 spacing 0.105
set key at graph 0.5, graph -0.19 center top vertical maxrows 4 samplen 4 Left reverse

set title "Harmonic oscillator: Euler's methods leave, exponentially"
set ylabel "E / E_0"
set format y "10^{%L}"
set yrange [1e-20:1e20]
set ytics 1e5; unset mytics
plot dat index 0 using 1:5 with lines ls 7 title "(1 + h^2c/m)^{±k}", \
     '' index 0 using 1:6 with lines ls 7 notitle, \
     '' index 0 using 1:2 with points ls 2 ps 0.8 title "explicit Euler", \
     '' index 0 using 1:3 with points ls 4 ps 0.9 title "implicit Euler", \
     '' index 0 using 1:4 with linespoints ls 1 title "variational, κ = 1/2"

set title "Pendulum: the energy stays in a band"
set ylabel "largest |E / E_0 − 1| in 400 steps" offset 1,0
set yrange [1e-4:1]
set ytics 10; set mytics 10
plot for [i=1:4] dat index i using 1:2 with lines ls i \
     title sprintf("κ = %g, h = %g: %.2g, drifts by %.0e of it", kappa[i], h[i], level[i], \
                   abs(rise[i]) / level[i])
unset multiplot
