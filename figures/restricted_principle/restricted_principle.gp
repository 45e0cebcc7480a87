# figures/restricted_principle/restricted_principle.gp -- H 3: the varied curves, and their action.
# Input: figures/restricted_principle/restricted_principle.c. Output:
# figures/restricted_principle/restricted_principle.svg.
width = 920; height = 450
load 'figures/style.gp'
unset key
set multiplot
set origin 0,0; set size 0.6,1
set title "one bump, added to both curves"
set xlabel "t"
set ylabel "position" offset 1
stats dat index 0 using 1 nooutput name "t"
set xrange [0:t_max]
set yrange [-0.6:0.95]
set style arrow 1 head filled size screen 0.012,20 lc rgb BLUE lw 1.6
set style arrow 2 head filled size screen 0.012,20 lc rgb RED lw 1.6
set arrow from graph 0.30,0.045 to graph 0.44,0.045 as 1
set arrow from graph 0.70,0.045 to graph 0.56,0.045 as 2
set label 1 "time of x" at graph 0.28,0.045 right font ",12" tc rgb BLUE
set label 2 "time of y" at graph 0.72,0.045 left font ",12" tc rgb RED
set label 3 "x + εδ" at 0.86,0.83 tc rgb BLUE
set label 4 "x" at 0.7,0.38 center tc rgb BLUE
set label 5 "y + εδ" at 2.2,0.54 center tc rgb RED
set label 6 "y" at 0.72,-0.41 center tc rgb RED
set label 7 "x + εδ reversed" at 2.28,0.87 center tc rgb "#606060"
plot dat index 0 using 1:2:4 with filledcurves fc rgb BLUE fs transparent solid 0.14 noborder, \
     '' index 0 using 1:3:5 with filledcurves fc rgb RED fs transparent solid 0.14 noborder, \
     '' index 0 using 1:6 with lines ls 8, \
     '' index 0 using 1:2 with lines ls 1 lw 1, '' index 0 using 1:4 with lines ls 1 lw 2.4, \
     '' index 0 using 1:3 with lines ls 2 lw 1, '' index 0 using 1:5 with lines ls 2 lw 2.4
unset arrow; unset label

set origin 0.6,0; set size 0.4,1
set title "the action, against ε"
set xlabel "ε"
set ylabel "S(ε) − S(0)"
set xrange [-0.5:0.5]
set yrange [-0.55:0.2]
set label 1 "tangent" at 0.48,0.13 right tc rgb "#606060"
set label 2 "x alone" at 0.5,-0.14 right tc rgb RED
set label 3 "both, δx = δy" at 0,-0.42 center tc rgb BLUE
plot dat index 1 using 1:4 with lines ls 8, \
     '' index 1 using 1:3 with linespoints ls 2, \
     '' index 1 using 1:2 with linespoints ls 1
unset multiplot
