# figures/half_derivative/half_derivative.gp -- H 7: the weights of two half derivatives in a row vanish up to
# rounding.
# Input: figures/half_derivative/half_derivative.c. Output: figures/half_derivative/half_derivative.svg.
width = 860; height = 480
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.09,0.97,0.13,0.91 spacing 0.11
set format y "10^{%L}"
set logscale y
unset mytics
set title "Half a derivative once, and twice (α = 1/2)"
set logscale x
set format x "10^{%L}"
set xrange [1:1e4]
set yrange [1e-24:1e1]
set xlabel "n"
set ylabel "weight, absolute value" offset 0.5,0
unset key
set label 2 "once: |α_n|, like n^{−3/2}" at 30,3e-2 tc rgb BLUE
set label 3 "bound on rounding, (7.6)" at 30,1e-15 tc rgb "#606060"
set label 4 "twice: |c_n|" at 200,1e-22 right tc rgb RED
set label 1 "exactly 0\nfor 2 ≤ n ≤ 31" at 2, 1e-20 tc rgb "#444444"
plot dat index 0 using 1:2 with lines ls 1 lw 2.4, \
     '' index 0 using 1:4 with lines ls 8, \
     '' index 0 using 1:3 with points ls 2 ps 0.45
unset label

set title "The same run by two programs, 10 000 steps"
unset logscale x
set format x "%g"
set xrange [0:2000]
set yrange [1e-90:1e5]
set ytics 1e-80, 1e20, 1
set xtics 500
set xlabel "t"
set ylabel "largest absolute value of 20 steps" offset 0.5,0
set label 1 "FVI by double sums" at 900,1e-15 tc rgb BROWN
set label 2 "Lagrange–d’Alembert" at 1050,1e-55 right tc rgb BLUE
set label 3 "their difference" at 900,1e-28 tc rgb "#222222"
plot dat index 1 using 1:3 with lines ls 5 dt 1 lw 6, \
     '' index 1 using 1:2 with lines ls 1 lw 2.4, \
     '' index 1 using 1:4 with lines ls 7 lw 1
unset multiplot
