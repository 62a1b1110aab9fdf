#!/usr/bin/env bash
# ./test.sh [CTEST OPTIONS]: sets everything up on Debian 12 and runs all tests, or those that the
# options choose (for example ./test.sh -R Fit).
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export BUILD_DIR=${BUILD_DIR:-$source_dir/build}

"$source_dir/Utilities/setup.sh"
. "$BUILD_DIR/environment.sh"
echo "test: for Python, PYTHONPATH=$PYTHONPATH"
exec ctest --test-dir "$BUILD_DIR" --output-on-failure -j "$(nproc)" "$@"
