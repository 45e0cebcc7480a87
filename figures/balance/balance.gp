# figures/balance/balance.gp -- Chapter 21: what is kept, and five masses.
# Input: figures/balance/balance.c. Output: figures/balance/balance.svg.
width = 960; height = 440
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.06,0.985,0.13,0.9 spacing 0.08
set title "A spring, α = 0.3: pairs of variations"
set xlabel "t"
set xrange [0:20]
set yrange [-0.3:2.1]
set key at graph 0.98, graph 0.98 right top
plot dat index 0 using 1:3 with lines ls 1 lw 2.6 title "forward with backward, C_n", \
     '' index 0 using 1:4 with lines ls 3 title "the same without its sum over the past", \
     '' index 0 using 1:2 with lines ls 2 lw 2.2 title "forward with forward: the area"
set title "Five unequal masses: who moves when whom is pushed"
set xrange [0:30]
set yrange [-1.0:1.55]
plot dat index 1 using 1:4 with lines ls 8 title "1, when 1 is pushed", \
     '' index 1 using 1:5 with lines ls 6 title "4, when 4 is pushed", \
     '' index 1 using 1:2 with lines ls 5 dt 1 lw 6 title "4, when 1 is pushed", \
     '' index 1 using 1:3 with lines ls 7 title "1, when 4 is pushed"
unset multiplot
