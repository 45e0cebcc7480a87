# figures/course/course_elements.gp -- Chapter 1: figures/springpot/springpot.gp with the Course's letters.
# Output: figures/course/course_elements.svg.
# The style is figures/style.gp, by the drawing that is loaded.
force = "F"; stiffness = "c"; equation = "m x'' + c x + ρ D^{2α}(x − x_0) = 0"; joints = "first second third"; ladder = "a ladder, in slow motions a springpot"
load 'figures/springpot/springpot.gp'
