# figures/integration_by_parts/integration_by_parts.gp -- H 5: the two half derivatives of a bump, and the boundary
# term of fractional integration by parts.
# Input: figures/integration_by_parts/integration_by_parts.c. Output:
# figures/integration_by_parts/integration_by_parts.svg.
width = 860; height = 470
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.075,0.985,0.135,0.91 spacing 0.1

set title "Half a derivative of a bump, back and ahead"
set xlabel "t"
set xrange [0:1]
set yrange [-2.6:3.6]
set ytics 1
set arrow 1 from 0.5, graph 0 to 0.5, graph 1 nohead ls 8
set label 1 "mirror" at 0.5, graph 0.07 offset 0.8,0 tc rgb "#666666"
unset key
set label 2 "the bump" at 0.66,0.5 left tc rgb "#222222"
set label 3 "looks back:\ntail after" at 0.98,-1.5 right tc rgb BLUE
set label 4 "looks ahead:\ntail before" at 0.02,-1.5 left tc rgb RED
plot dat index 0 using 1:2 with lines ls 7, \
     '' index 0 using 1:3 with lines ls 1 lw 2.4, \
     '' index 0 using 1:4 with lines ls 2 lw 2.4
unset arrow 1
unset label
set title "What is left over when the ends do not vanish"
set xlabel "h"
set ylabel "|h Σ G Δ_−F − h Σ F Δ_+G|" offset 1.2,0
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [0.0032:0.32]
set yrange [0.01:3]
set ytics autofreq
set label 1 "α = 1" at 0.02,1.3 center tc rgb PINK
set label 2 "3/4" at 0.02,0.5 center tc rgb GREEN
set label 3 "1/2" at 0.02,0.185 center tc rgb RED
set label 4 "1/4" at 0.02,0.036 center tc rgb BLUE
set label 5 "lines: h^{1−α} |F_0G_0 − F_NG_N|" at 0.004,2.1 tc rgb "#222222"
stats dat index 1 using 6 nooutput name "END"
plot for [i=1:4] dat index 1 using 1:(column(1+i)) with points ls i, \
     for [i=1:4] END_max * x**(1 - i/4.) with lines ls 8
unset multiplot
