# figures/fractional_derivative/fractional_derivative_kernel.gp -- H 1: the kernels (1.3), which say how strongly each
# time of the past counts.
# Drawn from the formula. Output: figures/fractional_derivative/fractional_derivative_kernel.svg.
width = 900; height = 400
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.08,0.985,0.15,0.9 spacing 0.09
unset key
kernel(a, t) = t**(-a) / gamma(1 - a)
array order[4] = [0.25, 0.5, 0.75, 0.95]
set xlabel "age t − τ of what is remembered"
set ylabel "its weight"
set title "a second"
set xrange [0:1]
set yrange [0:2.5]
set samples 2000
set label 1 "α = 1/4" at 0.62,1.02 tc rgb "#222222"
set label 2 "1/2" at 0.80,0.72 tc rgb "#222222"
set label 3 "3/4" at 0.80,0.42 tc rgb "#222222"
set label 4 "0.95" at 0.80,0.15 tc rgb "#222222"
plot for [i=1:4] kernel(order[i], x) with lines ls i
set title "five decades"
unset ylabel
set logscale xy
set format "10^{%T}"
set xrange [1e-2:1e3]
set yrange [1e-4:1e2]
set label 1 at 60,0.45
set label 2 at 60,0.13
set label 3 at 60,0.022
set label 4 at 60,0.0019
plot for [i=1:4] kernel(order[i], x) with lines ls i
unset multiplot
