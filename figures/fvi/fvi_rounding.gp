# figures/fvi/fvi_rounding.gp -- H 9: the rounding errors of two forms of the same equation.
# Input: figures/fvi/fvi_rounding.c. Output: figures/fvi/fvi_rounding.svg.
load 'figures/style.gp'
stats dat using (log($1)):(log($2)) name "P" nooutput
stats dat using (log($1)):(log($3)) name "M" nooutput
set logscale xy
set format y "10^{%L}"
set xrange [60:14000]
set yrange [1e-16:1e-9]
set xlabel "number of steps N, to t = 20"
set ylabel "largest rounding error of x"
set title "Bagley-Torvik: two forms of one equation in doubles"
unset key
set label 1 sprintf("as printed: grows as N^{%.1f}", P_slope) at 900,2e-12 right tc ls PRINTED
set label 2 sprintf("momentum form: grows as N^{%.1f}", M_slope) at 1.3e4,6e-16 right tc ls FVI
plot exp(P_intercept + P_slope * log(x)) with lines ls PRINTED, \
     exp(M_intercept + M_slope * log(x)) with lines ls FVI, \
     dat using 1:2 with points ls PRINTED ps 1, \
     dat using 1:3 with points ls FVI ps 1
