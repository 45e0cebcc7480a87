# figures/existence/existence.gp -- H 15: the iterates of Picard's map, and how fast they converge.
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
unset key
set label 1 "n = 0" at 3.9,1.2 right tc rgb BLUE
set label 2 "1" at 3.9,-2.3 right tc rgb RED
set label 3 "2" at 1.16,2.3 right tc rgb GREEN
set label 4 "3" at 1.9,-3.2 right tc rgb PINK
set label 5 "4" at 1.55,2.3 right tc rgb BROWN
set label 6 "5" at 2.4,-3.6 left tc rgb SKY
set label 7 "6" at 2.5,2.2 left tc rgb "#606060"
set label 8 "the solution" at 3.9,-0.15 right tc rgb BLACK
plot for [n=0:6] dat index 0 using 1:(column(2+n)) with lines ls (n == 6 ? 8 : n + 1) \
         lw (n == 6 ? 1.2 : 1.5), \
     '' index 0 using 1:9 with lines ls 7 lw 3

unset label
set title "Largest distance from the solution"
set xlabel "n"
unset xrange
set xrange [0:60]
set logscale y
set format y "10^{%L}"
set yrange [1e-17:1e9]
set ytics 1e-16,1e4
set key on at graph 0.98, graph 0.98 right top Left reverse maxrows 5 samplen 2 width -1 spacing 1.25 # no names at the curves, because they run together
plot dat index 1 using 1:($2 > 4e-16 ? $2 : NaN) with points ls 2 \
         title sprintf("[0, %g], q = %.1f", T_max, LONG_max), \
     '' index 1 using 1:4 with lines ls 2 title "bound (15.8)", \
     '' index 2 using 1:($2 > 4e-16 ? $2 : NaN) with points ls 1 \
         title sprintf("[0, %g], q = %.2f", D_max, SHORT_max), \
     '' index 2 using 1:3 with lines ls 8 title "bound q^n", \
     '' index 2 using 1:4 with lines ls 1 title "bound (15.8)"
unset multiplot
