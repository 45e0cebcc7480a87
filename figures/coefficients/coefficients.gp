# figures/coefficients/coefficients.gp -- Chapter 4: rounding in six formulas for alpha_n.
# Input: figures/coefficients/coefficients.c. Output: figures/coefficients/coefficients.svg.
width = 860; height = 520
load 'figures/style.gp'
stats dat index 0 using 8 name 'LEFT' nooutput
stats dat index 1 using 8 name 'RIGHT' nooutput
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [2:1e6]
set yrange [0.2:1e9]
set xlabel "n"
set multiplot layout 1,2 margins 0.085,0.985,0.25,0.92 spacing 0.075
set key at screen 0.985, screen 0.01 right bottom vertical maxrows 2 width 0

set title sprintf("α = %g", LEFT_max)
set ylabel "largest relative error up to n, in units of 2^{-53}"
plot dat index 0 using 1:7 with lines ls 2 title "exp(lgamma)", \
     '' index 0 using 1:2 with lines ls 5 title "s(n−1−α)/n, the textbook", \
     '' index 0 using 1:3 with lines ls 6 title "s((n−1−α)/n)", \
     '' index 0 using 1:5 with lines ls 4 title "s − s(1+α)/n", \
     '' index 0 using 1:4 with lines ls 3 title "s(1−(1+α)/n)", \
     '' index 0 using 1:6 with lines ls 1 lw 3 title "double-double, our default"

set title sprintf("α = %g", RIGHT_max)
unset ylabel
set key at graph 0.98, graph 0.60 right top maxrows 1
plot dat index 1 using 1:7 with lines ls 2 notitle, \
     '' index 1 using 1:2 with lines ls 5 notitle, \
     '' index 1 using 1:3 with lines ls 6 notitle, \
     '' index 1 using 1:5 with lines ls 4 notitle, \
     '' index 1 using 1:4 with lines ls 3 notitle, \
     '' index 1 using 1:6 with lines ls 1 lw 3 notitle, \
     sqrt(x) with lines ls 8 title "√n"
unset multiplot
