# Compiler flags and definitions that can change a result. They are part of the identity of every result (workflow/pipeline/sources.py).
# Contraction and fast-math would change results, and the instruction set of the build machine would restrict the programs to it.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(NUMERIC_FLAGS -O3 -ffp-contract=off)
# Elementary functions are those of numerics/elementary.cpp. Compilers would evaluate log(0.3), and replace pow(x, 2) by x * x.
foreach(name exp exp2 exp10 expm1 log log2 log10 log1p sin cos sincos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh
             cbrt erf erfc pow hypot)
  list(APPEND NUMERIC_FLAGS -fno-builtin-${name})
endforeach()
# Philox does not need intrinsics. Eigen's order of summation would depend on the vector instructions of the processor and, in blocks
# of matrix products, on the sizes of its caches.
set(NUMERIC_DEFINITIONS R123_USE_SSE=0 EIGEN_NO_DEBUG EIGEN_DONT_VECTORIZE EIGEN_NO_CPUID EIGEN_DEFAULT_L1_CACHE_SIZE=32768
    EIGEN_DEFAULT_L2_CACHE_SIZE=262144 EIGEN_DEFAULT_L3_CACHE_SIZE=2097152)
# Lower levels for libraries without an event loop, which take longer to compile than they save. No level changes a result.
set(SOLVER_LEVEL -O2)   # statistics and the kinetic equation, which solve once
set(PROGRAM_LEVEL -O1)  # options, files, checkpoints
