# figures/experiments/experiments_alphas.gp -- H 10: runs of the FVI for seven alpha.
# Input: figures/experiments/experiments_alphas.c. Output: figures/experiments/experiments_alphas.svg.
width = 860; height = 500
load 'figures/style.gp'
set title "the FVI for seven orders of damping, h = 0.5; thick: the exact motion for α = 1/2"
set xlabel "t"
set ylabel "x"
set xrange [0:15]
set yrange [-1.25:1.25]
set rmargin 12
unset key
styles = "8 6 3 1 5 2 4"
names = "0 1/4 0.4 1/2 0.6 3/4 1"
places = "-1.14 -0.46 -0.22 -0.09 0.05 0.25 0.71"
stats dat using 1 skip 1 nooutput
do for [i=1:STATS_blocks - 1] {
    set label i "α = ".word(names, i) at 15.2,word(places, i) + 0 tc rgb "#222222"
}
plot for [i=1:STATS_blocks - 1] dat index i using 1:2 skip 1 with lines ls int(word(styles, i)) lw 1.2, \
     dat index 0 using 1:2 skip 1 with lines ls 7 lw 2.2, \
     dat index 4 using 1:2 skip 1 with points ls FVI ps 0.9
