"""The workers: claim a landing, assess it, write the answer."""

import os

# Before numpy is imported anywhere: a worker is one of several processes, each gets one core, and
# a BLAS that has started threads cannot be forked safely.
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
