"""Array types of the solver.  Shapes and units stand in the docstrings."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
IntArray: TypeAlias = NDArray[np.int64]
BoolArray: TypeAlias = NDArray[np.bool_]
Single: TypeAlias = NDArray[np.float32]
Short: TypeAlias = NDArray[np.int16]
