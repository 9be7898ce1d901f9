#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/fuzz/run.sh SCONCE FUZZ_BUILD DATA RUNS [TARGET...]: one fuzz target after the other, RUNS inputs each, from small files of
# ours and of DATA. Each input may take 10 s and 4 GB. What is found stays in FUZZ_BUILD/found; bench/results/fuzz.md has a row per
# target: inputs of all runs since the last finding. SECONDS_EACH ends a target early.
set -euo pipefail
cd "$(dirname "$0")/../.."

if [ $# -lt 4 ]; then
  echo "usage: tests/fuzz/run.sh SCONCE FUZZ_BUILD DATA RUNS [TARGET...]" >&2
  exit 2
fi
sconce=$(realpath "$1") build=$(realpath "$2") data=$(realpath "$3") runs=$4
shift 4
table=bench/results/fuzz.md
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for source in tests/fuzz/*.cpp; do targets+=("$(basename "$source" .cpp)"); done
fi

seeds=$build/seeds
take() {  # take TARGET FILE...: those that are small
  local target=$1
  shift
  mkdir -p "$seeds/$target"
  for file in "$@"; do
    if [ -f "$file" ] && [ "$(stat -c %s "$file")" -le 40000 ]; then
      cp "$file" "$seeds/$target/$(sha1sum <"$file" | head -c 12)"
    fi
  done
}

make_seeds() {
  local work suite=$data/conformance
  work=$(mktemp -d)
  local bake=(--quiet --threads 1 --density 2 --samples 1 --bounces 1 --cloud 64)
  printf '[[light]]\nname = "%s"\ntype = "point"\nposition = [%d, 0.5, 0]\nintensity = 10\n' a 1 b 0 >"$work/room.toml"
  printf 'v %d 0 %d\n' -1 -1 1 -1 1 1 -1 1 >"$work/room.obj"
  echo 'f 4 3 2 1' >>"$work/room.obj"
  local encoding
  for encoding in f16 f32 rgbe8 srgbe8 exp8 multi8 bc6h lum:f16 lum:exp8; do
    "$sconce" bake "$work/room.obj" -o "$work/$encoding.sconce" "${bake[@]}" --encoding "$encoding" 2>/dev/null
    take layer "$work/$encoding.sconce/layers/"*
    take manifest "$work/$encoding.sconce/manifest.json"
  done
  "$sconce" bake "$work/room.obj" -o "$work/denoised.sconce" "${bake[@]}" --basis sh1 --denoise on 2>/dev/null
  take manifest "$work/denoised.sconce/manifest.json"
  take scene_glb "$work/denoised.sconce/scene.glb"
  "$sconce" transfer "$work/f16.sconce" --quiet --threads 1 --gather 256 --rays 4 --cluster 16 --coefficients 8 \
    --bounce-coefficients 4 --points 1 --lights 16 2>/dev/null
  take operator "$work/f16.sconce/operators/"*
  "$sconce" bake "$work/room.obj" -o "$work/part" "${bake[@]}" --shard 1/2 2>/dev/null
  take state "$work"/part*
  sed -n '/^```toml/,/^```/{/^```/!p}' docs/side-file.md >"$work/example.toml"
  take side_file scenes/*.toml "$work/room.toml" "$work/example.toml"
  "$sconce" init "$work/room.obj" -o "$work/init.toml" --quiet 2>/dev/null && take side_file "$work/init.toml"
  take preset scenes/moods/*.toml scenes/theatre/moods/*.toml
  printf 'ceiling=0.5,2700K\ndesk*=+1.5ev\nsky=off' >"$work/a"
  printf 'ceiling=800lm,color:#ff8800\ndesk lamp=50%%\n*=on,#00ff80' >"$work/b"
  take settings "$work/a" "$work/b"
  take photometry "$data"/photometry/ies/*/*.[iI][eE][sS] "$data"/photometry/ldt/*/*.ldt "$data"/photometry/ldt/*/*/*.ldt
  cat >"$work/tm33" <<'END'
<?xml version="1.0"?>
<IESTM33-22><Header><Manufacturer>M</Manufacturer></Header><Luminaire><Dimensions><Length>0.1</Length></Dimensions></Luminaire>
<Emitter><Quantity>1</Quantity><RatedLumens>6</RatedLumens><LuminousData><LuminousIntensity>
<IntData h="0" v="0">1</IntData><IntData h="0" v="90">2</IntData><IntData h="0" v="180">0</IntData>
</LuminousIntensity></LuminousData></Emitter></IESTM33-22>
END
  take photometry "$work/tm33"
  mkdir -p "$work/zip/ldc" && cp "$data/photometry/ies/mdl-sdk/test.ies" "$work/zip/ldc/lamp.ies"
  cat >"$work/zip/product.xml" <<'END'
<Root><GeneralDefinitions><Files><File id="f" contentType="ldc/ies" type="localFileName">lamp.ies</File></Files>
<Photometries><Photometry id="p"><PhotometryFileReference fileId="f"/></Photometry></Photometries>
<Emitters><Emitter id="e"><FixedLightEmitter><PhotometryReference photometryId="p"/></FixedLightEmitter></Emitter></Emitters>
</GeneralDefinitions></Root>
END
  (cd "$work/zip" && cmake -E tar cf ../lamp.gldf --format=zip product.xml ldc/lamp.ies)
  take gldf "$work/lamp.gldf"
  take rays "$data"/photometry/tm25/*/*.ray "$data"/photometry/tm25/*/*.txt
  local file
  for file in "$data"/photometry/tm25/*ray "$data"/photometry/tm25/*/*25ray; do
    if [ -f "$file" ]; then head -c 4000 "$file" >"$work/head" && take rays "$work/head"; fi
  done
  for file in "$data"/photometry/tm25/*/*.ray; do
    "$sconce" luminaire field "$file" -o "$work/field.exr" --pixels 8 --spacing 100 --quiet 2>/dev/null && take light_field "$work/field.exr"
  done
  while read -r file; do take gltf "$file"; done < <(find "$suite" "$data/glb" -name '*.gltf' -o -name '*.glb')
  take gltf "$work/denoised.sconce/scene.glb"
  tar xJf "$suite/ufbx-obj-fuzz.tar.xz" -C "$work"
  take obj "$suite"/tinyobj/*.obj "$work"/ufbx-obj-fuzz/obj_fuzz/*.obj
  for file in "$suite"/tinyobj/*.mtl "$work"/ufbx-obj-fuzz/mtl_fuzz/*.mtl; do
    { cat "$suite/tinyobj/cube.obj" && echo '#mtl' && cat "$file"; } >"$work/both" && take obj "$work/both"
  done
  rm -r "$work"
}

[ -d "$seeds" ] || make_seeds
[ -d /dev/shm ] && [ -w /dev/shm ] && export TMPDIR=/dev/shm
[ -f "$table" ] || printf '| reader | inputs | reached | findings |\n|---|---|---|---|\n' >"$table"
failed=0
for target in "${targets[@]}"; do
  corpus=$build/corpus/$target found=$build/found/$target log=$build/found/$target.log
  mkdir -p "$corpus" "$found" "$seeds/$target"
  row=$(grep "^| $target |" "$table" || true) whole=1
  "$build/tests/fuzz/fuzz_$target" -runs="$runs" -max_total_time="${SECONDS_EACH:-0}" -timeout=10 -rss_limit_mb=4096 -max_len=40000 \
    -print_final_stats=1 -artifact_prefix="$found/" "$corpus" "$seeds/$target" >"$log" 2>&1 || failed=1 whole=0
  inputs=$(awk '/stat::number_of_executed_units/ { print $2 }' "$log")
  reached=$(awk '/ cov: / { for (i = 1; i < NF; ++i) if ($i == "cov:") n = $(i + 1) } END { print n + 0 }' "$log")
  findings=$(find "$found" -type f | wc -l)
  # Runs add up until something is found.
  inputs=$(awk -F '|' -v n="${inputs:-0}" -v whole=$whole '{ n += $3 } END { print whole ? n : 0 }' <<<"$row")
  sed -i "/^| $target |/d" "$table"
  echo "| $target | $inputs | $reached | $findings |" | tee -a "$table"
done
exit $failed
