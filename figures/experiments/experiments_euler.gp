# figures/experiments/experiments_euler.gp -- H 10: the FVI beside explicit and implicit Euler.
# Input: figures/experiments/experiments_euler.c. Output: figures/experiments/experiments_euler.svg.
width = 900; height = 640
load 'figures/style.gp'
set xrange [0:15]
set xlabel "t"
unset key
INK = "#222222"
set multiplot layout 2,2 margins 0.08,0.985,0.085,0.935 spacing 0.1,0.13
set title "h = 0.2: implicit Euler loses too much"
set ylabel "x" offset 1.5
set yrange [-1.2:1.3]
set label 1 "exact; dots: FVI" at 6.9,0.75 center tc rgb INK
set label 2 "implicit Euler" at 7.05,-0.3 center tc ls IMPLICIT
plot dat index 0 using 1:2 with lines ls 7 lw 1.6, \
     '' index 1 using 1:2 every 2 with points ls FVI, \
     '' index 2 using 1:2 with lines ls IMPLICIT
set title "h = 0.1: explicit Euler loses too little"
unset label 1
set label 2 "explicit Euler" at 6.75,0.98 center tc ls EXPLICIT
plot dat index 0 using 1:2 with lines ls 7 lw 1.6, \
     '' index 3 using 1:2 every 4 with points ls FVI, \
     '' index 4 using 1:2 with lines ls EXPLICIT
unset title
set ylabel "E" offset 1
set yrange [0:0.8]
set label 1 "exact; dots: FVI" at 3,0.42 left tc rgb INK
set label 2 "implicit Euler" at 0.3,0.04 left tc ls IMPLICIT
plot dat index 0 using 1:3 with lines ls 7 lw 1.6, \
     '' index 1 using 1:3 every 2 with points ls FVI, \
     '' index 2 using 1:3 with lines ls IMPLICIT
set label 1 "exact; dots: FVI" at 0.3,0.15 left
set label 2 "explicit Euler" at 5,0.52 left tc ls EXPLICIT
plot dat index 0 using 1:3 with lines ls 7 lw 1.6, \
     '' index 3 using 1:3 every 4 with points ls FVI, \
     '' index 4 using 1:3 with lines ls EXPLICIT
unset multiplot
