# figures/memory/memory.gp -- H 12: the weights of the memory as a sum of exponentials.
# Input: figures/memory/memory.c. Output: figures/memory/memory.svg.
width = 900; height = 460
load 'figures/style.gp'
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "lag n"
set multiplot layout 1,2 margins 0.085,0.985,0.13,0.91 spacing 0.1

set title "The weights of order 1/2 and their modes (δ = 10^{−4}, N = 10^6)" offset 0,-0.3
set xrange [1:1e8]
set yrange [1e-13:1e2]
set xtics 100
set ytics 1e2
unset key
set label 3 "thick: their sum and |w_n|" at 1e4,1e-3 tc rgb BLUE
set label 4 "thin: each mode" at 1e4,6e-5 tc rgb SKY
set arrow 1 from 33, graph 0 to 33, graph 1 nohead ls 8
set arrow 2 from 1e6, graph 0 to 1e6, graph 0.5 nohead ls 8
set label 1 "window" at 1.5, 1e1
set label 2 "33 ≤ n ≤ N" at 60, 1e1
plot dat index 2 using 1:2 with lines ls 6 dt 1 lw 0.8, \
     '' index 0 using 1:3 with lines ls 2, \
     '' index 0 using 1:2 with lines ls 1

set title "Relative error of the sum, and what was promised"
set xrange [1:1e6]
set yrange [1e-15:3]
unset label
set label 1 "δ = 10^{−4}, promised" at 200,2.5e-5 tc rgb "#222222"
set label 2 "δ = 10^{−8}" at 200,2.5e-9 tc rgb "#222222"
set label 3 "δ = 10^{−12}" at 200,2.5e-13 tc rgb "#222222"
set label 4 "window" at 1.5,1e-9
unset arrow 2
set ytics 1e3
plot dat index 1 using 1:2 with lines ls 1, \
     '' index 1 using 1:3 with lines ls 3, \
     '' index 1 using 1:4 with lines ls 2, \
     x >= 33 ? 1e-4 : NaN with lines ls 8, \
     x >= 33 ? 1e-8 : NaN with lines ls 8, \
     x >= 33 ? 1e-12 : NaN with lines ls 8
unset multiplot
