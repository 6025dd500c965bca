"""What every module needs before it imports anything large."""

import resource
import sys

# Bytes. Below 0.4 GB the imports of Snakemake and HDF5 fail in many ways, and libraries try again without end.
ADDRESS_SPACE = 1 << 30


def require_address_space() -> None:
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit != resource.RLIM_INFINITY and limit < ADDRESS_SPACE:
        sys.exit(
            f"A process may have {limit >> 20} MB of address space here, and the pipeline needs {ADDRESS_SPACE >> 20}: raise the "
            f"limit, as by ulimit -v {ADDRESS_SPACE >> 10}"
        )
