#!/usr/bin/env bash
# Fails where a C++ file is not laid out as .clang-format says, and names the lines:
#
#   tests/format.sh ROOT                 checks every *.cpp and *.hpp below ROOT, build and results folders left out
#   tests/format.sh --self-test SCRATCH  checks the check, on a file that is laid out wrongly
#
# Another version of clang-format lays out some lines in another way, so only version 14, that of Debian 12, is asked. Exit code 77: it is not
# installed, nothing was checked.
set -euo pipefail

for program in clang-format-14 clang-format none; do
  [[ $program == none ]] && echo "no clang-format 14: not checked" && exit 77
  command -v "$program" >/dev/null && [[ $("$program" --version) == *"version 14."* ]] && break
done

check_format() {
  find "$1" -mindepth 1 \( -name build -o -name results -o -name '.?*' \) -prune -o \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
    xargs -0 -n 50 -P "$(nproc)" "$program" --style=file --dry-run -Werror
}

if [[ ${1-} == --self-test ]]; then
  mkdir -p "$2"
  cp "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")/.clang-format" "$2"
  printf 'int  main( ) { return 0; }\n' >"$2/main.cpp"
  if check_format "$2" 2>/dev/null; then
    echo "a file that is laid out wrongly was not found"
    exit 1
  fi
  "$program" --style=file -i "$2/main.cpp"
  check_format "$2"
else
  check_format "$1"
fi
