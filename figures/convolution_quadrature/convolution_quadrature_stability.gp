# figures/convolution_quadrature/convolution_quadrature_stability.gp -- H 13: the largest stable step, and the growth
# beyond it.
# Input: figures/convolution_quadrature/convolution_quadrature_stability.c. Output:
# figures/convolution_quadrature/convolution_quadrature_stability.svg.
width = 920; height = 470
load 'figures/style.gp'
array name[4] = ["fvi", "fvi-shifted", "fvi-bdf2", "trapezoidal weights"]
look(i) = i < 4 ? 10 + i : 8
set multiplot layout 1,2 margins 0.08,0.985,0.125,0.92 spacing 0.10

set title "The largest stable damping, κ = 1/2"
set xlabel "α"
set ylabel "R = ρ h^{2−2α} / m"
set logscale y
set xrange [0:1]
set yrange [0.2:200]
unset key
set label 1 "fvi-shifted: every R\nfrom α = 1/2 on" at 0.56,18 textcolor rgb "#555555"
set label 2 "stable for all three" at 0.08,0.5 textcolor rgb "#555555"
set label 3 "fvi" at 0.75,2.1 tc ls FVI
set label 4 "fvi-shifted" at 0.16,9 tc ls SHIFTED
set label 5 "fvi-bdf2" at 0.5,0.42 tc ls BDF2
set label 6 "marks: measured" at 0.97,140 right tc rgb "#222222"
plot for [i=1:3] dat index 0 using 1:(column(2*i + 1)) with lines ls look(i), \
     for [i=1:3] '' index 0 using 1:(column(2*i)) with points ls look(i) ps 0.9
unset label

set title "Growth a step, α = 1/4, κ = 1/2, W = 1"
set xlabel "R"
set ylabel "|x_{k+1} / x_k| − 1"
set logscale x
set format x "10^{%L}"
set format y "10^{%L}"
set xrange [1e-2:1e2]
set yrange [1e-4:1e2]
set key top left # no names at the curves, because they come together
plot for [i=1:4] dat index i using 1:2 with lines ls look(i) title name[i], \
     for [i=1:4] '' index i using 1:3 with points ls look(i) ps 0.9 notitle
unset multiplot
