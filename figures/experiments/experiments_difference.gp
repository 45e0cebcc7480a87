# figures/experiments/experiments_difference.gp -- H 10: x of the FVI minus x of the Lagrange-d'Alembert integrator.
# Input: figures/experiments/experiments_difference.c. Output: figures/experiments/experiments_difference.svg.
width = 860; height = 400
load 'figures/style.gp'
set title "x^{FVI} − x^{LdA}, α = 1/2, h = 0.2"
set xlabel "t"
set ylabel "difference, in units of 2^{-53}"
set xrange [0:30]
set yrange [-18:18]
set xzeroaxis lc rgb "#444444"
unset key
set label 1 "Algorithm 3 as printed, two sums" at 8.2,16.5 tc ls PRINTED
set label 2 "momentum form" at 13.2,-6 center tc ls FVI
plot dat using 1:3 with linespoints ls PRINTED, \
     '' using 1:2 with linespoints ls FVI
