# figures/stability/stability_map.gp -- H 14: the largest stable damping of eight methods, on one map.
# Input: figures/stability/stability_map.c. Output: figures/stability/stability_map.svg.
width = 940; height = 500
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.08,0.985,0.115,0.92 spacing 0.09
looks = "11 12 13 14 15 16 22 23"
names = "fvi fvi-shifted fvi-bdf2 fvi-lobatto2 fvi-lobatto3 fvi-lobatto4 fvi-lobatto6 fvi-lobatto8"
set logscale y
set format y "10^{%T}"

set title "The least damping with a growing mode, hω small"
set xlabel "α"
set ylabel "R = ρ h^{2−2α} / m"
set xrange [0:1]
set yrange [0.2:3000]
unset key
heights = "2.4 62 0.6 30 130 280 560 1150" # the heights of the names, to the right of the ends of the curves
places = "0.6 0.5 0.3 0.5 0.5 0.5 0.5 0.5"
do for [i=1:8] {
    set label i word(names, i) at word(places, i) + 0, word(heights, i) + 0 tc ls word(looks, i) + 0
}
set label 9 "no bound: fvi-stable,\nfvi-lobatto2d to 8d" at 0.5,9 textcolor rgb "#555555"
plot for [i=1:8] dat index 0 using 1:i+1 with lines ls word(looks, i) + 0
unset label

set title "The same at α = 1/4"
set xlabel "hω"
unset ylabel
set xrange [0:8]
set yrange [0.2:3000]
heights = "4 8.2 1.35 0.3 27 62 210 500"
places = "5.6 5.6 5.6 0.15 0.2 0.2 0.2 0.2"
do for [i=1:8] {
    set label i word(names, i) at word(places, i) + 0, word(heights, i) + 0 tc ls word(looks, i) + 0
}
plot for [i=1:8] dat index 1 using 1:i+1 with lines ls word(looks, i) + 0
unset multiplot
