# figures/style.gp -- What all figures share. A figure is called with
#   dat   the file that its scene printed     out   the SVG to write
#   stem  the figure's name
# The grammar:
#   A method has one mark, one colour and one dash, in all figures: line styles 11 to 23.
#   What is no method has the styles 1 to 8; each has its own dash and its own marker, too,
#   so that curves are told apart in grey. The hues are Okabe and Ito's, for the colour-blind,
#   two of them darker: each colour has a contrast of 3 to 1 at least, on white and on black.
#   A panel says one thing. A name stands at its curve. A key stays where curves cross or run
#   together, so that a name at one could be another's, where marks stand alone, or where it
#   serves two panels; its line says which, and it stands where no curve is.
#   Panels side by side have one scale, or their titles say what is different.
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
BLUE = "#0072B2"; RED = "#D55E00"; GREEN = "#009E73"; PINK = "#C46A9B"
BROWN = "#B07A00"; SKY = "#2E8FC4"; BLACK = "#000000"; GREY = "#808080"
set style line 1 lc rgb BLUE  dt 1       lw 1.8 pt 7  ps 0.6
set style line 2 lc rgb RED   dt (8,4)   lw 1.8 pt 5  ps 0.6
set style line 3 lc rgb GREEN dt (12,3,2,3) lw 1.8 pt 9  ps 0.75
set style line 4 lc rgb PINK  dt (4,3)   lw 1.8 pt 13 ps 0.8
set style line 5 lc rgb BROWN dt (14,4)  lw 1.8 pt 11 ps 0.75
set style line 6 lc rgb SKY   dt (2,2)   lw 1.8 pt 6  ps 0.65
set style line 7 lc rgb BLACK dt 1       lw 1.2 pt 2  ps 0.6
set style line 8 lc rgb GREY  dt (5,5)   lw 1.2 pt 1  ps 0.6
# The methods. What is exact is black (style 7), what is predicted grey (style 8).
FVI = 11; SHIFTED = 12; BDF2 = 13; LOBATTO2 = 14; LOBATTO3 = 15; LOBATTO4 = 16
EXPLICIT = 17; IMPLICIT = 18; MATRIX = 19; PRINTED = 20; LOBATTO5 = 21; LOBATTO6 = 22; LOBATTO8 = 23
set style line FVI      lc rgb BLUE  dt 1          lw 1.8 pt 7  ps 0.6
set style line SHIFTED  lc rgb GREEN dt (12,3,2,3) lw 1.8 pt 9  ps 0.75
set style line BDF2     lc rgb BROWN dt (14,4)     lw 1.8 pt 11 ps 0.75
set style line LOBATTO2 lc rgb SKY   dt (2,2)      lw 1.8 pt 15 ps 0.65
set style line LOBATTO3 lc rgb GREY  dt (8,3,2,3,2,3) lw 1.8 pt 8 ps 0.75
set style line LOBATTO4 lc rgb BLACK dt (6,2)      lw 1.8 pt 4  ps 0.6
set style line EXPLICIT lc rgb RED   dt (8,4)      lw 1.8 pt 5  ps 0.6
set style line IMPLICIT lc rgb PINK  dt (4,3)      lw 1.8 pt 13 ps 0.8
set style line MATRIX   lc rgb "#7A5FC0" dt (4,2,1,2) lw 1.8 pt 3 ps 0.7
set style line PRINTED  lc rgb BLUE  dt (3,3)      lw 1.4 pt 6  ps 0.7
set style line LOBATTO5 lc rgb GREEN dt (10,2)     lw 1.8 pt 14 ps 0.75
set style line LOBATTO6 lc rgb RED   dt (3,2)      lw 1.8 pt 10 ps 0.75
set style line LOBATTO8 lc rgb PINK  dt (1,2)      lw 1.8 pt 12 ps 0.8
