# figures/step_search/step_search.gp -- Chapter 18: run time against error.
# Input: figures/step_search/step_search.tsv (make bench).
# Output: figures/step_search/step_search.svg.
width = 1000; height = 900
load 'figures/style.gp'
tsv = 'figures/step_search/step_search.tsv'
set datafile separator "\t"
ours = "fvi fvi-shifted fvi-bdf2 fvi-lobatto2 fvi-lobatto3 fvi-lobatto4"
style(i) = word("6 1 3 4 5 2", i) + 0
data(P, name) = sprintf("P%d %s:", P, name)
peers(P) = P == 1 ? "'product trapezoid' 'matrix method'" \
    : P == 2 ? "'product trapezoid' 'explicit Euler' 'implicit Euler'" \
    : "'product trapezoid'"
array title[4] = [ "P1  x'' + D^{3/2}x + x = step, T = 20", \
                   "P2  x'' + 0.2 x' + x = 0, T = 20", \
                   "P3  x'' + 0.5 D^{0.6}x + x^3 = cos t, T = 50", \
                   "P4  a chain of 32 Duffing oscillators, T = 20" ]
set multiplot

# the legend, in a strip of its own above the panels
set tmargin at screen 0.995; set bmargin at screen 0.87
set lmargin at screen 0.01; set rmargin at screen 0.99
unset border; unset tics; unset grid
set key center center Left reverse maxrows 4 samplen 4 width 3
set xrange [0:1]; set yrange [0:1]
plot for [i=1:6] NaN with linespoints ls style(i) title word(ours, i), \
     NaN with lines lc rgb "#222222" lw 1.4 dt (2,3) title "dotted: with the direct sum", \
     NaN with linespoints ls 7 lw 2.5 title "peer: product trapezoid, FFT", \
     NaN with linespoints ls 8 pt 1 title "peer: matrix method", \
     NaN with linespoints ls 8 pt 3 title "peer: explicit Euler", \
     NaN with linespoints ls 8 pt 8 title "peer: implicit Euler"

set border 3; set grid; set ytics nomirror
unset key
set logscale xy
set format x "10^{%L}"; set format y "10^{%L}"
set xrange [3:3e-16]; set xtics nomirror (1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14)
set xlabel "largest error of x, t >= 2" offset 0,0.3
set ylabel "seconds" offset 1
do for [P=1:4] {
    column = (P - 1) % 2; row = (P - 1) / 2
    set lmargin at screen 0.075 + 0.49 * column
    set rmargin at screen 0.50 + 0.49 * column
    set tmargin at screen 0.825 - 0.43 * row
    set bmargin at screen 0.51 - 0.43 * row
    set yrange [P == 4 ? 1e-4 : 5e-7 : P == 4 ? 3 : 1.5]
    set title title[P] offset 0,-0.4
    direct = P == 2 ? "" : ", direct" # a damping of order 1 has no memory
    plot for [i=1:6] tsv index data(P, word(ours, i).direct) using 3:2 \
             with lines lc rgb word("#56B4E9 #0072B2 #009E73 #CC79A7 #E69F00 #D55E00", i) lw 1.4 dt (2,3), \
         for [i=1:6] tsv index data(P, word(ours, i)) using 3:2 with linespoints ls style(i), \
         for [i=1:words(peers(P))] tsv index data(P, word(peers(P), i)) using 3:2 \
             with linespoints ls i == 1 ? 7 : 8 lw i == 1 ? 2.5 : 1.2 \
             pt i == 1 ? 2 : P == 1 ? 1 : i == 2 ? 3 : 8
}
unset multiplot
