# figures/step_search/step_search.gp -- H 18: the fastest method for each problem and each error, and by how much it
# is ahead.
# Input: figures/step_search/step_search.tsv (make bench). Output: figures/step_search/step_search.svg.
width = 1000; height = 620
load 'figures/style.gp'
tsv = 'figures/step_search/step_search.tsv'
set datafile separator "\t"
unset key; unset grid; unset colorbox
set title "our best time divided by the best time of a peer: below 1 ours is ahead" offset 0,-0.3
set xrange [0.5:13.5]; set yrange [11.5:0.5]
set xtics nomirror out; set ytics nomirror out
set xtics ("10^{-1}" 1, "10^{-2}" 2, "10^{-3}" 3, "10^{-4}" 4, "10^{-5}" 5, "10^{-6}" 6, "10^{-7}" 7, \
           "10^{-8}" 8, "10^{-9}" 9, "10^{-10}" 10, "10^{-11}" 11, "10^{-12}" 12, "10^{-13}" 13)
set ytics ("P1  plate, jump" 1, "P2  no memory" 2, "P3  Duffing, cosine" 3, "P4  chain of 32" 4, \
           "P5  α = 0.1" 5, "P6  jump off the grid" 6, "P7  two time scales" 7, \
           "P8  Riemann-Liouville" 8, "P9  α = 1/√8" 9, "P10  T = 10^4" 10, \
           "P11  chain of 1000" 11)
set lmargin 22
set xlabel "largest error over all rows" offset 0,0.3
set palette defined (-1 "#66BBEB", 0 "#F7F7F7", 1 "#EBAD26")
set cbrange [-1:1]
bounded(r) = log10(r) > 1 ? 1 : log10(r) < -1 ? -1 : log10(r)
text(r) = r < 1e-8 ? "ours" : r > 1e8 ? "peer" : r < 9.95 ? sprintf("%.2g", r) : sprintf("%.0f", r)
# Each square shows our best time divided by the best time of a peer. If our fastest method takes no steps (it evaluates
# an exact solution), a second number below it is the ratio for our fastest method that takes steps. A number in red and
# bold means that a peer is ahead.
steps(all, some) = some == all ? "" : text(some)
up(all, some) = some == all ? 0 : -0.14
plot tsv index "picture:" using 1:2:(0.48):(0.46):(bounded($3)) with boxxyerror fs solid fc palette, \
     tsv index "picture:" using 1:($2 + up($3, $4)):($3 >= 1 ? "" : text($3)) with labels font ",11", \
     tsv index "picture:" using 1:($2 + up($3, $4)):($3 >= 1 ? "{/:Bold ".text($3)."}" : "") with labels font ",11" tc rgb "#8A1C00", \
     tsv index "picture:" using 1:($2 + 0.24):($4 >= 1 ? "" : steps($3, $4)) with labels font ",9", \
     tsv index "picture:" using 1:($2 + 0.24):($4 >= 1 && $4 != $3 ? "{/:Bold ".steps($3, $4)."}" : "") with labels font ",9" tc rgb "#8A1C00"
