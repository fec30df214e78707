#!/usr/bin/env bash
# Fails where a page of the repository links to a file, a folder or a heading that does not exist:
#
#   tests/links.sh ROOT                 checks every *.md below ROOT, build and results folders left out
#   tests/links.sh --self-test SCRATCH  checks the check, on two pages with one link of every kind
#
# A link that names a server (http:, https:, mailto:) is not followed. Headings are found by the anchors that GitHub gives them.
set -euo pipefail

# The anchors of a page, a line each: small letters, without punctuation, hyphens for spaces. Lines within ``` fences are no headings.
anchors() {
  sed '/^```/,/^```/d' "$1" | sed -nE 's/^#{1,6} +(.*)$/\1/p' | sed -E 's/\[([^]]*)\]\([^)]*\)/\1/g' |
    tr '[:upper:]' '[:lower:]' | sed -E "s/[^[:alnum:] _-]//g; s/ /-/g"
}

# The targets of a page's links, a line each. Code, in `...` or indented by four spaces, has no links.
targets() {
  sed '/^```/,/^```/d; /^    /d' "$1" | sed -E 's/`[^`]*`//g' | { grep -oE '\]\([^) ]+\)' || true; } | sed -E 's/^\]\((.*)\)$/\1/'
}

# What is wrong with the links below a folder, a line each.
check_links() {
  local root=$1 page target file anchor
  while IFS= read -r page; do
    while IFS= read -r target; do
      [[ $target =~ ^(https?|mailto): ]] && continue
      file=${target%%#*} anchor=
      [[ $target == *#* ]] && anchor=${target#*#}
      if [[ -z $file ]]; then file=$root/$page; else file=$(dirname "$root/$page")/$file; fi
      if [[ ! -e $file ]]; then
        echo "$page: $target does not exist"
      elif [[ -n $anchor ]] && ! { [[ -f $file ]] && grep -qxF -- "$anchor" <<<"$(anchors "$file")"; }; then
        echo "$page: $target is no heading of that page"
      fi
    done < <(targets "$root/$page")
  done < <(cd "$root" && find . \( -path ./build -o -path ./results -o -name .git \) -prune -o -name '*.md' -printf '%P\n' | LC_ALL=C sort)
}

case "${1-}" in
  --self-test)
    scratch=${2:?usage: ${0##*/} --self-test SCRATCH}
    rm -rf "$scratch"
    mkdir -p "$scratch/part" "$scratch/build"
    printf '%s\n' '# One page' '## What it costs: time, memory' '[a](part) [b](part/two.md#a-heading) [c](#what-it-costs-time-memory)' \
      '[d](https://nowhere.invalid) `[e](code)` ![f](missing.png)' '    [g](indented)' '[h](#absent) [i](part/two.md#absent)' >"$scratch/one.md"
    printf '%s\n' '# A heading' '[a](../one.md) [b](one.md)' >"$scratch/part/two.md"
    printf '%s\n' '[a](not-looked-at.md)' >"$scratch/build/three.md"
    expected=$(printf '%s\n' 'one.md: missing.png does not exist' 'one.md: #absent is no heading of that page' \
      'one.md: part/two.md#absent is no heading of that page' 'part/two.md: one.md does not exist')
    found=$(check_links "$scratch")
    if [[ $found != "$expected" ]]; then
      printf 'The check found\n%s\ninstead of\n%s\n' "$found" "$expected" >&2
      exit 1
    fi
    ;;
  "" | -*)
    echo "usage: ${0##*/} ROOT | --self-test SCRATCH" >&2
    exit 2
    ;;
  *)
    found=$(check_links "$1")
    if [[ -n $found ]]; then
      printf '%s\n' "$found" >&2
      exit 1
    fi
    ;;
esac
