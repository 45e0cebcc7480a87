# figures/coefficients/coefficients.gp -- H 4: rounding in six formulas for alpha_n.
# Input: figures/coefficients/coefficients.c. Output: figures/coefficients/coefficients.svg.
width = 860; height = 440
load 'figures/style.gp'
stats dat index 0 using 8 name 'LEFT' nooutput
stats dat index 1 using 8 name 'RIGHT' nooutput
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [2:1e6]
set yrange [0.1:2e8]
set xlabel "n"
set multiplot layout 1,2 margins 0.085,0.985,0.13,0.92 spacing 0.075
unset key

set title sprintf("α = %g", LEFT_max)
set ylabel "largest relative error up to n, in units of 2^{-53}"
set label 1 "exp(lgamma)" at 4e3,3e6 right tc ls 2
set label 2 "s(n−1−α)/n, the textbook" at 1.2e4,4e4 center rotate by 26 tc ls 5
set label 3 "s((n−1−α)/n), the same" at 3e4,1e3 center rotate by 26 tc ls 6
set label 4 "s − s(1+α)/n" at 9e5,2.2e1 right tc ls 4
set label 5 "s(1−(1+α)/n)" at 9e5,6 right tc ls 3
set label 6 "double-double, our default" at 3e1,0.3 tc ls 1
plot dat index 0 using 1:7 with lines ls 2, \
     '' index 0 using 1:2 with lines ls 5, \
     '' index 0 using 1:3 with lines ls 6, \
     '' index 0 using 1:5 with lines ls 4, \
     '' index 0 using 1:4 with lines ls 3, \
     '' index 0 using 1:6 with lines ls 1 lw 3

set title sprintf("α = %g", RIGHT_max)
unset ylabel
unset label
set label 1 "exp(lgamma)" at 4e3,3e6 right tc ls 2
set label 2 "√n" at 1.5e5,1.5e3 right tc rgb "#606060"
set label 3 "the four recurrences" at 9e5,4.2 right
set label 4 "double-double" at 9e5,0.3 right tc ls 1
plot dat index 1 using 1:7 with lines ls 2, \
     '' index 1 using 1:2 with lines ls 5, \
     '' index 1 using 1:3 with lines ls 6, \
     '' index 1 using 1:5 with lines ls 4, \
     '' index 1 using 1:4 with lines ls 3, \
     '' index 1 using 1:6 with lines ls 1 lw 3, \
     sqrt(x) with lines ls 8
unset multiplot
