# figures/variable_steps/variable_steps.gp -- H 22: the steps of a run, and the modes of its memory, on the same
# ladder of lengths.
# Input: figures/variable_steps/variable_steps.c. Output: variable_steps.svg.
width = 900; height = 470
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.07,0.985,0.13,0.91 spacing 0.09
set title "Bagley and Torvik's problem: all the steps there are"
set xlabel "t"
set ylabel "x"
set xrange [0:20]
plot dat index 0 using 1:2 with lines ls 1 notitle, \
     dat index 1 using 2:3 with points ls 2 pt 7 ps 0.7 title "ends of steps"

set title "Their lengths, and the times 1/σ of the modes"
set xlabel "number of the step"
set ylabel "time" offset 1
stats dat index 1 using 1 name "N" nooutput
set xrange [0:N_max + 1]
set logscale y
set format y "10^{%L}"
set yrange [1e-8:1e8]
set ytics 1e2
unset grid
set key at graph 0.98, graph 0.99 top right # marks have no curve that could carry their names
set style line 9 lc rgb "#5f7a8e" dt 1 lw 1.4
# Draw only the modes whose 1/sigma is nearest to one of five powers of ten. Two of these modes end as the steps grow.
near(y, e) = abs(log(y) - e * log(10)) < 0.13 ? y : NaN
do for [e in "3 0 -3 -5 -6"] { set label (e == 0 ? "1/σ = 1" : sprintf("1/σ = 10^{%s}", e)) at (e == -3 ? 30 : 9.5),10**(e + 0.45) center tc rgb "#48606f" font ",11" }
plot for [e in "3 0 -3 -5 -6"] dat index 2 using 1:(near($2, e)) with lines ls 9 notitle, \
     dat index 1 using ($5 == 1 ? $1 : NaN):4 with points ls 2 pt 7 ps 0.6 title "h, on a rung", \
     dat index 1 using ($5 == 0 ? $1 : NaN):4 with points ls 2 pt 6 ps 0.8 title "h, to meet a time"
unset multiplot
