"""Environment of all commands: variables of the caller's shell change no result, however Snakemake is
started; its signals."""

import os
import signal
from pathlib import Path

ALLOWED = {
    *("PATH", "HOME", "USER", "LOGNAME", "TERM", "COLUMNS", "TMPDIR", "CXX", "MAKEFLAGS", "SLURM_CONF"),
    *("CMAKE_PREFIX_PATH", "CPATH", "LIBRARY_PATH", "PKG_CONFIG_PATH"),  # where the libraries are
    *("http_proxy", "https_proxy", "no_proxy", "all_proxy"),
    *("HTTP_PROXY", "HTTPS_PROXY", "NO_PROXY", "ALL_PROXY", "SSL_CERT_FILE", "SSL_CERT_DIR"),
}
FIXED = {
    "LC_ALL": "C.UTF-8",
    "TZ": "UTC",
    "SOURCE_DATE_EPOCH": "1230768000",  # in the pictures of matplotlib
    "PYTHONHASHSEED": "0",
    "PYTHONSAFEPATH": "1",
    "PYTHONNOUSERSITE": "1",
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MPLBACKEND": "Agg",
    "MPLCONFIGDIR": str(Path(".cache/matplotlib").absolute()),
}


def clean() -> None:
    """Removes all variables that are not ALLOWED; those of Slurm remain."""
    kept = {name: text for name, text in os.environ.items() if name in ALLOWED or name.startswith("SLURM_")}
    os.environ.clear()
    # Snakemake needs a name, and the user of a container may have none.
    os.environ.update({"USER": f"user-{os.getuid()}"} | kept | FIXED)


def stop_at_first_signal() -> None:
    """Ignores a second Ctrl-C or SIGTERM, as `timeout` sends it, which would end in a traceback.
    Snakemake's own handler of SIGTERM waits for a lock that the interrupted code may hold."""
    signals = (signal.SIGINT, signal.SIGTERM)

    def stop(_: int, __: object) -> None:
        for other in signals:
            signal.signal(other, signal.SIG_IGN)
        raise KeyboardInterrupt

    for number in signals:
        if signal.getsignal(number) != signal.SIG_IGN:  # as in the background
            signal.signal(number, stop)
