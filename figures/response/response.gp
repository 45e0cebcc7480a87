# figures/response/response.gp -- H 30: a receptance, and the part of it that comes from two poles.
# Input: figures/response/response.c. Output: figures/response/response.svg.
width = 900; height = 460
load 'figures/style.gp'
set multiplot layout 1,2
set logscale xy
set format "10^{%T}"
set xlabel "ω"
set xrange [10**-1.5:10**1.5]
set title "a body's answer |H| to a force that swings"
set key bottom left # no names at the curves, because they run together at the peak
plot dat index 0 using 1:2 with lines ls 7 title "the body, α = 1/4", \
     '' index 0 using 1:3 with lines ls 2 title "its two poles alone"
set title "what the poles alone are off by, of |H|"
set yrange [1e-4:2]
set key bottom right # no names at the curves, because they cross
name(i) = i == 1 ? "order 2α = 0.1" : i == 2 ? "0.5" : "0.9"
plot for [i=1:3] dat index i using 1:2 with lines ls i title name(i)
unset multiplot
