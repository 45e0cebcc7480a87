"""The whole report on a frame in an earthquake: floors, peaks for four orders, a spectrum, a loop."""
#> example
import fvi
import matplotlib.pyplot as plt
import numpy as np

quake = "9.81*file:build/quake.csv:time,acc"
frame = fvi.Problem("k*x1^2/2 + k*(x2-x1)^2/2", let={"k": 100}, rho=[5, 0], order=0.6, ground=quake, x0=0, p0=0, time=10)
how = {"h": 0.02, "method": "fvi-lobatto4"}
names = "t,drift=x2-x1,floor=a2+ag,force=d1.force1,work,balance"

def write(path, columns):
    np.savetxt(path, np.column_stack(list(columns.values())), "%.17g", ",", header=",".join(columns), comments="")

s = fvi.solve(frame, checkpoint="build/frame.npz", **how)  # continues a run that was stopped
write("build/floors.csv", s.table(names))
peaks = "peak(x1),peak(drift),peak(floor),at(peak(floor)),peak(force)"
print("order", peaks, sep=",")
orders = [0.2, 0.4, 0.6, 0.8]
for order, found in zip(orders, fvi.sweep(frame, {"order": orders}, lambda s: s.reduce(peaks, names), **how)):
    print(order, *found.values(), sep=",")
T = np.geomspace(0.05, 2, 40)
mass = fvi.Problem("(2*pi/T)^2*x^2/2", let={"T": 1}, order=0.6, rho=0.5, ground=quake, x0=0, p0=0, time=10)
peak = fvi.sweep(mass, {"T": T}, lambda s: list(s.reduce("absmax(a+ag),absmax(x)").values()), h=0.005, method="fvi-stable")
write("build/spectrum.csv", {"T": T, "absmax(a+ag)": peak[:, 0], "absmax(x)": peak[:, 1]})
plt.plot(s.x[:, 0], s.forces["d1"][:, 0])
plt.savefig("build/hysteresis.svg")
#< example
