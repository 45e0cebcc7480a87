# figures/course/course_triangle.gp -- Chapter 5: one triangle of products, added up in two ways.
# A drawing. Output: figures/course/course_triangle.svg.
width = 540; height = 360
load 'figures/style.gp'
unset border; unset tics; unset grid; unset key
set margins 0.5, 0.5, 0.5, 0.5
set xrange [-1.6:10.2]
set yrange [-1.6:6.2]
do for [k=0:4] { do for [j=0:k] {
  set object 100+10*k+j rectangle from j+0.05,4-k+0.05 to j+0.95,4-k+0.95 \
    fc rgb (k==j ? "#6aa5cf" : k-j==1 ? "#b5d2e7" : k-j==2 ? "#d5e5f1" : "#eaf2f8") fs solid border rgb "#ffffff"
  set label 100+10*k+j sprintf("w_%d", k-j) at j+0.5,4-k+0.5 center tc rgb BLACK
} }
do for [k=0:4] {
  set label 20+k sprintf("g_%d", k) at -0.35,4.5-k right tc rgb RED
  set label 30+k sprintf("f_%d", k) at k+0.5,-0.4 center tc rgb BLUE
}
set arrow 1 from 5.3,2.5 to 6.1,2.5 head filled size .2,20 lc rgb RED lw 1.6
set label 1 "by rows:\neach g_k  times a sum\nof f up to k" at 6.3,2.9 left tc rgb RED
set arrow 2 from 3.5,4.3 to 3.5,5.0 head filled size .2,20 lc rgb BLUE lw 1.6
set label 2 "by columns: each f_j  times a sum of g from j on" at 3.6,5.5 center tc rgb BLUE
plot NaN
