#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# An engine host shows the mixed lightmap and follows a fader: the installed example, built against the installed library.
source "$(dirname "$0")/begin.sh"
need cc gcc
libraries=$(dirname "$(find "$prefix" -name libsconce-runtime.so | head -1)")
host=$out/host_gl
cc -O1 "$prefix/share/doc/sconce/examples/host_gl.c" -o "$host" -I "$prefix/include" -L "$libraries" -Wl,-rpath,"$libraries" \
  -lsconce-runtime -lepoxy || fail "the example does not build (Debian: libepoxy-dev)"

cp "$scenes/bathroom.glb" .
"$sconce" bake bathroom.glb --atlas 512 --quality draft --quiet
"$host" bathroom.sconce day.ppm
"$host" bathroom.sconce evening.ppm window=off ceiling=2700K,40%
for picture in day evening; do
  head -c 2 "$picture.ppm" | grep -q P6 || fail "$picture.ppm is no picture"
done
cmp -s day.ppm evening.ppm && fail "the faders changed nothing"
finish
