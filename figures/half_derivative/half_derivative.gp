# figures/half_derivative/half_derivative.gp -- Chapter 7: weights that vanish, and the floor.
# Input: figures/half_derivative/half_derivative.c. Output: figures/half_derivative/half_derivative.svg.
width = 860; height = 480
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.09,0.97,0.13,0.91 spacing 0.1
set format y "10^{%L}"
set logscale y
unset mytics
set title "Half a derivative once, and twice (α = 1/2)"
set logscale x
set format x "10^{%L}"
set xrange [1:1e4]
set yrange [1e-24:1e6]
set xlabel "n"
set ylabel "weight, absolute value" offset 0.5,0
set key at graph 0.98, graph 0.985 right top
set label 1 "exactly 0\nfor 2 ≤ n ≤ 31" at 2, 1e-20 tc rgb "#444444"
plot dat index 0 using 1:2 with lines ls 1 lw 2.4 title "once: |α_n|, fades like n^{−3/2}", \
     '' index 0 using 1:4 with lines ls 8 title "bound on rounding, (7.6)", \
     '' index 0 using 1:3 with points ls 2 ps 0.45 title "twice: |c_n|; 0 but for rounding"
unset label 1

set title "The same run by two programs, 10 000 steps"
unset logscale x
set format x "%g"
set xrange [0:2000]
set yrange [1e-90:1e25]
set ytics 1e-80, 1e20, 1
set xtics 500
set xlabel "t"
set ylabel "largest absolute value of 20 steps" offset 0.5,0
plot dat index 1 using 1:3 with lines ls 5 dt 1 lw 6 title "|x|, FVI by double sums", \
     '' index 1 using 1:2 with lines ls 1 lw 2.4 title "|x|, Lagrange–d’Alembert", \
     '' index 1 using 1:4 with lines ls 7 lw 1 title "|difference|"
unset multiplot
