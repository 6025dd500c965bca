"""Builds of the C++ code that watch themselves, in build/instrumented. No result comes from them."""

import subprocess
from pathlib import Path

# GCC calls things uninitialised that only seem so between what a sanitizer has put in.
COMMON = ["-O1", "-g", "-fno-omit-frame-pointer", "-fno-sanitize-recover=all", "-Wno-maybe-uninitialized"]


def build(name: str, flags: list[str], targets: list[str], compiler: str = "g++") -> Path:
    """The folder of the executables."""
    folder = Path("build/instrumented") / name
    settings = [f"-DCMAKE_CXX_COMPILER={compiler}", "-DINSTRUMENTATION=" + ";".join([*COMMON, *flags])]
    subprocess.run(
        ["cmake", "-S", "cpp", "-B", folder, "-G", "Ninja", "--log-level=WARNING", *settings], check=True
    )
    subprocess.run(["ninja", "-C", folder, "--quiet", *targets], check=True)
    return folder / "bin"
