# figures/identification/identification.gp -- H 24: noisy data, the fitted curve, and the residuals.
# Input: figures/identification/identification.c. Output: figures/identification/identification.svg.
width = 900; height = 470
load 'figures/style.gp'
set xrange [0:20]
set multiplot
set lmargin at screen 0.085
set rmargin at screen 0.985
set tmargin at screen 0.97
set bmargin at screen 0.42
set format x ""
set ylabel "x"
set key top right # no names at the curves, because the points hide them
plot dat index 0 using 1:2 with points ls 8 pt 7 ps 0.35 title "data, σ = 0.02", \
     '' index 0 using 1:3 with lines ls 1 title "fit of α, ρ, c, x_0, p_0"
set tmargin at screen 0.38
set bmargin at screen 0.12
set format x
set xlabel "t"
set ylabel "residual / σ"
set yrange [-4:4]
set ytics 2
plot dat index 0 using 1:4 with impulses lc rgb "#0072B2" lw 0.8 notitle
unset multiplot
