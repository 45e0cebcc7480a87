# figures/experiments/experiments_alphas.gp -- Chapter 10: the FVI for several alpha.
# Input: figures/experiments/experiments_alphas.c. Output: figures/experiments/experiments_alphas.svg.
width = 860; height = 500
load 'figures/style.gp'
set title "FVI for several orders of damping, h = 0.5, and the exact solution for α = 1/2"
set xlabel "t"
set ylabel "x"
set xrange [0:15]
set yrange [-1.25:1.7]
set key top right horizontal maxcols 4 width -1
set style line 14 lc rgb "#000000" lw 0.4 pt 7 ps 0.85
styles = "8 6 3 14 5 2 4"
stats dat using 1 skip 1 nooutput
plot dat index 0 using 1:2 with lines lc rgb "#D40000" lw 2.2 title columnheader(2), \
     for [i=1:STATS_blocks - 1] '' index i using 1:2 with linespoints \
         ls int(word(styles, (i - 1) % 7 + 1)) title columnheader(2)
