#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A Blender file to a picture with two faders moved, in three minutes at most.
source "$(dirname "$0")/begin.sh"
need "${BLENDER:-blender}" blender

# Somebody's file, not part of the job: a room with two lamps, each in a light group of its own.
BLENDER_USER_SCRIPTS="$out/scripts" "${BLENDER:-blender}" -b --factory-startup --python-exit-code 1 -P "$here/room.py" -- "$out/room.blend" >blender.log 2>&1 ||
  fail "$(tail -3 blender.log)"

SECONDS=0
"$sconce" bake room.blend --quality draft --quiet
"$sconce" render room.sconce -o day.png --size 640x360 --quiet
"$sconce" render room.sconce ceiling=off desk=2700K,+2ev -o evening.png --size 640x360 --quiet
cmp -s day.png evening.png && fail "the faders changed nothing"
[ "$SECONDS" -le 180 ] || fail "took $SECONDS s"
finish
