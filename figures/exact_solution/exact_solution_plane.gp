# figures/exact_solution/exact_solution_plane.gp -- H 11: the poles of X(s) in the plane of s.
# Input: figures/exact_solution/exact_solution_plane.c. Output: figures/exact_solution/exact_solution_plane.svg.
width = 900; height = 430
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.085,0.985,0.13,0.9 spacing 0.1
unset key
set xlabel "Re s"
set ylabel "Im s"
set title "the cut, and the poles as ρ grows from 0"
set xrange [-2:0.9]
set yrange [-1.6:1.6]
set arrow 1 from -2,0 to 0,0 nohead lc rgb "#222222" lw 4
set arrow 2 from 0,-1.6 to 0,1.6 nohead lc rgb "#888888" lw 0.8
set label 1 "cut" at -1.75,0.13 tc rgb "#222222"
set label 2 "α = 1/4" at -0.62,1.35 right tc rgb "#009E73"
set label 3 "α = 1/2" at -0.87,0.66 right tc rgb "#0072B2"
set label 4 "α = 3/4" at -0.4,0.35 right tc rgb "#D55E00"
set label 5 "i: no damping" at 0.06,1 left tc rgb "#222222"
array look[3] = [3, 1, 2]
plot for [i=1:3] dat index i-1 using 1:2 with lines ls look[i], \
     for [i=1:3] dat index i-1 using 1:(-$2) with lines ls look[i], \
     for [i=1:3] dat index 3 every ::i-1::i-1 using 1:2 with points ls look[i] ps 0.9, \
     for [i=1:3] dat index 3 every ::i-1::i-1 using 1:(-$2) with points ls look[i] ps 0.9
unset label
unset arrow
set title "contours that pass a pole, and that do not"
set xlabel "Re z, z = s t"
set ylabel "Im z"
set xrange [-14:14]
set yrange [-14:14]
set arrow 1 from -14,0 to 0,0 nohead lc rgb "#222222" lw 4
set label 1 "φ = π/8" at 1.9,11 left tc rgb "#0072B2"
set label 2 "φ = 3π/8" at -13.2,3 left tc rgb "#D55E00"
set label 3 "pole" at -1.5,8 right tc rgb "#222222"
mu = 6
zx(u, f) = mu * (1 - sin(f) * cosh(u))
zy(u, f) = mu * cos(f) * sinh(u)
set parametric
set trange [-2.2:2.2]
plot zx(t, pi/8), zy(t, pi/8) with lines ls 1 lw 2.2, \
     zx(t, 3*pi/8), zy(t, 3*pi/8) with lines ls 2 lw 2.2, \
     '+' using (-1):(8) every ::0::0 with points pt 2 ps 1 lw 2 lc rgb "#222222", \
     '+' using (-1):(-8) every ::0::0 with points pt 2 ps 1 lw 2 lc rgb "#222222"
unset multiplot
