# figures/memory/memory_strip.gp -- H 12: the strip of (12.7) and its image, for N = 1.
# Drawn from the formula. Output: figures/memory/memory_strip.svg.
width = 900; height = 420
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.085,0.985,0.14,0.9 spacing 0.1
unset key
i = {0, 1}
s(t) = exp(t - exp(-t))
array b[7] = [-1.4, -1, -0.5, 0, 0.5, 1, 1.4]
look(k) = k == 4 ? 1 : (k == 1 || k == 7) ? 2 : 6
set title "the strip, and the nodes of the rule"
set xlabel "Re t"
set ylabel "Im t"
set xrange [-2.5:2.5]
set yrange [-2:2]
set parametric
set samples 1200
set label 1 "Im t = π/2 − ε" at 2.4,1.62 right tc rgb "#D55E00"
set label 2 "t_q" at -2.3,0.2 tc rgb "#0072B2"
set trange [-2.5:2.5]
plot for [k=1:7] t, b[k] with lines ls look(k), \
     '+' using (-2.4 + 0.4 * $0):(0) every ::0::12 with points ls 1 ps 0.9
unset label
set title "its image under s(t), N = 1; left of the line e^{−ns} grows"
set xlabel "Re s"
set ylabel "Im s"
set xrange [-1:5]
set yrange [-3:3]
set label 1 "real rates, s_q" at 3.2,0.25 tc rgb "#0072B2"
set arrow 1 from 0,-3 to 0,3 nohead lc rgb "#888888" lw 0.8
set trange [-1.2:3]
plot for [k=1:7] real(s(t + i * b[k])), imag(s(t + i * b[k])) with lines ls look(k), \
     '+' using (real(s(-2.4 + 0.4 * $0))):(0) every ::0::12 with points ls 1 ps 0.9
unset multiplot
