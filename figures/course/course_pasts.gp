# figures/course/course_pasts.gp -- Chapter 7: three pasts, and the past for which no motion exists.
# Input: figures/course/course_pasts.c. Output: figures/course/course_pasts.svg.
width = 900; height = 420
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.075,0.87,0.13,0.9 spacing 0.11
unset key
set title "three pasts and what follows (α = 3/4)"
set xlabel "t"
set ylabel "x" offset 1,0
set xrange [-2:6]
set yrange [-1.6:2.4]
set arrow 1 from 0,-1.6 to 0,2.4 nohead lc rgb GREY dt (4,4)
set label 1 "held at x_0" at -1.9,1.15 left tc rgb BLUE
set label 2 "a straight\nline" at -1.95,0.83 left tc rgb GREEN
set label 3 "at zero, then at once at x_0" at -1.9,-0.2 left tc rgb RED
plot dat index 1 using 1:2 with lines ls 3 lw 2.4, \
     dat index 2 using 1:2 with lines ls 2 lw 2.4, \
     dat index 0 using 1:2 with lines ls 1 lw 2.4
unset label
unset arrow
set title "from zero: shorter steps make it worse"
set xrange [0:3]
set yrange [-0.3:7.5]
plot for [i=3:6] dat index i using 1:2 with lines ls int(word("8 5 4 2", i-2)) lw 2, \
     for [i=3:6] dat index i using 1:($1 > 2.99 ? $2 : NaN):3 with labels left offset 0.6,0 tc rgb "#222222"
unset multiplot
