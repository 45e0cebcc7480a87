# figures/course/course_relay.gp -- Chapter 3: one step hands the momentum over, the next one takes it.
# A drawing. Output: figures/course/course_relay.svg.
width = 540; height = 230
load 'figures/style.gp'
unset border; unset tics; unset grid; unset key
set margins 0.5, 0.5, 0.5, 0.5
set xrange [1.2:13.8]
set yrange [0:5]
set parametric
set trange [0:pi]
set label 1 "x_{k−1}" at 2,1.1 center tc rgb BLACK
set label 2 "x_k" at 7.5,1.1 center tc rgb BLACK
set label 3 "x_{k+1}" at 13,1.1 center tc rgb BLACK
set label 4 "the step L(x_{k−1}, x_k)" at 4.75,4.6 center tc rgb BLUE
set label 5 "the step L(x_k, x_{k+1})" at 10.25,4.6 center tc rgb RED
set label 6 "ends with ∂_2L" at 4.6,2.9 center tc rgb BLUE
set label 7 "begins with −∂_1L" at 10.4,2.9 center tc rgb RED
set label 8 "p_k  is both: the step before hands it over, the step after takes it" at 7.5,0.3 center tc rgb BLACK
set arrow 1 from 5.9,2.5 to 7.2,1.75 head filled size .25,20 lc rgb BLUE lw 1.6
set arrow 2 from 7.8,1.75 to 9.1,2.5 head filled size .25,20 lc rgb RED lw 1.6
plot 4.75 - 2.75*cos(t), 1.5 + 2.6*sin(t) with lines ls 1 lw 2.4, \
     10.25 - 2.75*cos(t), 1.5 + 2.6*sin(t) with lines ls 2 dt 1 lw 2.4, \
     '-' using 1:2 with points pt 7 ps 1.1 lc rgb BLACK
2 1.5
7.5 1.5
13 1.5
e
