# figures/blocks/blocks.gp -- H 28: where a sum over pairs finds each of its terms.
# No input. Output: figures/blocks/blocks.svg.
width = 1000; height = 470
load 'figures/style.gp'
set multiplot layout 1,2 margins 0.08,0.985,0.13,0.9 spacing 0.08
unset key
set size ratio -1
set xlabel "term j"
set ylabel "sum k" offset 1,0
blue = "#0072B2"; orange = "#D55E00"; green = "#009E73"; grey = "#8c8c8c"
id = 1

# Draw the rectangle w by h with the corner x, y in the plane of pairs (term, sum), with the colour c and density f.
box(x, y, w, h, c, f) = sprintf("set object %d rectangle from %g,%g to %g,%g fc rgb '%s' fs solid %g border lc rgb 'white'; id = id + 1", id, x, y, x + w, y + h, c, f)

# Draw the triangle below the diagonal of the 8 by 8 square with the corner x, y.
half(x, y) = sprintf("set object %d polygon from %g,%g to %g,%g to %g,%g to %g,%g fc rgb '%s' fs solid 0.85 border lc rgb 'white'; id = id + 1", id, x, y, x, y + 8, x + 8, y + 8, x, y, grey)

# Draw the 8 by 8 squares of the block of 32 sums that begins at k0.
begin(k0) = sprintf("do for [g=0:3] { do for [s=0:3] { eval box(%g-32+8*s, %g+8*g, 8, 8, orange, 0.75) }; do for [s=0:g-1] { eval box(%g+8*s, %g+8*g, 8, 8, green, 0.75) }; eval half(%g+8*g, %g+8*g) }", k0, k0, k0, k0, k0, k0)

set title "Every term meets every later sum once"
set xrange [0:128]
set yrange [128:0]
set xtics 32
set ytics 32
eval begin(32)
eval begin(64)
eval begin(96)
eval box(0, 64, 32, 32, blue, 0.75)
eval box(0, 96, 64, 32, blue, 0.75)
do for [g=0:3] { do for [s=0:g-1] { eval box(8*s, 8*g, 8, 8, green, 0.75) }; eval half(8*g, 8*g) }
set label 1 "by modes" at 20,104 center textcolor rgb "white"
set label 2 "own block: green\nown eight: grey\nblock before: orange" at 126,18 right
plot NaN notitle

# Falk's scheme of a product of matrices: the left factor stands left of the product, the right factor above it.
set title "One product: eight rows of sums, sixteen coordinates"
unset label
do for [i=1:id-1] { unset object i }
id = 1
unset tics
unset border
unset grid
unset xlabel
unset ylabel
set xrange [0:150]
set yrange [150:0]
eval box(112, 16, 16, 72, blue, 0.75)
eval box(112, 88, 16, 32, orange, 0.75)
eval box(4, 124, 72, 8, blue, 0.35)
eval box(76, 124, 32, 8, orange, 0.35)
eval box(112, 124, 16, 8, green, 0.75)
set label 1 "72 modes" at 109,52 right
set label 2 "32 terms" at 109,104 right
set label 3 "powers e^{-s r}" at 40,119 center
set label 4 "weights" at 92,119 center
set label 5 "8 x 16 sums" at 120,139 center
set label 6 "of 16 coordinates" at 120,10 center
set label 7 "the same for all coordinates" at 56,139 center
plot NaN notitle
unset multiplot
