# figures/past/past.gp -- Chapter 19: pasts and their futures.
# Input: figures/past/past.c. Output: figures/past/past.svg.
width = 900; height = 420
load 'figures/style.gp'
set xlabel "t"
set xrange [-4:12]
set yrange [-1.1:1.9]
set arrow 1 from 0,-1.1 to 0,1.9 nohead lc rgb "#888888" lw 0.8
set multiplot layout 1,2 margins 0.06,0.985,0.13,0.9 spacing 0.06
set key top right
set title "α = 1/4"
set ylabel "x"
plot dat index 0 using 1:2 with lines ls 1 title "held, and so Caputo", \
     dat index 1 using 1:2 with lines ls 2 title "Riemann-Liouville: at 0"
set title "α = 3/4"
unset ylabel
plot dat index 2 using 1:2 with lines ls 1 title "held", \
     dat index 3 using 1:2 with lines ls 3 title "Caputo: along the line"
unset multiplot
