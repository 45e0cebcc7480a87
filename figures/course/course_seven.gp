# figures/course/course_seven.gp -- Chapter 6: the running body for seven orders of its damping.
# Input: figures/course/course_seven.c. Output: figures/course/course_seven.svg.
width = 900; height = 500
load 'figures/style.gp'
set datafile missing "-"
set xlabel "t"
set ylabel "x"
set xrange [0:14]
set yrange [-1.05:1.1]
set key outside right center Left reverse title "{/:Italic α}" samplen 4 # no names at the curves, because they cross
styles = "8 6 3 7 5 2 4"
ls_of(i) = int(word(styles, i % 7 + 1))
array name[7] = ["0, a spring", "0.25", "0.4", "0.5, friction", "0.6", "0.75", "1, a mass"]
plot for [i=0:6] dat index i using 1:2 with lines ls ls_of(i) lw 1.8 title name[i+1], \
     for [i=0:6] '' index i using 1:3 with points ls ls_of(i) pt 7 ps 0.45 notitle
