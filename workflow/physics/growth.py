"""Growth of a quantity with system size."""

import numpy as np
from numpy.typing import ArrayLike


def local_exponents(size: ArrayLike, value: ArrayLike, error: ArrayLike) -> tuple[np.ndarray, ...]:
    """Geometric means of neighbouring sizes, d ln value / d ln size between them, and its errors."""
    size, value, error = (np.asarray(array, dtype=float) for array in (size, value, error))
    step, relative = np.diff(np.log(size)), error / value
    slope = np.diff(np.log(value)) / step
    return np.sqrt(size[1:] * size[:-1]), slope, np.hypot(relative[1:], relative[:-1]) / step
