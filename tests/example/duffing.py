"""The example of README.md, from Python."""
#> example
import fvi

run = fvi.run("duffing:1,0.5", alpha=0.3, rho=0.4, method="fvi-lobatto3", h=0.1, steps=200)
for t, x in zip(run.t, run.x):
    print(t, x, sep="\t")
#< example
