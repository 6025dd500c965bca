# Environment of the Makefile's recipes (BASH_ENV) and of Snakemake's jobs (shell.prefix): variables of the caller change no result.
# By prefix, what can change where or what is unset; by name, what only reaches the network, space and libraries is kept.
for name in $(compgen -e); do
  case $name in
    UV_*INDEX* | UV_*CACHE_DIR | UV_*HOST | UV_*TLS | UV_*CERTS | UV_*MIRROR | UV_HTTP_* | UV_CONCURRENT_* | UV_OFFLINE | UV_LINK_MODE | UV_NO_CONFIG) ;;
    PIP_*INDEX* | PIP_*HOST | PIP_*LINKS | PIP_*TIMEOUT | PIP_CACHE_DIR | PIP_CERT | PIP_PROXY | CMAKE_PREFIX_PATH | CONDA_PREFIX | SSL_CERT_DIR | XDG_* | SLURM_*) ;;
    BASH_ENV | POSIXLY_CORRECT | GIT_* | UV_* | PIP_* | VIRTUAL_ENV* | CONDA_* | PYTHON* | PYTEST_* | SNAKEMAKE_* | MPL* | MATPLOTLIB* | FONTCONFIG_* | \
      H5* | HDF5_* | GSL_* | NPY_* | NUMPY_* | OPENBLAS_* | GOTO_* | MKL_* | BLIS_* | OMP_* | GOMP_* | KMP_* | LD_* | DYLD_* | GLIBC_* | \
      CMAKE_* | *_ROOT | *_DIR | CTEST_* | GTEST_* | CCACHE_* | CCC_* | GCC_* | PKG_CONFIG_* | *FLAGS | CPATH | *_INCLUDE_PATH | LIBRARY_PATH | COMPILER_PATH | LANG*) unset "$name" ;;
  esac
done
export LC_ALL=C.UTF-8 TZ=UTC SOURCE_DATE_EPOCH=1230768000
export PYTHONHASHSEED=0 PYTHONSAFEPATH=1 PYTHONNOUSERSITE=1
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
export MPLBACKEND=Agg MPLCONFIGDIR=$PWD/.cache/matplotlib
[ -w "${HOME:-}" ] || export HOME=$PWD/.cache         # as of a user in a container,
[ -n "${USER-}${LOGNAME-}" ] || export USER=user-$UID # who may have no name either, which Snakemake reads
# An active conda environment without the compiler comes after the system, so that all libraries have one origin.
if [ -n "${CONDA_PREFIX-}" ] && [[ $(command -v "${CXX:-c++}") != "$CONDA_PREFIX"/* ]]; then
  PATH=:$PATH: PATH=${PATH//:"$CONDA_PREFIX/bin":/:} PATH=${PATH#:} PATH=${PATH%:}:$CONDA_PREFIX/bin
  unset CONDA_PREFIX
fi
cd -P . # by a link to the folder
