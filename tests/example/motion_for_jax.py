"""A motion as a function of jax, whose derivative is one adjoint run."""
#> example
import functools

import fvi
import jax
import numpy as np

jax.config.update("jax_enable_x64", True)
options = {"h": 0.1, "method": "fvi-lobatto4"}

@functools.partial(jax.custom_vjp, nondiff_argnums=(0,))
def motion(problem, alpha):
    shape = jax.ShapeDtypeStruct((201, 1), np.float64)
    return jax.pure_callback(lambda a: fvi.solve(problem.replace(alpha=float(a)), **options).x, shape, alpha,
                             vmap_method="sequential")

def backward(problem, alpha, x_bar):
    def host(a, x_bar):
        s = fvi.solve(problem.replace(alpha=float(a)), **options)
        return np.float64(fvi.vjp(s, x=np.asarray(x_bar), wrt=["alpha"])["alpha"])
    return (jax.pure_callback(host, jax.ShapeDtypeStruct((), np.float64), alpha, x_bar, vmap_method="sequential"),)

motion.defvjp(lambda problem, alpha: (motion(problem, alpha), alpha), backward)
print(f"by alpha {jax.grad(lambda a: motion(fvi.Problem(rho=0.4), a)[-1, 0])(0.3):.4f}")
#< example
