# figures/course/course_seven.gp -- Chapter 6: the running body for seven orders of its damping.
# Input: figures/course/course_seven.c. Output: figures/course/course_seven.svg.
width = 860; height = 500
load 'figures/style.gp'
set datafile missing "-"
set xlabel "t"
set ylabel "x"
set xrange [0:14]
set yrange [-1.05:1.1]
set rmargin 12
unset key
styles = "8 6 3 7 5 2 4"
ls_of(i) = int(word(styles, i % 7 + 1))
# Names that would touch stand a little apart.
array lift[7] = [0.01, -0.08, -0.13, -0.01, 0.03, 0.05, 0]
plot for [i=0:6] dat index i using 1:2 with lines ls ls_of(i) lw 1.8, \
     for [i=0:6] '' index i using 1:3 with points ls ls_of(i) pt 7 ps 0.45, \
     for [i=0:6] '' index i every ::141::141 \
         using 1:($2 + lift[i+1]):4 with labels left offset 0.7,0 textcolor rgb "#222222"
