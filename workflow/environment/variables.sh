# Environment of the Makefile's recipes (BASH_ENV) and of Snakemake's jobs (shell.prefix): variables of the caller change no result.
export LC_ALL=C.UTF-8 TZ=UTC SOURCE_DATE_EPOCH=1230768000
export PYTHONHASHSEED=0 PYTHONSAFEPATH=1 PYTHONNOUSERSITE=1
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
export MPLBACKEND=Agg MPLCONFIGDIR=$PWD/.cache/matplotlib
unset CFLAGS CXXFLAGS CPPFLAGS LDFLAGS CPATH C_INCLUDE_PATH CPLUS_INCLUDE_PATH LIBRARY_PATH CMAKE_GENERATOR
unset OPENBLAS_CORETYPE OPENBLAS_L2_SIZE # they change last digits
unset PYTHONPATH PYTHONHOME VIRTUAL_ENV MATPLOTLIBRC SNAKEMAKE_PROFILE HDF5_PLUGIN_PATH BASH_ENV
unset PYTHONDONTWRITEBYTECODE # without bytecode every start of Snakemake takes twice the time
[ -w "${HOME:-}" ] || export HOME=$PWD/.cache # as of a user in a container
