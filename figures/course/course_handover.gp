# figures/course/course_handover.gp -- Chapter 6: the past touches a motion where a step hands its momentum over.
# A drawing. Output: figures/course/course_handover.svg.
width = 820; height = 260
load 'figures/style.gp'
unset border; unset tics; unset grid; unset key
set margins 0.5, 0.5, 0.5, 0.5
set xrange [-9:13]
set yrange [0:5.4]
do for [n=1:9] {
  shade = 255 - int(150 / n**0.6)
  set object n rectangle from -n+0.1,1.2 to -n+0.9,2.0 fc rgb sprintf("#%02x%02x%02x", shade, shade, 255 - (255-shade)/3) fs solid noborder
}
set label 1 "the past: all places so far, each with its weight" at -8.9,0.6 left tc rgb BLACK
set object 20 rectangle from 0.8,2.8 to 4.2,4.2 fc rgb "#e8eef4" fs solid border rgb BLUE lw 1.6
set label 2 "the step before" at 2.5,3.5 center tc rgb BLUE
set object 21 rectangle from 7.8,2.8 to 11.2,4.2 fc rgb "#f8ebe2" fs solid border rgb RED lw 1.6
set label 3 "the next step" at 9.5,3.5 center tc rgb RED
set arrow 1 from 4.3,3.5 to 5.3,3.5 head filled size .25,20 lc rgb BLUE lw 2
set arrow 2 from 6.7,3.5 to 7.7,3.5 head filled size .25,20 lc rgb RED lw 2
set object 22 circle at 6,3.5 size 0.6 fc rgb "#ffffff" fs solid border rgb BLACK lw 1.6
set label 4 "p_k" at 6,3.5 center tc rgb BLACK
set arrow 3 from 0.1,1.6 to 5.7,2.9 head filled size .25,20 lc rgb "#666666" lw 2
set label 5 "−hρ D_{−}^{2α}z_k" at 3.6,1.7 left tc rgb "#444444"
set label 6 "after this step: (6b)" at 3.4,4.9 center tc rgb BLUE
set label 7 "before this step: (6a)" at 8.6,4.9 center tc rgb RED
plot NaN
