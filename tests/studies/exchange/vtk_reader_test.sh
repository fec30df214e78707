#!/usr/bin/env bash
# The VTK export of an example, read by VTK's own reader and compared with results.json.
#
#   vtk_reader_test.sh FLANKWRIGHT EXAMPLES      exit code 77: skipped, with a word why
set -euo pipefail
flankwright=$1 examples=$2
here=$(dirname "$(readlink -f "$0")")

# Debian's module belongs to Debian's python3, which need not be the first one of PATH.
python=
for candidate in python3 /usr/bin/python3; do
  "$candidate" -c 'import vtkmodules.vtkIOXML' 2>/dev/null && python=$candidate && break
done
[[ -n $python ]] || { echo "skipped: no VTK for python3 here (Debian: python3-vtk9)"; exit 77; }

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# The main study, coarse and stopped early: nine scenes before and after. Its expectations are those of the whole study.
"$flankwright" run "$examples/helical-18-54.toml" --out "$scratch" --set cycle.positions=4 --set fidelity.quadrature.intervals=4 \
  --set optimise.max_evaluations=3 >"$scratch/log" 2>&1 || [[ $? -eq 1 ]] || { cat "$scratch/log"; exit 1; }
"$flankwright" export "$scratch" --vtk >/dev/null
"$python" "$here/vtk_reader_check.py" "$scratch"
