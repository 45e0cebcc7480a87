# figures/discrete_mechanics/discrete_mechanics.gp -- H 2: the energy of three methods over 10^5 steps, and a
# pendulum.
# Input: figures/discrete_mechanics/discrete_mechanics.c. Output: figures/discrete_mechanics/discrete_mechanics.svg.
width = 900; height = 440
load 'figures/style.gp'
unset key
set multiplot layout 1,2 margins 0.105,0.985,0.14,0.91 spacing 0.09

set title "a spring: the energy over 100 000 steps"
set xlabel "step k"
set ylabel "E / E_0" offset 1
set logscale y
set xrange [0:1e5]
set xtics ("0" 0, "25 000" 25000, "50 000" 50000, "75 000" 75000, "100 000" 1e5)
set format y "10^{%L}"
set yrange [1e-20:1e20]
set ytics 1e5; unset mytics
set label 1 "explicit Euler" at 40000,1e12 right tc rgb RED
set label 2 "implicit Euler" at 40000,1e-12 right tc rgb PINK
set label 3 "variational, κ = 1/2" at 97000,60 right tc rgb BLUE
set label 4 "lines: (1 + h^2c/m)^{±k}" at 62000,1e-17 right tc rgb "#222222"
plot dat index 0 using 1:5 with lines ls 7, '' index 0 using 1:6 with lines ls 7, \
     '' index 0 using 1:2 with points ls EXPLICIT ps 0.8, \
     '' index 0 using 1:3 with points ls IMPLICIT ps 0.9, \
     '' index 0 using 1:4 with linespoints ls FVI
unset label
unset logscale
set format
set title "a pendulum, h = 0.2: where the runs go"
set xlabel "x"
set ylabel "p" offset 1
set xrange [-3.6:4]
set yrange [-3.2:3.2]
set xtics auto; set ytics auto
set label 1 "explicit Euler swings over the top" at 3.9,2.9 right tc rgb RED
set label 2 "implicit Euler comes to rest" at 3.9,-2.9 right tc rgb PINK
set label 3 "variational, 2000 steps" at 0,-2.35 center tc rgb BLUE
plot dat index 4 using 1:2 with points pt 7 ps 0.2 lc rgb BLUE, \
     dat index 1 using 1:2 with linespoints ls EXPLICIT ps 0.4 lw 1, \
     dat index 2 using 1:2 with linespoints ls IMPLICIT ps 0.4 lw 1
unset multiplot
