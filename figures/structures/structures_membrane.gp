# figures/structures/structures_membrane.gp -- H 27: a membrane that is bent and let go.
# Input: figures/structures/structures_membrane.c. Output: figures/structures/structures_membrane.svg.
width = 900; height = 330
load 'figures/style.gp'
set multiplot layout 1,3 margins 0.03,0.93,0.06,0.9 spacing 0.03
set size ratio 1
unset key
unset xtics
unset ytics
unset grid
set border 15
set xrange [0:1]
set yrange [0:1]
set palette defined (-1 "#D55E00", -0.3 "#f0b48a", 0 "#ffffff", 0.3 "#8fc1de", 1 "#0072B2")
set cbrange [-0.4:0.4]
unset colorbox
when(i) = i == 0 ? "t = 0" : i == 1 ? "t = 0.31" : "t = 0.75"
do for [i=0:2] {
    if (i == 2) { set colorbox user origin 0.945,0.06 size 0.015,0.84; set cbtics 0.2 }
    set title when(i)
    plot dat index i using 1:2:3 with image
}
unset multiplot
