#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# One multi-layer EXR of a picture's light groups, whose layers sum to the picture in another program.
source "$(dirname "$0")/begin.sh"
need oiiotool openimageio-tools

cp "$scenes/bathroom.glb" .
"$sconce" bake bathroom.glb --atlas 512 --quality draft --quiet
"$sconce" render bathroom.sconce --layers groups --device cpu --size 320x180 --samples 4 --quiet -o layers.exr

sum=()
for group in ceiling mirror shower window; do
  [ ${#sum[@]} -eq 0 ] && add=() || add=(--add)
  sum+=(layers.exr --ch "$group.R,$group.G,$group.B" --chnames R,G,B "${add[@]}")
done
oiiotool "${sum[@]}" -d float -o sum.exr
largest() { oiiotool --stats "$@" | awk '/Stats Max/ { m = 0; for (i = 3; i <= 5; ++i) if ($i > m) m = $i; print m; exit }'; }
oiiotool sum.exr layers.exr --ch R,G,B --sub --abs -d float -o difference.exr
all=$(largest layers.exr --ch R,G,B) off=$(largest difference.exr)
echo "the picture's largest value is $all cd/m2, the sum's largest error $off"
awk -v all="$all" -v off="$off" 'BEGIN { exit !(all > 0 && off <= 1e-3 * all) }' || fail "the layers do not sum to the picture"
finish
