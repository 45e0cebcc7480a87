# figures/course/course_handover.gp -- Chapter 6: the past acts on a motion at the node where one step hands the
# momentum to the next.
# Output: figures/course/course_handover.svg.
width = 540; height = 250
load 'figures/style.gp'
unset border; unset tics; unset grid; unset key
set margins 0.5, 0.5, 0.5, 0.5
set xrange [-8.7:5.5] # the handed-over momentum is drawn at 0
set yrange [-0.1:5.7]
do for [n=1:9] {
  shade = 255 - int(150 / n**0.6)
  set object n rectangle from -0.95*n-0.05,1.0 to -0.95*n+0.75,1.8 fc rgb sprintf("#%02x%02x%02x", shade, shade, 255 - (255-shade)/3) fs solid noborder
}
set label 1 "the past: all places so far, each with its weight" at -8.55,0.4 left tc rgb BLACK
set object 20 rectangle from -5.5,3.0 to -1.7,4.4 fc rgb "#e8eef4" fs solid border rgb BLUE lw 1.6
set label 2 "the step before" at -3.6,3.7 center tc rgb BLUE
set object 21 rectangle from 1.7,3.0 to 5.3,4.4 fc rgb "#f8ebe2" fs solid border rgb RED lw 1.6
set label 3 "the next step" at 3.5,3.7 center tc rgb RED
set arrow 1 from -1.6,3.7 to -0.65,3.7 head filled size .25,20 lc rgb BLUE lw 2
set arrow 2 from 0.65,3.7 to 1.6,3.7 head filled size .25,20 lc rgb RED lw 2
set object 22 circle at 0,3.7 size 0.6 fc rgb "#ffffff" fs solid border rgb BLACK lw 1.6
set label 4 "p_k" at 0,3.7 center tc rgb BLACK
set arrow 3 from 0,1.5 to 0,2.95 head filled size .25,20 lc rgb "#666666" lw 2
set label 5 "−hρ D_{−}^{2α}z_k" at 0.4,2.2 left tc rgb "#444444"
set label 6 "after this step: (6b)" at -3.6,5.1 center tc rgb BLUE
set label 7 "before this step: (6a)" at 2.6,5.1 center tc rgb RED
plot NaN
