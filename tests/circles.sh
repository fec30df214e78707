#!/usr/bin/env bash
# Fails where units include each other in a circle. A unit is a header and the source beside it.
#
#   circles.sh ROOT          checks core, optimize and studies below ROOT
set -euo pipefail
cd "$1"

# "unit unit-it-includes" for every include of the project's own headers; tsort orders them, and says which it cannot.
grep -rHoE --include='*.hpp' --include='*.cpp' '^ *# *include "(core|optimize|studies)/[^"]+' core optimize studies |
  sed -E 's/\.(hpp|cpp): *# *include "/ /; s/\.(hpp|cpp)$//' | awk '$1 != $2' | tsort >/dev/null
