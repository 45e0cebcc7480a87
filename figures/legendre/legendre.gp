# figures/legendre/legendre.gp -- Chapter 8: the errors of three momenta and their energies.
# Input: figures/legendre/legendre.c. Output: figures/legendre/legendre.svg.
width = 1000; height = 500
load 'figures/style.gp'
array slope[9]; array last[9] # p, E of block 0, p of block 1, three of each
do for [j=1:9] {
    stats dat index (j > 6) using (log($1)):(log(column((j - 1) % 6 + 2))) name "S" nooutput
    slope[j] = S_slope
    stats dat index (j > 6) every ::4::4 using (log(column((j - 1) % 6 + 2)) - log($1) * (j == 7 ? 2 : 1)) name "L" nooutput
    last[j] = L_min # the line of the predicted slope through the last point
}
set logscale xy
set format y "10^{%L}"
set xrange [0.005:0.125]
set xtics ("0.00625" 0.00625, "0.0125" 0.0125, "0.025" 0.025, "0.05" 0.05, "0.1" 0.1)
set xlabel "h"
set multiplot layout 1,3 margins 0.08,0.985,0.33,0.92 spacing 0.06
set key at graph 0.5, graph -0.21 center top vertical maxrows 4 samplen 3 Left reverse
array name[3] = ["matched: slope %.3f", "only D_2L_d: slope %.3f", "m(x_k−x_{k−1})/h: slope %.3f"]

set title "ρ = 0.2, t ≤ 15: momentum"
set ylabel "largest error" offset 1,0
set yrange [3e-4:1e-1]
plot for [j=1:3] exp(last[j]) * x with lines ls 8 title (j == 1 ? "lines of slope 1" : ""), \
     for [j=1:3] dat index 0 using 1:(column(1 + j)) with points ls j pt (j == 2 ? 4 : 9 - 2 * (j == 1)) ps (j == 2 ? 1.5 : 0.9) lw 1.5 \
         title sprintf(name[j], slope[j])

set title "ρ = 0.2, t ≤ 15: energy"
unset ylabel
plot for [j=1:3] exp(last[3 + j]) * x with lines ls 8 title (j == 1 ? "lines of slope 1" : ""), \
     for [j=1:3] dat index 0 using 1:(column(4 + j)) with points ls j pt (j == 2 ? 4 : 9 - 2 * (j == 1)) ps (j == 2 ? 1.5 : 0.9) lw 1.5 \
         title sprintf(name[j], slope[3 + j])

set title "ρ = 0, Duffing, t ≤ 5: momentum"
set yrange [3e-5:1]
plot for [j=1:3:2] exp(last[6 + j]) * x**(j == 1 ? 2 : 1) with lines ls 8 \
         title (j == 1 ? "lines of slope 2 and 1" : ""), \
     for [j=1:3:2] dat index 1 using 1:(column(1 + j)) with points ls j pt (j == 2 ? 4 : 9 - 2 * (j == 1)) ps (j == 2 ? 1.5 : 0.9) lw 1.5 \
         title sprintf(name[j], slope[6 + j])
unset multiplot
