# figures/discrete_principle/discrete_principle_surface.gp -- H 6: the action as a function of two variations.
# Input: figures/discrete_principle/discrete_principle_surface.c. Output:
# figures/discrete_principle/discrete_principle_surface.svg.
width = 900; height = 420
load 'figures/style.gp'
set table $levels
set contour base
unset surface
set cntrparam levels incremental -0.4,0.0125,0.4
splot dat index 0 using 1:2:3
unset table
unset contour
set surface
set multiplot layout 1,2 margins 0.08,0.985,0.14,0.9 spacing 0.1
unset key
set title "level lines of the action"
set xlabel "ε: x + εδ"
set ylabel "η: y + ηδ"
set xrange [-0.5:0.5]
set yrange [-0.5:0.5]
set label 1 "ε = η" at 0.3,0.36 right tc rgb "#0072B2"
set label 2 "x alone" at 0.48,0.04 right tc rgb "#D55E00"
plot $levels using 1:2 with lines lc rgb "#888888" lw 0.8, \
     x with lines ls 1 lw 2.4, 0 with lines ls 2 lw 2.4, \
     '+' using (0):(0) every ::0::0 with points pt 7 ps 0.9 lc rgb "#000000"
unset label
set title "the action along two lines"
set xlabel "ε"
set ylabel "S − S(0, 0)"
set yrange [*:*]
set label 1 "both bent, ε = η" at 0,graph 0.3 center tc rgb "#0072B2"
set label 2 "x alone" at -0.47,0.006 tc rgb "#D55E00"
plot 0 with lines lc rgb "#888888" lw 0.8, \
     dat index 1 using 1:2 with lines ls 1 lw 2.4, '' index 1 using 1:3 with lines ls 2 lw 2.4
unset multiplot
