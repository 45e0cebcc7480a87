# figures/restricted_principle/restricted_principle_diagram.gp -- H 3: two ways to linear damping.
# No data.
# Output: figures/restricted_principle/restricted_principle_diagram.svg. It draws no data.
width = 860; height = 380
load 'figures/style.gp'
unset border; unset tics; unset grid; unset key
set xrange [0:100]; set yrange [0:100]
set lmargin 1; set rmargin 1; set tmargin 1; set bmargin 1

# Draw four boxes with two rows of text each.
set style rectangle fc rgb "#f4f7fb" fillstyle solid 1 border lc rgb "#0072B2"
set object rectangle from 1,68 to 37,96
set label "a Lagrangian and a force" at 19,86.4 center font ",14"
set label "L(x, x′),  f = −ρ x′" at 19,77.6 center
set object rectangle from 59,68 to 99,96
set label "a Lagrangian of two curves" at 79,86.4 center font ",14"
set label "L(x, x′) + L(y, y′) − D_{−}^{α}x ρ D_{+}^{α}y" at 79,77.6 center
set object rectangle from 1,4 to 37,32
set label "the damped equation" at 19,22.4 center font ",14"
set label "(d/dt) ∂L/∂x′ − ∂L/∂x + ρ x′ = 0" at 19,13.6 center
set object rectangle from 59,4 to 99,32
set label "the fractionally damped equation" at 79,22.4 center font ",14"
set label "(d/dt) ∂L/∂x′ − ∂L/∂x + ρ D_{−}^{α}D_{−}^{α}x = 0" at 79,13.6 center

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
set label "Lagrange–d’Alembert:" at 21,54 left font ",12"
set label "virtual work of f" at 21,46 left font ",12"
set label "Hamilton, restricted:" at 77,54 right font ",12"
set label "δx = δy" at 77,46 right font ",12"
plot NaN notitle
