#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scenes/demo.sh BUILD_DIR OUT_DIR: bakes our bathroom and pictures it in four moods, which are only settings of its four
# light groups (scenes/moods/).
set -euo pipefail

if [ $# -ne 2 ]; then
  echo "usage: scenes/demo.sh BUILD_DIR OUT_DIR" >&2
  exit 2
fi
build=$1 out=$2
scenes=$(cd "$(dirname "$0")" && pwd)
cmake --build "$build" --target sconce contact_sheet
mkdir -p "$out"

"$build/sconce" bake "$scenes/bathroom.glb" -o "$out/bathroom.sconce" --density 40 --samples 128 --denoise on | sed '/^next: /d'

sheet=()
for mood in morning evening night cleaning; do
  "$build/sconce" render "$out/bathroom.sconce" --preset "$scenes/moods/$mood.toml" --camera main --size 960x540 \
    -o "$out/$mood.png" | sed '/^next: /d'
  sheet+=("$out/$mood.png" "$mood")
done
"$build/scenes/contact_sheet" "$out/contact-sheet.png" 2 "${sheet[@]}"
echo "four moods from one bake: $out/contact-sheet.png"
echo "next: $build/sconce view $out/bathroom.sconce"
