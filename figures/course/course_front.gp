# figures/course/course_front.gp -- The first picture of README.md: course_seven.gp, with the points of a run of stage
# 12.
# Input: figures/course/course_front.c. Output: figures/course/course_front.svg.
load 'figures/course/course_seven.gp'
