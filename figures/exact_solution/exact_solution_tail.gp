# figures/exact_solution/exact_solution_tail.gp -- H 11: the algebraic tails of solutions.
# Input: figures/exact_solution/exact_solution_tail.c. Output: figures/exact_solution/exact_solution_tail.svg.
width = 860; height = 460
load 'figures/style.gp'
set datafile missing "-"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [0.316:3e5] # the names of the curves stand to their right
set xtics 1,10,1e4
set yrange [1e-13:3]
set xlabel "t"
set multiplot layout 1,2 margins 0.085,0.985,0.13,0.91 spacing 0.075
unset key
alpha(i) = "α = ".word("1/4 2/5 1/2 3/4", i + 1)
style(i) = i == 2 ? 8 : i + 1
array left[4] = [1.5e-7, 5e-9, 1e-9, 2e-11] # the ends of the curves; the third name stands on the left
array right[4] = [3e-3, 7e-5, 1e-8, 1.5e-7]
set label 9 "dotted: predicted" at 500,1e-12 tc ls 7
name(i, y) = sprintf("set label %d alpha(%d) at %g,%g %s tc ls %d", i + 1, i, i == 2 ? 45 : 1.3e4, y, i == 2 ? "right" : "left", style(i))
do for [i=0:3] { eval name(i, left[i + 1]) }
set title "pushed from rest: tails t^{−1−2α}"
set ylabel "|x|" offset 1.5
plot for [i=0:3] dat index i using 1:2 with lines ls style(i) lw 2, \
     for [i in "0 1 3"] dat index int(i) using 1:3 with lines ls 7 dt (3,4) lw 1.2
do for [i=0:3] { eval name(i, right[i + 1]) }
set title "released from x_0 = 1, Caputo: tails t^{−2α}"
unset ylabel
plot for [i=0:3] dat index i + 4 using 1:2 with lines ls style(i) lw 2, \
     for [i in "4 5 7"] dat index int(i) using 1:3 with lines ls 7 dt (3,4) lw 1.2
unset multiplot
