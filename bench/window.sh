#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bench/window.sh BUILD_DIR: what a frame of the window costs while a fader moves, 1280 x 720, twenty groups: the
# window's own work (faders, mix, exposure, panels) and what OpenGL takes. Prints a table.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: bench/window.sh BUILD_DIR" >&2; exit 2; }
build=$1
root=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$build/sconce" bake "$root/scenes/theatre.glb" -o "$work/theatre.sconce" --atlas 1024 --samples 8 --encoding f16 --quiet

{
  echo "settle  # the package is open, and drawn"
  echo "frames 40"
  echo "times $work/start.csv"
  for i in $(seq 120); do echo "set chandelier=0.$((100 + i))"; done
  echo "times $work/one.csv"
  for i in $(seq 60); do echo "set *=0.$((100 + i))"; done
  echo "times $work/all.csv"
  echo "auto"
  for i in $(seq 60); do echo "set chandelier=0.$((100 + i))"; done
  echo "times $work/auto.csv"
} >"$work/script.txt"
"$root/tests/with_display.sh" 1280x720 "$build/sconce" view "$work/theatre.sconce" --script "$work/script.txt" --size 1280x720

echo "| fader move, 1024 x 1024 texels, 20 groups | own work, median ms | 95 % | OpenGL, median ms | its share |"
echo "|---|---|---|---|---|"
for case in one:"one fader" all:"all faders" auto:"one fader, automatic exposure"; do
  tail -n +2 "$work/${case%%:*}.csv" | sort -t, -n | awk -F, -v name="${case#*:}" '
    { own[NR] = $1; gl[NR] = $2; a += $1; b += $2 }
    END { n = asort_(gl, NR); printf "| %s | %.2f | %.2f | %.1f | %.0f %% |\n", name, own[int((NR + 1) / 2)], own[int(NR * 0.95)], gl[int((NR + 1) / 2)], 100 * b / (a + b) }
    function asort_(x, n,   i, j, t) { for (i = 2; i <= n; i++) for (j = i; j > 1 && x[j] < x[j-1]; j--) { t = x[j]; x[j] = x[j-1]; x[j-1] = t } return n }'
done
