# figures/convolution_quadrature/convolution_quadrature.gp -- H 13: the error against h of three methods, with orders
# 1 and 2.
# Input: figures/convolution_quadrature/convolution_quadrature.c. Output:
# figures/convolution_quadrature/convolution_quadrature.svg.
width = 920; height = 420
load 'figures/style.gp'
array name[3] = ["fvi", "fvi-shifted", "fvi-bdf2"]
array slope[6]; array level[6]
do for [b=0:1] { do for [i=1:3] { # fit the slopes to the finer half of the steps
    stats dat index b every ::3 using (log($1)):(log(column(i + 1))) name "S" nooutput
    slope[3*b + i] = S_slope; level[3*b + i] = S_intercept
} }
order(i) = i == 1 ? 1 : 2
# Return the line of order 1 or 2 that crosses the fitted line at h = 0.002.
line(j, i, h) = exp(level[j] + (slope[j] - order(i)) * log(0.002)) * h**order(i)
label(j, i) = sprintf("%s: slope %.2f, line %d", name[i], slope[j], order(i))
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "h"
set multiplot layout 1,2 margins 0.085,0.985,0.14,0.91 spacing 0.085
unset key

set title "Bagley-Torvik, α = 3/4, t ≤ 20"
set ylabel "largest error of x"
set yrange [1e-8:1]
set xrange [2.5e-4:0.15]
set label 1 label(1, 1) at 4e-4,2e-2 tc ls FVI
set label 2 label(2, 2) at 0.14,1.5e-6 right tc ls SHIFTED
set label 3 label(3, 3) at 4e-4,2e-4 tc ls BDF2
plot for [i=1:3] line(i, i, x) with lines ls 10 + i, \
     for [i=1:3] dat index 0 using 1:(column(i + 1)) with points ls 10 + i ps 0.9

set title "Duffing along t⁴, α = 1/4, t ≤ 1"
unset ylabel
set label 1 label(4, 1) at 4e-4,2e-3
set label 2 label(5, 2) at 0.13,1.2e-6 right
set label 3 label(6, 3) at 0.13,2e-7 right
plot for [i=1:3] line(3 + i, i, x) with lines ls 10 + i, \
     for [i=1:3] dat index 1 using 1:(column(i + 1)) with points ls 10 + i ps 0.9
unset multiplot
