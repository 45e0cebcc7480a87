"""A ball on a table: its impacts, its highest points, and a stop."""
#> example
import fvi

ball = fvi.Problem("9.81*x", rho=0.05, alpha=0.3, x0=1, p0=0, time=2)  # let go at the height 1
tops = fvi.Event("v", direction=-1)  # the velocity falls through 0
s = fvi.solve(ball, events=["x : impact:0.8", tops])
for t, p in zip(s.t_events[0], s.p_events[0][:, 0]):
    print(f"at t = {t:.4f} it leaves the table with p = {p:.4f}")
print(f"the first top, at t = {s.t_events[1][0]:.4f}, is {s.x_events[1][0, 0]:.4f} high")
caught = fvi.solve(ball, events=fvi.Event(lambda t, x, p: x - 0.5, "stop"))  # your own function
print(f"caught at t = {caught.t_events[0][0]:.6f}, after {len(caught.t)} rows")
#< example
