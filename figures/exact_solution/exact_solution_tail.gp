# figures/exact_solution/exact_solution_tail.gp -- H 11: algebraic tails.
# Input: figures/exact_solution/exact_solution_tail.c. Output: figures/exact_solution/exact_solution_tail.svg.
width = 860; height = 500
load 'figures/style.gp'
set datafile missing "-"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [0.316:1e4]
set yrange [1e-13:3]
set xlabel "t"
set multiplot layout 1,2 margins 0.085,0.985,0.20,0.92 spacing 0.06
set key at screen 0.5, screen 0.015 center bottom maxrows 1 # one for both panels, whose curves cross
alpha(i) = "α = ".word("1/4 2/5 1/2 3/4", i + 1)
style(i) = i == 2 ? 8 : i + 1
set title "pushed from rest: tails t^{−1−2α}"
set ylabel "|x|" offset 1.5
plot for [i=0:3] dat index i using 1:2 with lines ls style(i) lw 2 title alpha(i), \
     for [i in "0 1 3"] dat index int(i) using 1:3 with lines ls 7 dt (3,4) lw 1.2 \
         title i eq "0" ? "predicted" : ""
set title "released from x_0 = 1, Caputo: tails t^{−2α}"
unset ylabel
plot for [i=0:3] dat index i + 4 using 1:2 with lines ls style(i) lw 2 notitle, \
     for [i in "4 5 7"] dat index int(i) using 1:3 with lines ls 7 dt (3,4) lw 1.2 notitle
unset multiplot
