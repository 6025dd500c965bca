#!/bin/bash
# C++ tests by ctest, then Python tests by pytest, with the arguments of this script.
set -euo pipefail
bash workflow/pipeline/environment/build.sh cpp_tests
mkdir -p build/tests
status=0
ctest --test-dir build --parallel 2 --no-tests=error --output-on-failure --output-junit tests/cpp.xml >build/tests/cpp.log 2>&1 || { status=1; cat build/tests/cpp.log; }
tail -n 1 build/tests/cpp.log
.venv/bin/python -I -m pytest -n 2 --dist loadfile "$@" || status=1
exit $status
