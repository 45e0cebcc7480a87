# figures/style.gp -- What all figures share. A figure is called with
#   dat   the file that its scene printed     out   the SVG to write
#   stem  the figure's name
# Colours: Okabe and Ito's, told apart also by the colour-blind; each has its own
# dash and its own marker, so that they are told apart in grey as well.
width = exists("width") ? width : 760
height = exists("height") ? height : 460
set terminal svg size width, height enhanced font "DejaVu Sans,13" background rgb "white" \
    name stem linewidth 1.2 butt dashlength 1.2
set output out
set encoding utf8
set border 3 lc rgb "#444444"
set tics nomirror textcolor rgb "#222222"
set grid lc rgb "#dddddd" lt 1 lw 0.6
set key spacing 1.25 samplen 3 font ",12"
set style line 1 lc rgb "#0072B2" dt 1       lw 1.8 pt 7  ps 0.6
set style line 2 lc rgb "#D55E00" dt (8,4)   lw 1.8 pt 5  ps 0.6
set style line 3 lc rgb "#009E73" dt (12,3,2,3) lw 1.8 pt 9  ps 0.75
set style line 4 lc rgb "#CC79A7" dt (4,3)   lw 1.8 pt 13 ps 0.8
set style line 5 lc rgb "#E69F00" dt (14,4)  lw 1.8 pt 11 ps 0.75
set style line 6 lc rgb "#56B4E9" dt (2,2)   lw 1.8 pt 6  ps 0.65
set style line 7 lc rgb "#000000" dt 1       lw 1.2 pt 2  ps 0.6
set style line 8 lc rgb "#888888" dt (5,5)   lw 1.2 pt 1  ps 0.6
