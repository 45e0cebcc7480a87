"""Half a derivative of a sine, by libfvi from Python: arrays in, arrays out.
    example.py LIBFVI"""
#> example
import ctypes
import sys
import numpy as np

fvi = ctypes.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libfvi.so.0.2")
array = np.ctypeslib.ndpointer(np.double, flags="C_CONTIGUOUS")
fvi.fvi_delta_minus.argtypes = [ctypes.c_double, ctypes.c_double, ctypes.c_size_t,
                                ctypes.c_size_t, array, array]
h, t = 0.001, np.arange(10001) * 0.001
half, once = np.sin(t), np.empty_like(t)
assert fvi.fvi_delta_minus(0.5, h, 10000, 1, half.copy(), once) == 0
assert fvi.fvi_delta_minus(0.5, h, 10000, 1, once, half) == 0
print("two halves make a cosine, to", np.abs(half[1:] - np.cos(t[1:])).max())
#< example

# A mistake is a code, and Python lives: 1 is FVI_EDOM, the order is not in [0, 2].
fvi.fvi_coefficients.argtypes = [ctypes.c_double, ctypes.c_size_t, array]
assert fvi.fvi_coefficients(2.5, 3, np.empty(3)) == 1
