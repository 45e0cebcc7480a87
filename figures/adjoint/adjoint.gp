# figures/adjoint/adjoint.gp -- H 23: how much x(20) moves if the body is pushed at t.
# Input: figures/adjoint/adjoint.c. Output: figures/adjoint/adjoint.svg.
width = 900; height = 440
load 'figures/style.gp'
set xlabel "t"
set xrange [0:20]
set yrange [-1.25:1.75]
set key top center maxrows 2 # no names at the curves, because they lie on one another
set arrow 1 from 1.2,-1.12 to 5.2,-1.12 head filled size screen 0.012,20 lc rgb "#0072B2" lw 1.6
set label 1 "x remembers" at 5.6,-1.12 left tc rgb "#0072B2" font ",12"
set arrow 2 from 18.8,-1.12 to 14.8,-1.12 head filled size screen 0.012,20 lc rgb "#D55E00" lw 1.6
set label 2 "λ foresees" at 14.4,-1.12 right tc rgb "#D55E00" font ",12"
set multiplot layout 1,2 margins 0.05,0.985,0.12,0.91 spacing 0.065
set title "a spring: the mirror is the adjoint"
plot dat index 0 using 1:2 with lines ls 1 title "x", \
     dat index 0 using 1:4 with lines lc rgb "#8c8c8c" lw 5 dt 1 title "mirror y", \
     dat index 0 using 1:3 with lines ls 2 title "λ", \
     dat index 1 using 1:2 with points ls 7 pt 6 ps 0.8 title "pushed at t"
set title "a Duffing spring: it is not"
plot dat index 2 using 1:2 with lines ls 1 title "x", \
     dat index 2 using 1:4 with lines lc rgb "#8c8c8c" lw 5 dt 1 title "mirror y", \
     dat index 2 using 1:3 with lines ls 2 title "λ", \
     dat index 3 using 1:2 with points ls 7 pt 6 ps 0.8 title "pushed at t"
unset multiplot
