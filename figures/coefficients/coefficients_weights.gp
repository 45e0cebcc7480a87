# figures/coefficients/coefficients_weights.gp -- H 4: the weights alpha_n and how slowly they decay.
# Input: figures/coefficients/coefficients_weights.c. Output: figures/coefficients/coefficients_weights.svg.
width = 900; height = 400
load 'figures/style.gp'
if (!exists("order")) { weight = "α_n"; order = "α"; law = "lines: n^{−1−α} / Γ(−α)" } # the Course uses other letters
set multiplot layout 1,2 margins 0.08,0.985,0.15,0.9 spacing 0.1
unset key
set title "the present against the past"
set xlabel "n, steps back"
set ylabel weight
set xrange [-0.5:8.5]
set yrange [-0.85:1.1]
set xtics 1
set label 1 order . " = 1/4" at 2.6,-0.28 tc rgb "#009E73"
set label 2 order . " = 1/2" at 2.6,-0.44 tc rgb "#0072B2"
set label 3 order . " = 3/4" at 2.6,-0.60 tc rgb "#D55E00"
array look[3] = [3, 1, 2]
plot 0 with lines lc rgb "#444444" lw 1, \
     for [i=1:3] dat index i-1 every ::0::8 using ($1 + 0.14 * (i - 2)):2 with impulses ls look[i] dt 1 lw 3, \
     for [i=1:3] dat index i-1 every ::0::8 using ($1 + 0.14 * (i - 2)):2 with points ls look[i]
set title "how slowly it fades"
set ylabel "−" . weight
set logscale xy
set format "10^{%T}"
set xtics auto
set xrange [1:3e6]
set yrange [1e-10:1]
set label 1 at 1.4e5,1.3e-7
set label 2 at 1.4e5,1e-8
set label 3 at 1.4e5,4e-10
set label 4 law at 2,1e-9 left tc rgb "#222222"
plot for [i=1:3] dat index i-1 using 1:(-$3) with lines ls look[i], \
     for [i=1:3] dat index i-1 every 4 using 1:(-$2) with points ls look[i]
unset multiplot
