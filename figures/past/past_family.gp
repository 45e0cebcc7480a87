# figures/past/past_family.gp -- H 19: a body that is held and let go, for seven alpha.
# Input: figures/past/past_family.c. Output: figures/past/past_family.svg.
width = 860; height = 500
load 'figures/style.gp'
set datafile missing "-"
set title "held at 1, let go with momentum 1/2: a run of fvi-lobatto4 (lines), the exact motion (dots)"
set xlabel "t"
set ylabel "x"
set xrange [0:15]
set yrange [-1.3:1.45]
set rmargin 12
unset key
styles = "8 6 3 7 5 2 4"
ls_of(i) = int(word(styles, i % 7 + 1))
stats dat using 1 nooutput
# The last line of a block holds the name of its curve.
plot for [i=0:STATS_blocks - 1] dat index i using 1:2 with lines ls ls_of(i) lw 1.8, \
     for [i=0:STATS_blocks - 1] '' index i using 1:3 with points ls ls_of(i) pt 7 ps 0.45, \
     for [i=0:STATS_blocks - 1] '' index i every ::301::301 \
         using 1:2:4 with labels left offset 0.7,0 textcolor rgb "#222222"
