# figures/discrete_principle/discrete_principle.gp -- Chapter 6: the derivatives of the action.
# Input: figures/discrete_principle/discrete_principle.c. Output: figures/discrete_principle/discrete_principle.svg.
width = 900; height = 470
load 'figures/style.gp'
set logscale y
set format y "10^{%L}"
set yrange [1e-18:10]
set ytics 1e3
set xrange [0:60]
set xlabel "k"
set multiplot layout 1,2 margins 0.095,0.985,0.12,0.92 spacing 0.06
set key at graph 0.98, 0.47 right top
unset mytics

set title "y solves the mirrored equation (κ → 1−κ)"
set ylabel offset 0.8 "|derivative of S_d|, per k"
plot dat using 1:2 with lines ls 2 title "unrestricted, |D_x S_d|", \
     '' using 1:5 with lines ls 8 lw 2 title "hρh^{−2α} α_{N−k} y_N", \
     '' using 1:4 every 3::1 with points ls 4 title "restricted, sum to N−1", \
     '' using 1:3 with points ls 1 title "restricted, sum to N"

set title "y is x reversed, κ kept"
unset ylabel
plot dat using 1:7 with lines ls 8 lw 2 title "difference of the forces", \
     '' using 1:6 every 2 with points ls 3 title "restricted, the same κ", \
     '' using 1:3 with points ls 1 title "restricted, κ → 1−κ"
unset multiplot
