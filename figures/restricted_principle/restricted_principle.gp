# figures/restricted_principle/restricted_principle.gp -- Chapter 3: the varied curves, the action.
# Input: figures/restricted_principle/restricted_principle.c. Output: figures/restricted_principle/restricted_principle.svg.
width = 920; height = 480
load 'figures/style.gp'
set multiplot
set origin 0,0; set size 0.6,1
set title "One bump, added to both curves"
set xlabel "t"
set ylabel "position" offset 1
stats dat index 0 using 1 nooutput name "t"
set xrange [0:t_max]
set yrange [-0.55:1.2]
set key at graph 0.95, 0.99 right top vertical maxrows 2 width -6 samplen 2.5 Left reverse
set style arrow 1 head filled size screen 0.012,20 lc rgb "#0072B2" lw 1.6
set style arrow 2 head filled size screen 0.012,20 lc rgb "#D55E00" lw 1.6
set arrow from graph 0.30,0.035 to graph 0.44,0.035 as 1
set arrow from graph 0.70,0.035 to graph 0.56,0.035 as 2
set label "time of x" at graph 0.28,0.035 right font ",12"
set label "time of y" at graph 0.72,0.035 left font ",12"
plot dat index 0 using 1:2 with lines ls 1 title "x", \
     '' index 0 using 1:4 with linespoints ls 1 pointinterval 12 title "x + εδ", \
     '' index 0 using 1:3 with lines ls 2 title "y", \
     '' index 0 using 1:5 with linespoints ls 2 pointinterval 12 title "y + εδ", \
     '' index 0 using 1:6 with lines ls 8 lw 2 title "x + εδ reversed"
unset arrow; unset label

set origin 0.6,0; set size 0.4,1
set title "The action along the variation"
set xlabel "ε"
set ylabel "S(ε) − S(0)"
set xrange [-0.5:0.5]
set yrange [*:*]
set key default
set key inside bottom center vertical maxrows 3 spacing 1.25 samplen 3 font ",12"
plot dat index 1 using 1:4 with lines ls 8 lw 2 title "tangent ε δS", \
     '' index 1 using 1:3 with linespoints ls 2 title "x alone", \
     '' index 1 using 1:2 with linespoints ls 1 title "restricted, δx = δy"
unset multiplot
