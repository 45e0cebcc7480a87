# figures/existence/existence.gp -- Chapter 15: iterates of the Picard map and their rate.
# Input: figures/existence/existence.c. Output: figures/existence/existence.svg.
width = 900; height = 480
load 'figures/style.gp'
stats dat index 1 using 5 nooutput name "LONG"
stats dat index 2 using 5 nooutput name "SHORT"
stats dat index 0 using 1 nooutput name "T"
stats dat index 2 using 6 nooutput name "D"
set multiplot layout 1,2 margins 0.065,0.985,0.13,0.91 spacing 0.1

set title "Velocity of the pendulum: iterates n = 0, ..., 6"
set xlabel "t"
set xrange [0:T_max]
set yrange [-5:2.6]
set key at graph 0.02, graph 0.01 left bottom Left reverse maxrows 8 samplen 2 width -1 spacing 1.15
plot for [n=0:6] dat index 0 using 1:(column(2+n)) with lines ls (n == 6 ? 8 : n + 1) \
         lw (n == 6 ? 1.2 : 1.5) title sprintf("n = %d", n), \
     '' index 0 using 1:9 with lines ls 7 lw 3 title "the solution"

set title "Largest distance from the solution"
set xlabel "n"
unset xrange
set xrange [0:60]
set logscale y
set format y "10^{%L}"
set yrange [1e-17:1e9]
set ytics 1e-16,1e4
set key at graph 0.98, graph 0.98 right top Left reverse maxrows 5 samplen 2 width -1 spacing 1.25
plot dat index 1 using 1:($2 > 4e-16 ? $2 : NaN) with points ls 2 \
         title sprintf("[0, %g], q = %.1f", T_max, LONG_max), \
     '' index 1 using 1:4 with lines ls 2 title "bound (15.8)", \
     '' index 2 using 1:($2 > 4e-16 ? $2 : NaN) with points ls 1 \
         title sprintf("[0, %g], q = %.2f", D_max, SHORT_max), \
     '' index 2 using 1:3 with lines ls 8 title "bound q^n", \
     '' index 2 using 1:4 with lines ls 1 title "bound (15.8)"
unset multiplot
