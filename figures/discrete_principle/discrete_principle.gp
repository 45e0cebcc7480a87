# figures/discrete_principle/discrete_principle.gp -- H 6: which derivatives of the discrete action vanish.
# Input: figures/discrete_principle/discrete_principle.c. Output: figures/discrete_principle/discrete_principle.svg.
width = 900; height = 470
load 'figures/style.gp'
set logscale y
set format y "10^{%L}"
set yrange [1e-18:10]
set ytics 1e3
set xrange [0:60]
set xlabel "k"
set multiplot layout 1,2 margins 0.095,0.985,0.12,0.92 spacing 0.075
unset key
unset mytics

set title "y solves the mirrored equation (κ → 1−κ)"
set ylabel offset 0.8 "|derivative of S_d|, per k"
set label 1 "unrestricted, |D_x S_d|" at 2,1 tc ls 2
set label 2 "restricted, sum to N−1: diamonds" at 2,2e-5 tc ls 4
set label 3 "hρh^{−2α} α_{N−k} y_N: dashes" at 2,2e-6 tc rgb "#606060"
set label 4 "restricted, sum to N" at 2,1e-13 tc ls 1
plot dat using 1:2 with lines ls 2, \
     '' using 1:5 with lines ls 8 lw 2, \
     '' using 1:4 every 3::1 with points ls 4, \
     '' using 1:3 with points ls 1

set title "y is x reversed, κ kept"
unset ylabel
unset label
set label 1 "restricted, the same κ: triangles" at 2,2e-2 tc ls 3
set label 2 "difference of the forces: dashes" at 2,2e-3 tc rgb "#606060"
set label 3 "restricted, κ → 1−κ" at 2,1e-13 tc ls 1
plot dat using 1:7 with lines ls 8 lw 2, \
     '' using 1:6 every 2 with points ls 3, \
     '' using 1:3 with points ls 1
unset multiplot
