# figures/course/course_map.gp -- The twelve chapters of the Course in order, and which chapter needs which.
# Output: figures/course/course_map.svg.
width = 1000; height = 420
load 'figures/style.gp'
unset border; unset tics; unset grid; unset key
set xrange [0:100]; set yrange [0:42]
set margins 0, 0, 0, 0
# name       of each chapter: column, height, the two lines of text in its box
place(c) = word("0 1 1 2 3 4 0 1 2 3 4 5", c) + 0
level(c) = word("31 36.5 25.5 31 31 31 10 10 10 10 10 10", c) + 0
array first[12] = ["A body that", "Half a", "An action", "Friction from", "The same", "Your", "What was", "Half a deriv-", "The paper's", "How wrong, and", "A million", "Order two"]
array second[12] = ["remembers", "derivative", "made of points", "an action", "on a grid", "integrator", "before t = 0?", "ative, twice", "experiments", "how long a step?", "steps", ""]
side(c) = 7.5 + 17 * place(c)
half = 6.2; tall = 3.4
do for [c = 1:12] {
    set object c rectangle center side(c), level(c) size 2 * half, 2 * tall \
        fc rgb (c <= 6 ? "#dbe9f6" : "#eef3e6") fillstyle solid border lc rgb "#333333" lw 0.8
    set label c sprintf("{/:Bold %d}  %s\n%s", c, first[c], second[c]) at side(c) - half + 0.7, level(c) + 0.9 left font ",11"
}
arrows = "1-2 1-3 2-4 3-4 4-5 5-6 7-8 8-9 9-10 10-11 11-12"
do for [pair in arrows] {
    a = substr(pair, 1, strstrt(pair, "-") - 1) + 0
    b = substr(pair, strstrt(pair, "-") + 1, strlen(pair)) + 0
    set arrow from side(a) + half, level(a) to side(b) - half, level(b) head filled size 0.8, 20 lc rgb "#555555" lw 0.9
}
turn = 18   # the length of the connection from chapter 6 down to chapter 7
set arrow from side(6), level(6) - tall to side(6), turn nohead lc rgb "#555555" lw 0.9
set arrow from side(6), turn to side(7), turn nohead lc rgb "#555555" lw 0.9
set arrow from side(7), turn to side(7), level(7) + tall head filled size 0.8, 20 lc rgb "#555555" lw 0.9
set label 20 "An arrow says which chapter to read first. Blue: the method. Green: how good it is, and how it becomes better." at 1, 1 left font ",11" textcolor rgb "#444444"
plot NaN notitle
