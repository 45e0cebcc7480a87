# figures/lagrangian/lagrangian_differences.gp -- A body on a strut, by an action and by differences.
# Input: figures/lagrangian/lagrangian_differences.c. Output: figures/lagrangian/lagrangian_differences.svg.
width = 1080; height = 400
load 'figures/style.gp'
set multiplot layout 1,3
set title "two turns (thin), and the last (thick)"
set xlabel "x_1    (ρ = 0.1, α = 0.3, steps of 0.2)"
set ylabel "x_2" offset 1
set size ratio -1
set xrange [-1.5:1.5]
set yrange [-1.5:1.5]
unset key
set arrow 1 from 0,0 to 1.2,0 nohead lc rgb GREY lw 3
set label 1 "spring and" at 0.08,0.17
set label 2 "damper" at 0.08,-0.19
plot dat index 0 every ::0::75 using 2:3 with lines lc rgb BLUE lw 0.8, \
     dat index 0 every ::1950::2000 using 2:3 with lines ls 1, \
     dat index 0 every ::1945::2000 using 8:9 with lines ls 2, \
     '+' using (0):(0) every ::0::0 with points pt 7 ps 0.7 lc rgb BLACK, \
     '+' using (1.2):(0) every ::0::0 with points pt 7 ps 0.9 lc rgb BLUE
unset arrow 1
set size noratio
set xlabel "t"
set xrange [0:400]
set xtics 100
set title "energy"
unset ylabel
set yrange [0:0.5]
set label 1 "exact: dots" at 185, 0.43
set label 2 "steps from an action" at 185, 0.365 tc rgb BLUE
set label 3 "steps by differences" at 90, 0.22 tc rgb RED
plot dat index 0 using 1:4 with lines ls 1, dat index 0 using 1:6 with lines ls 2, \
     dat index 1 using 1:4 with points pt 7 ps 0.7 lc rgb BLACK
set title "angular momentum"
set yrange [0:1.1]
set label 1 "exact: dots" at 185, 1.03
set label 2 "steps from an action" at 185, 0.90 tc rgb BLUE
set label 3 "steps by differences" at 90, 0.67 tc rgb RED
plot dat index 0 using 1:5 with lines ls 1, dat index 0 using 1:7 with lines ls 2, \
     dat index 1 using 1:(0.96) with points pt 7 ps 0.7 lc rgb BLACK
unset multiplot
