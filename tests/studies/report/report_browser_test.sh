#!/usr/bin/env bash
# Reports in a real browser: no console error, every picture drawn, what has a slider moves with it, the other colours come and go.
#
#   report_browser_test.sh FLANKWRIGHT EXAMPLES      exit code 77: skipped, with a word why
set -euo pipefail
flankwright=$1 examples=$2
here=$(dirname "$(readlink -f "$0")")

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "skipped: no chromium here (Debian: chromium)"
  exit 77
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# What the probe in a page says, after a name.
ask() {
  local found
  found=$("$browser" --headless --no-sandbox --disable-gpu --window-size=1250,1000 --virtual-time-budget=8000 --user-data-dir="$scratch/profile" \
    --dump-dom "file://$scratch/page.html" 2>/dev/null | sed -n 's|.*<output id="probe">\([^<]*\)</output>.*|\1|p')
  echo "$1: ${found:-the page ended before the probe}"
  [[ $found == "all is well"* ]]
}

# Runs an example, coarser than it is, and has the probe look at its report; the words after the name say what must be found.
look() {
  local study=$1
  shift
  "$flankwright" run "$examples/$study.toml" --out "$scratch/$study" --set cycle.positions=8 --set fidelity.quadrature.intervals=4 \
    --set sweep.samples=110 >"$scratch/log" 2>&1 || [[ $? -eq 1 ]] || { cat "$scratch/log"; exit 1; }
  # The listener comes before the page's own scripts, the probe after them.
  sed -e 's|<head>|<head><script>window.complaints = []; addEventListener("error", (e) => complaints.push(e.message)); console.error = console.warn = (...m) => complaints.push(m.join(" "));</script>|' \
    "$scratch/$study/report.html" >"$scratch/page.html"
  { echo "<script>const expected = \"$*\".split(\" \");"; cat "$here/report_probe.js"; echo "</script>"; } >>"$scratch/page.html"
  ask "$study"
}

{ echo '<!DOCTYPE html><meta charset="utf-8"><body><script>'; cat "$here/../../../studies/report/page/dom.js" "$here/number_probe.js"; echo "</script>"; } >"$scratch/page.html"
ask numbers
look helical-18-54 flank-load modifications scenes governing comparison convergence
look parabola-18-54 flank-load search
look spectrum-19-62 life flank-load scenes
look ete-27-43 flank-load modifications stiffness
look nasa-30-100 unloaded gear-pair
look unit-two-stage flank-load gear-pair
look sweep-18-54 scatter indices response-maps
