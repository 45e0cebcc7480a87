# figures/fvi/fvi_kick.gp -- Chapter 9: a run from x(0) = 1 at four steps.
# Input: figures/fvi/fvi_kick.c. Output: figures/fvi/fvi_kick.svg.
width = 900; height = 420
load 'figures/style.gp'
array h[4]
do for [i=1:4] {
    stats dat index i-1 using 1 name "H" nooutput
    h[i] = H_min
}
set xrange [0:15]
set xlabel "t"
set multiplot layout 1,2 margins 0.065,0.985,0.25,0.90 spacing 0.06
set key at graph 0.5, graph -0.23 center top horizontal maxrows 1 samplen 2.5 width -1 font ",11"

set title "As printed: the damping acts on x"
set ylabel "x" offset 1,0
set yrange [-16:16]
plot for [i=1:4] dat index i-1 using 2:3 with lines ls 5-i title sprintf("h = %g", h[i])

set title "Held: it acts on x − x_{0}"
unset ylabel
set yrange [-1.6:1.6]
plot for [i=1:4] dat index i-1 using 2:4 with lines ls 5-i title sprintf("h = %g", h[i])
unset multiplot
