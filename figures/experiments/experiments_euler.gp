# figures/experiments/experiments_euler.gp -- Chapter 10: FVI, Euler's methods, exact.
# Input: figures/experiments/experiments_euler.c. Output: figures/experiments/experiments_euler.svg.
width = 900; height = 640
load 'figures/style.gp'
set xrange [0:15]
set xlabel "t"
set key top right
set multiplot layout 2,2 margins 0.075,0.985,0.085,0.935 spacing 0.1,0.13
set title "h = 0.2: implicit Euler loses"
set ylabel "x"
set yrange [-1.05:1.9]
plot dat index 0 using 1:2 with lines ls 7 lw 1.6 title "exact", \
     '' index 1 using 1:2 every 2 with points ls FVI title "FVI", \
     '' index 2 using 1:2 with lines ls IMPLICIT title "implicit Euler"
set title "h = 0.1: explicit Euler gains"
plot dat index 0 using 1:2 with lines ls 7 lw 1.6 title "exact", \
     '' index 3 using 1:2 every 4 with points ls FVI title "FVI", \
     '' index 4 using 1:2 with lines ls EXPLICIT title "explicit Euler"
unset title
set ylabel "E"
set yrange [0:0.8]
plot dat index 0 using 1:3 with lines ls 7 lw 1.6 title "exact", \
     '' index 1 using 1:3 every 2 with points ls FVI title "FVI", \
     '' index 2 using 1:3 with lines ls IMPLICIT title "implicit Euler"
plot dat index 0 using 1:3 with lines ls 7 lw 1.6 title "exact", \
     '' index 3 using 1:3 every 4 with points ls FVI title "FVI", \
     '' index 4 using 1:3 with lines ls EXPLICIT title "explicit Euler"
unset multiplot
