#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# An office from `init --room` to tables of lux, in full and dimmed to 40 %.
source "$(dirname "$0")/begin.sh"
need python3 python3

# A maker's file, not part of the job: 3,000 lm, Lambertian (955 cd), 0.6 x 0.6 m.
{
  printf 'IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 10 1 1 2 0.6 0.6 0\n1 1 30\n0 10 20 30 40 50 60 70 80 90\n0\n'
  echo "955 940.5 897.4 827 731.6 613.9 477.5 326.6 165.8 0"
} >panel.ies

"$sconce" init --room 8x6x2.8 --reflectance 70/50/20 --luminaire panel.ies --count 3x4 --mount 2.7 -o office --quiet
"$sconce" bake office.glb --quality draft --quiet
"$sconce" probe office.sconce --plane floor+0.75 -o full.csv --quiet
"$sconce" probe office.sconce --plane floor+0.75 luminaires=40% -o dimmed.csv --quiet

# 12 x 3,000 lm on 48 m2 with a usual utilisation of 0.5 to 0.95; the dimmed table is 0.4 of the other.
python3 - <<'PY' || fail "the figures are not an office's"
import csv
full, dimmed = ([float(row["lux"]) for row in csv.DictReader(open(name))] for name in ("full.csv", "dimmed.csv"))
mean = sum(full) / len(full)
print(f"{len(full)} points, {mean:.0f} lx on average, {sum(dimmed) / len(dimmed):.0f} lx dimmed")
assert len(full) == 14 * 10 and 0.5 * 36000 / 48 < mean < 0.95 * 36000 / 48, mean
assert all(abs(b - 0.4 * a) < 1e-3 * a for a, b in zip(full, dimmed))
PY
finish
