# figures/integration_by_parts/integration_by_parts.gp -- Chapter 5: looking back, looking ahead; the
# boundary term. Input: figures/integration_by_parts/integration_by_parts.c.
# Output: figures/integration_by_parts/integration_by_parts.svg.
width = 860; height = 470
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.075,0.985,0.135,0.91 spacing 0.1

set title "Half a derivative of a bump, back and ahead"
set xlabel "t"
set xrange [0:1]
set yrange [-3:5.6]
set ytics 1
set arrow 1 from 0.5, graph 0 to 0.5, graph 0.78 nohead ls 8
set label 1 "mirror" at 0.5, graph 0.07 offset 0.8,0 tc rgb "#666666"
set key at graph 0.98, 0.985 right top maxrows 3
plot dat index 0 using 1:2 with lines ls 7 title "the bump", \
     '' index 0 using 1:3 with lines ls 1 lw 2.4 title "Δ_−^{1/2}, looks back: its tail lies after the bump", \
     '' index 0 using 1:4 with lines ls 2 lw 2.4 title "Δ_+^{1/2}, looks ahead: its tail lies before"
unset arrow 1
unset label 1
set title "What is left over when the ends do not vanish"
set xlabel "h"
set ylabel "|h Σ G Δ_−F − h Σ F Δ_+G|" offset 1.2,0
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [0.0032:0.32]
set yrange [0.01:20]
set ytics autofreq
set key at graph 0.98, graph 0.985 right top maxrows 3
stats dat index 1 using 6 nooutput name "END"
plot for [i=1:4] dat index 1 using 1:(column(1+i)) with points ls i \
         title sprintf("α = %s", word("1/4 1/2 3/4 1", i)), \
     for [i=1:4] END_max * x**(1 - i/4.) with lines ls 8 \
         title (i == 1 ? "h^{1−α} |F_0G_0 − F_NG_N|" : "")
unset multiplot
