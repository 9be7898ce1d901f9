#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# An engine host shows the mixed lightmap and follows a fader: examples/host_gl, built beside the program.
source "$(dirname "$0")/begin.sh"
host=$(dirname "$sconce")/examples/host_gl
[ -x "$host" ] || fail "needs $host (ninja host_gl)"

cp "$root/scenes/bathroom.glb" .
"$sconce" bake bathroom.glb --atlas 512 --quality draft --quiet
"$host" bathroom.sconce day.ppm
"$host" bathroom.sconce evening.ppm window=off ceiling=2700K,40%
for picture in day evening; do
  head -c 2 "$picture.ppm" | grep -q P6 || fail "$picture.ppm is no picture"
done
cmp -s day.ppm evening.ppm && fail "the faders changed nothing"
finish
