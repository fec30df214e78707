#!/usr/bin/env bash
# Tests the Python package by pytest.
#
#   run.sh PYTHON FOLDER [arguments of pytest]      FOLDER: where `import flankwright` finds the package
set -euo pipefail
python=$1 package=$(readlink -f "$2")
shift 2
if ! "$python" -c 'import numpy, pytest' 2>/dev/null; then
  echo "NumPy or pytest is not installed for $python: skipped"
  exit 77
fi
# Nothing is written beside the sources.
export PYTHONPATH=$package PYTHONDONTWRITEBYTECODE=1
exec "$python" -m pytest -q -p no:cacheprovider "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" "$@"
