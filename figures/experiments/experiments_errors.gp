# figures/experiments/experiments_errors.gp -- H 10: global errors of the FVI.
# Input: figures/experiments/experiments_errors.c. Output: figures/experiments/experiments_errors.svg.
width = 900; height = 430
load 'figures/style.gp'
array slope[3]; array five[3]; array limit[3]; array ink[3] = [BLUE, RED, GREEN]
do for [i=1:3] {
    do for [c=1:4] {
        stats dat index 2 every ::(i-1)::(i-1) using c nooutput
        if (c == 1) { slope[i] = STATS_min }
        if (c == 3) { five[i] = STATS_min }
        if (c == 4) { limit[i] = STATS_min }
    }
}
set logscale x
set xlabel "h"
set xrange [0.0022:0.7]
set xtics (0.5, 0.2, 0.1, 0.05, 0.025, "0.0125" 0.0125, "0.00625" 0.00625, "0.0031" 0.003125)
set xtics rotate by -35
unset key
set multiplot layout 1,2 margins 0.07,0.985,0.18,0.9 spacing 0.08
set title "error / h: a number, as h goes to 0"
set yrange [0:0.24]
set label 1 "x" at 0.0036,0.194 tc rgb BLUE
set label 2 "p" at 0.0036,0.218 tc rgb RED
set label 3 "energy" at 0.05,0.072 center tc rgb GREEN
set label 4 sprintf("limits %.4f, %.4f", limit[2], limit[1]) at 0.105,0.222 tc rgb "#222222"
set label 5 sprintf("limit %.4f", limit[3]) at 0.0032,0.069 tc rgb "#222222"
plot limit[1] with lines ls 8, limit[2] with lines ls 8, limit[3] with lines ls 8, \
     for [b=0:1] for [i=1:3] dat index b using 1:(column(i + 1) / $1) with linespoints ls i dt 1
unset label
set title "the slope between two neighbours"
set yrange [0.8:1.1]
set label 1 sprintf("fitted: x %.2f, p %.2f, energy %.2f", five[1], five[2], five[3]) at graph 0.05,0.13 tc rgb "#222222"
set label 2 sprintf("and with h = 0.003125: %.3f, %.3f, %.3f", slope[1], slope[2], slope[3]) at graph 0.05,0.06 tc rgb "#222222"
set label 3 "energy" at 0.026,0.985 tc rgb GREEN
set label 4 "x, p" at 0.09,0.93 tc rgb BLUE
before = NaN; last = NaN
between(i) = (y = log(column(i + 1)), x_ = log($1), s = (y - before) / (x_ - last), before = y, last = x_, s)
middle(h) = h * sqrt(2)
plot 1 with lines ls 8, \
     for [i=1:3] before = last = NaN dat index 0 using (middle($1)):(between(i)) with linespoints ls i dt 1
unset multiplot
