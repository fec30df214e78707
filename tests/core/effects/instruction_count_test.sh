#!/usr/bin/env bash
# What effects cost, in instructions: runs the tests that count them under Callgrind. Skipped (77) where there is no Valgrind.
#
#   instruction_count_test.sh FLANKWRIGHT_TESTS
set -euo pipefail

if ! command -v valgrind >/dev/null; then
  echo "no Valgrind here" >&2
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export FLANKWRIGHT_INSTRUCTIONS=$folder/instructions OPENBLAS_NUM_THREADS=1
# Counting pauses inside the memory allocator: what it does depends on what was freed before. The last of these two options counts:
# a toggle alone starts with counting off.
pauses=()
for entry in malloc free calloc realloc posix_memalign aligned_alloc; do pauses+=("--toggle-collect=$entry"); done
# -s lists what was compared, so that the figures stand in the log.
valgrind --quiet --tool=callgrind --instr-atstart=no "${pauses[@]}" --collect-atstart=yes --callgrind-out-file="$FLANKWRIGHT_INSTRUCTIONS" \
  "$1" "[instructions]" -s
