# figures/experiments/experiments_errors.gp -- Chapter 10: global errors of the FVI.
# Input: figures/experiments/experiments_errors.c. Output: figures/experiments/experiments_errors.svg.
width = 900; height = 500
load 'figures/style.gp'
array slope[3]; array K[3]; array five[3]; array limit[3]
do for [i=1:3] {
    do for [c=1:4] {
        stats dat index 2 every ::(i-1)::(i-1) using c nooutput
        if (c == 1) { slope[i] = STATS_min }
        if (c == 2) { K[i] = STATS_min }
        if (c == 3) { five[i] = STATS_min }
        if (c == 4) { limit[i] = STATS_min }
    }
}
set logscale xy
set format y "10^{%L}"
set xlabel "h"
set xrange [0.0025:0.65]
set xtics (0.5, 0.25, 0.1, 0.05, 0.025, "0.0125" 0.0125, "0.00625" 0.00625, "0.003125" 0.003125) rotate by -35
set key bottom right
label(i) = sprintf("slope %.3f (%.2f down to 0.00625)", slope[i], five[i])
set multiplot layout 1,2 margins 0.085,0.985,0.16,0.925 spacing 0.09
set title "position and momentum"
set ylabel "largest error up to t = 15"
set yrange [4e-5:0.2]
plot dat index 0 using 1:2 with points ls 1 ps 0.9 title "x: ".label(1), \
     [0.003125:0.1] K[1] * x**slope[1] with lines ls 1 notitle, \
     dat index 0 using 1:3 with points ls 2 ps 0.9 title "p: ".label(2), \
     [0.003125:0.1] K[2] * x**slope[2] with lines ls 2 notitle, \
     dat index 1 using 1:2 with points lc rgb "#0072B2" pt 6 ps 0.9 title "x, not fitted", \
     dat index 1 using 1:3 with points lc rgb "#D55E00" pt 4 ps 0.9 title "p, not fitted", \
     limit[1] * x with lines ls 8 title sprintf("limit for x, predicted: %.4f h", limit[1])
set title "energy"
unset ylabel
set yrange [2e-5:0.06]
plot dat index 0 using 1:4 with points ls 3 ps 1 title "E: ".label(3), \
     [0.003125:0.1] K[3] * x**slope[3] with lines ls 3 notitle, \
     dat index 1 using 1:4 with points lc rgb "#009E73" pt 8 ps 1 title "E, not fitted", \
     limit[3] * x with lines ls 8 title sprintf("limit, predicted: %.4f h", limit[3])
unset multiplot
