# figures/experiments_alphas.gp -- Chapter 10: the FVI for several alpha.
# Input: figures/experiments_alphas.c. Output: figures/experiments_alphas.svg.
width = 860; height = 500
load 'figures/style.gp'
set title "FVI for seven orders of damping, h = 0.5, and the exact solution for α = 1/2"
set xlabel "t"
set ylabel "x"
set xrange [0:15]
set yrange [-1.25:1.7]
set key top right horizontal maxcols 4 width -1
names = "α=0 α=¼ α=0.4 α=½ α=0.6 α=¾ α=1"
plot dat index 7 using 1:2 with lines lc rgb "#D40000" lw 2.2 title "exact, α=½", \
     dat index 0 using 1:2 with linespoints ls 8 title word(names, 1), \
     '' index 1 using 1:2 with linespoints ls 6 title word(names, 2), \
     '' index 2 using 1:2 with linespoints ls 3 title word(names, 3), \
     keyentry with points lc rgb "#000000" pt 7 ps 0.85 title word(names, 4), \
     dat index 4 using 1:2 with linespoints ls 5 title word(names, 5), \
     '' index 5 using 1:2 with linespoints ls 2 title word(names, 6), \
     '' index 6 using 1:2 with linespoints ls 4 title word(names, 7), \
     '' index 3 using 1:2 with points lc rgb "#000000" pt 7 ps 0.85 notitle
