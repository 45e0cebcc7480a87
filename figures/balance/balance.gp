# figures/balance/balance.gp -- H 21: the conserved form C_n, and the reciprocity of five masses.
# Input: figures/balance/balance.c. Output: figures/balance/balance.svg.
width = 960; height = 440
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.06,0.985,0.13,0.9 spacing 0.08
set title "A spring, α = 0.3: pairs of variations"
set xlabel "t"
set xrange [0:20]
set yrange [-0.1:1.45]
unset key
set label 1 "forward with backward, C_n" at 19.6,0.66 right tc rgb BLUE
set label 2 "the same without its sum over the past" at 19.6,1.35 right tc rgb GREEN
set label 3 "forward with forward: the area" at 4.1,0.55 left tc rgb RED
plot dat index 0 using 1:3 with lines ls 1 lw 2.6, \
     '' index 0 using 1:4 with lines ls 3, \
     '' index 0 using 1:2 with lines ls 2 lw 2.2
unset label
set label 1 "thick: 4, when 1 is pushed; thin: 1, when 4 is pushed" at 29.6,-0.85 right tc rgb "#222222"
set label 2 "1, when 1 is pushed" at 3.5,0.68 tc rgb "#606060"
set label 3 "4, when 4 is pushed" at 3.5,0.52 tc rgb SKY
set title "Five unequal masses: who moves when whom is pushed"
set xrange [0:30]
set yrange [-1.0:0.95]
plot dat index 1 using 1:4 with lines ls 8, \
     '' index 1 using 1:5 with lines ls 6, \
     '' index 1 using 1:2 with lines ls 5 dt 1 lw 6, \
     '' index 1 using 1:3 with lines ls 7
unset multiplot
