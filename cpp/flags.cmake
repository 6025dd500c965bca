# Compiler flags and definitions that can change a result. They are part of the identity of every result (workflow/identity.py).
set(NUMERIC_FLAGS -O3 -ffp-contract=off)
# Philox does not need intrinsics. Eigen's order of summation would depend on the vector instructions of the processor and, in blocks
# of matrix products, on the sizes of its caches.
set(NUMERIC_DEFINITIONS R123_USE_SSE=0 EIGEN_DONT_VECTORIZE EIGEN_NO_CPUID EIGEN_DEFAULT_L1_CACHE_SIZE=32768
    EIGEN_DEFAULT_L2_CACHE_SIZE=262144 EIGEN_DEFAULT_L3_CACHE_SIZE=2097152)
