# figures/course/course_elements.gp -- Chapter 1: figures/springpot/springpot.gp, with the letters of the Course.
# No data. Output: figures/course/course_elements.svg. The drawing that is loaded loads figures/style.gp.
force = "F"; stiffness = "c"; equation = "m x'' + c x + ρ D^{2α}(x − x_0) = 0"; joints = "first second third"; ladder = "a ladder, in slow motions a springpot"
load 'figures/springpot/springpot.gp'
