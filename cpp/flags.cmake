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
set(NUMERIC_DEFINITIONS R123_USE_SSE=0)  # Philox does not need intrinsics
# Lower levels for libraries without an event loop, which take longer to compile than they save. No level changes a result.
set(SOLVER_LEVEL -O2)   # statistics and the kinetic equation, which solve once
set(PROGRAM_LEVEL -O1)  # options, files, checkpoints
