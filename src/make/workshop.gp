# src/make/workshop.gp -- The curve of a student over another one.
#   ours, mine   two files of x and y     out   the SVG to write     what   its title     name   of the other curve
width = 720; height = 420; stem = "workshop"
load 'figures/style.gp'
set title what noenhanced
set key outside top right horizontal
plot ours using 1:2 with lines lc rgb "#bbbbbb" lw 6 title name, \
     mine using 1:2 with points ls 2 title "yours"
