# figures/springpot/springpot.gp -- H 0: the symbols of a spring, a springpot, a dashpot and a mass, and a ladder.
# Everything is drawn with lines. The Course loads this drawing with other letters (course_elements.gp).
# Output: figures/springpot/springpot.svg.
width = 900; height = 330
load 'figures/style.gp'
if (!exists("force")) { force = "f"; stiffness = "k"; equation = "m x'' + U'(x) + ρ D^{2α} x = F"; joints = "x_0 x_1 x_2"; ladder = "a ladder, which is a springpot" }
unset border; unset tics; unset grid; unset key
set margins 0.5, 0.5, 0.5, 0.5
set xrange [0:30]
set yrange [0.5:10.8]
ink = "#222222"
set style line 20 lc rgb ink lw 1.6 dt 1
set style line 21 lc rgb "#0072B2" lw 2.2 dt 1

# The elements lie between (0, 0) and (4, 0), with a lead at each end.
$spring << END
0 0
.9 0
1.1 .35
1.4 -.35
1.7 .35
2 -.35
2.3 .35
2.6 -.35
2.9 .35
3.1 0
4 0
END
$dashpot << END
0 0
1.7 0

1.7 -.4
1.7 .4

1.2 -.55
2.6 -.55
2.6 .55
1.2 .55

2.6 0
4 0
END
$springpot << END
0 0
1.2 0
2 .6
2.8 0
2 -.6
1.2 0

2.8 0
4 0
END
set label 1 "spring, β = 0" at 3.5,9.9 center tc rgb ink
set label 2 force . " = " . stiffness . " x" at 3.5,7.9 center tc rgb ink
set label 3 "springpot, 0 < β < 1" at 3.5,6.7 center tc rgb ink
set label 4 force . " = ρ D^{β} x" at 3.5,4.4 center tc rgb ink
set label 5 "dashpot, β = 1" at 3.5,3.4 center tc rgb ink
set label 6 force . " = η x'" at 3.5,1.2 center tc rgb ink
# Draw the body on its spring and springpot.
set object 1 rectangle from 13.9,4.0 to 16.1,7.6 fc rgb "#e8eef4" fs solid border rgb ink lw 1.6
set label 10 "m" at 15,5.8 center tc rgb ink
set arrow 1 from 9.2,3.4 to 9.2,8.2 nohead lc rgb ink lw 3
set label 11 equation at 12.6,9.9 center tc rgb ink
set label 12 "β = 2α" at 12.6,1.9 center tc rgb ink
set arrow 2 from 15,3.3 to 16.4,3.3 head filled size .3,20 lc rgb ink lw 1.2
set label 13 "x" at 16.6,3.3 left tc rgb ink
# Draw the ladder.
set label 20 ladder at 24.2,9.9 center tc rgb ink
set arrow 3 from 18.2,8.2 to 29.6,8.2 nohead lc rgb ink lw 3
set label 21 word(joints, 1) at 19.4,2.9 center tc rgb ink
set label 22 word(joints, 2) at 22.8,2.9 center tc rgb ink
set label 23 word(joints, 3) at 26.2,2.9 center tc rgb ink
set label 24 stiffness at 21.1,4.9 center tc rgb ink
set label 25 "η" at 23.6,6.1 left tc rgb ink
set label 26 force at 18.1,4.6 center tc rgb ink
set label 27 ". . ." at 29.3,3.9 left tc rgb ink
set arrow 4 from 19.3,3.9 to 17.6,3.9 head filled size .3,20 lc rgb "#0072B2" lw 2
rung(i) = 19.4 + 3.4 * i
plot $spring using (1.5 + $1):(8.9 + $2) with lines ls 20, \
     $springpot using (1.5 + $1):(5.6 + $2) with lines ls 21, \
     $dashpot using (1.5 + $1):(2.3 + $2) with lines ls 20, \
     $spring using (9.2 + 4.7 * $1 / 4):(6.8 + $2) with lines ls 20, \
     $springpot using (9.2 + 4.7 * $1 / 4):(4.8 + $2) with lines ls 21, \
     for [i=0:2] $spring using (rung(i) + 3.4 * $1 / 4):(3.9 + $2) with lines ls 20, \
     for [i=0:2] $dashpot using (rung(i) + $2):(3.9 + 4.3 * $1 / 4) with lines ls 20, \
     for [i=0:2] $spring every ::0::0 using (rung(i)):(3.9) with points pt 7 ps 0.7 lc rgb ink
