# figures/discrete_principle/discrete_principle_diagram.gp -- H 6: two ways to the same integrator.
# No data.
# Output: figures/discrete_principle/discrete_principle_diagram.svg. It draws no data.
width = 860; height = 380
load 'figures/style.gp'
unset border; unset tics; unset grid; unset key
set xrange [0:100]; set yrange [0:100]
set lmargin 1; set rmargin 1; set tmargin 1; set bmargin 1

# Draw four boxes with two rows of text each.
set style rectangle fc rgb "#f4f7fb" fillstyle solid 1 border lc rgb "#0072B2"
set object rectangle from 1,68 to 37,96
set label "a discrete Lagrangian and a force" at 19,86.4 center font ",14"
set label "L_d(x_k, x_{k+1}),  f^{ +} = −ρ (x_{k+1} − x_k)" at 19,77.6 center
set object rectangle from 59,68 to 99,96
set label "a Lagrangian of two discrete curves" at 79,90.8 center font ",14"
set label "L_d(x_k, x_{k+1}) + L_d(y_k, y_{k+1})" at 79,82 center
set label "− h Δ_{−}^{α}x_k  ρ Δ_{+}^{α}y_k" at 79,73.2 center
set object rectangle from 1,4 to 37,32
set label "the forced integrator" at 19,26.8 center font ",14"
set label "D_1L_d(x_k, x_{k+1}) + D_2L_d(x_{k−1}, x_k)" at 19,18 center
set label "− ρ (x_k  − x_{k−1}) = 0" at 19,9.2 center
set object rectangle from 59,4 to 99,32
set label "the fractional integrator" at 79,26.8 center font ",14"
set label "D_1L_d(x_k, x_{k+1}) + D_2L_d(x_{k−1}, x_k)" at 79,18 center
set label "− h ρ Δ_{−}^{α}Δ_{−}^{α}x_k  = 0" at 79,9.2 center

# Draw the arrows of the two ways.
set style arrow 1 head filled size screen 0.012,20 lc rgb "#444444" lw 1.6
set arrow from 38,82 to 58,82 as 1
set arrow from 19,67 to 19,33 as 1
set arrow from 79,67 to 79,33 as 1
set arrow from 58,18 to 38,18 as 1
set label "double the curves" at 48,89 center font ",12"
set label "no force" at 48,75 center font ",12"
set label "α = 1/2" at 48,25 center font ",12"
set label "drop the mirror y" at 48,11 center font ",12"
set label "discrete Lagrange–" at 21,54 left font ",12"
set label "d’Alembert" at 21,46 left font ",12"
set label "discrete Hamilton," at 77,54 right font ",12"
set label "restricted: δx_k  = δy_k" at 77,46 right font ",12"
plot NaN notitle
