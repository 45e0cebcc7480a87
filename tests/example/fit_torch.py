"""Fit alpha, rho and a spring to a motion with torch: all three are tensors."""
#> example
import fvi
import fvi.torch
import torch

problem = fvi.Problem("k*x^2/2", let={"k": 1}, alpha=0.3, rho=0.4, p0=0.25)
options = {"h": 0.1, "method": "fvi-lobatto4"}
torch.manual_seed(2)
data = torch.from_numpy(fvi.solve(problem, **options).x) + 0.02 * torch.randn(201, 1, dtype=torch.float64)
u = torch.tensor([0.0, -1.6, 0.7], dtype=torch.float64, requires_grad=True)
optimiser = torch.optim.LBFGS([u], max_iter=60, line_search_fn="strong_wolfe")

def loss():
    optimiser.zero_grad()
    x, p = fvi.torch.solve(problem, {"alpha": u[0].sigmoid(), "rho": u[1].exp(), "k": u[2].exp()}, **options)
    misfit = ((x - data) ** 2).sum()
    misfit.backward()
    return misfit
optimiser.step(loss)
print(f"alpha = {u[0].sigmoid():.3f}, rho = {u[1].exp():.3f}, k = {u[2].exp():.3f}")
#< example
