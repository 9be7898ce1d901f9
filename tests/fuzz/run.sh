#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/fuzz/run.sh SCONCE FUZZ_BUILD DATA RUNS [TARGET...]: one fuzz target after the other until RUNS inputs are through each, from
# small files of ours and of DATA. Each input may take 4 GB and 10 s by the clock (PATIENCE=60 where others compute, too). What is found
# stays in FUZZ_BUILD/found, and its target counts from 0 again. FUZZ_BUILD/counts keeps what libFuzzer has counted, in parts of 100 000:
# run again after a stop, it goes on from there. SECONDS_EACH ends a target early. Writes bench/results/fuzz.md from the counts.
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
  mkdir -p "$seeds.new/$target"
  for file in "$@"; do
    if [ -f "$file" ] && [ "$(stat -c %s "$file")" -le 40000 ]; then
      cp "$file" "$seeds.new/$target/$(sha1sum <"$file" | head -c 12)"
    fi
  done
}

make_seeds() {
  local work suite=$data/conformance
  work=$(mktemp -d)
  rm -rf "$seeds.new"
  local bake=(--quiet --threads 1 --density 2 --samples 1 --bounces 1 --cloud 64)
  printf '[[light]]\nname = "%s"\ntype = "point"\nposition = [%d, 0.5, 0]\nintensity = 10\n' a 1 b 0 >"$work/room.toml"
  printf 'v %d 0 %d\n' -1 -1 1 -1 1 1 -1 1 >"$work/room.obj"
  echo 'f 4 3 2 1' >>"$work/room.obj"
  local encoding
  for encoding in f16 f32 rgbe8 srgbe8 exp8 multi8 bc6h lum:f16 lum:exp8; do
    "$sconce" bake "$work/room.obj" -o "$work/$encoding.sconce" "${bake[@]}" --encoding "$encoding" 2>/dev/null
    take layer "$work/$encoding.sconce/layers/"*
    tr -s ' \n' ' ' <"$work/$encoding.sconce/manifest.json" >"$work/manifest" && take manifest "$work/manifest"
  done
  "$sconce" bake "$work/room.obj" -o "$work/denoised.sconce" "${bake[@]}" --basis sh1 --denoise on 2>/dev/null
  tr -s ' \n' ' ' <"$work/denoised.sconce/manifest.json" >"$work/manifest" && take manifest "$work/manifest"
  take scene_glb "$work/denoised.sconce/scene.glb"
  "$sconce" transfer "$work/f16.sconce" --quiet --threads 1 --gather 256 --rays 4 --cluster 256 --coefficients 2 \
    --bounce-coefficients 2 --points 1 --lights 16 2>/dev/null
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
  take l3d "$data"/photometry/l3d/*/structure.xml
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
  take mtl "$suite"/tinyobj/*.mtl "$work"/ufbx-obj-fuzz/mtl_fuzz/*.mtl
  for file in "$suite"/tinyobj/*.mtl "$work"/ufbx-obj-fuzz/mtl_fuzz/*.mtl; do
    { cat "$suite/tinyobj/cube.obj" && echo '#mtl' && cat "$file"; } >"$work/both" && take obj "$work/both"
  done
  rm -r "$work"
  # Short ones, which are quick: 5 KB, or else the shortest there is.
  local folder
  for folder in "$seeds.new"/*; do
    file=$(find "$folder" -type f -printf '%s %p\n' | sort -n | head -n 1 | cut -d ' ' -f 2)
    find "$folder" -type f -size +5000c ! -path "$file" -delete
  done
  mv "$seeds.new" "$seeds"
}

# The table: a row per target that has been counted.
write_table() {
  local source name inputs reached
  printf '| reader | inputs | reached | findings |\n|---|---|---|---|\n'
  for source in tests/fuzz/*.cpp; do
    name=$(basename "$source" .cpp)
    [ -f "$build/counts/$name" ] || continue
    read -r inputs reached <"$build/counts/$name"
    echo "| $name | $inputs | $reached | $(find "$build/found/$name" -type f | wc -l) |"
  done
}

if [ -w /dev/shm ]; then export TMPDIR=/dev/shm; fi
[ -d "$seeds" ] || make_seeds
# Short stacks for allocations, and little freed memory kept aside, which costs caches more than it finds; symbols when something is found.
export ASAN_OPTIONS=malloc_context_size=4:quarantine_size_mb=16${ASAN_OPTIONS:+:$ASAN_OPTIONS}
mkdir -p "$build/counts"
failed=0
for target in "${targets[@]}"; do
  corpus=$build/corpus/$target found=$build/found/$target log=$build/found/$target.log count=$build/counts/$target
  mkdir -p "$corpus" "$found" "$seeds/$target"
  inputs=0 reached=0
  [ ! -f "$count" ] || read -r inputs reached <"$count"
  # Half as much again as the longest seed, 4 KB at least.
  longest=$(find "$seeds/$target" -type f -printf '%s\n' | sort -n | tail -n 1)
  longest=$((${longest:-0} * 3 / 2 > 4096 ? longest * 3 / 2 : 4096))
  begin=$SECONDS
  while [ "$inputs" -lt "$runs" ] && [ $((SECONDS - begin)) -lt "${SECONDS_EACH:-1000000}" ]; do
    part=$((runs - inputs < 100000 ? runs - inputs : 100000)) whole=1
    "$build/tests/fuzz/fuzz_$target" -runs=$part -max_total_time="${SECONDS_EACH:-0}" -timeout=${PATIENCE:-10} -rss_limit_mb=4096 \
      -max_len=$longest -entropic_scale_per_exec_time=1 -print_final_stats=1 -artifact_prefix="$found/" "$corpus" "$seeds/$target" \
      >"$log" 2>&1 || whole=0
    made=$(awk '$1 == "stat::number_of_executed_units:" { print $2 }' "$log")
    inputs=$((inputs + ${made:-0}))
    reached=$(awk '/ cov: / { for (i = 1; i < NF; ++i) if ($i == "cov:") n = $(i + 1) } END { print n + 0 }' "$log")
    if [ $whole = 0 ]; then
      failed=1
      echo "$target: see $log"
      [ -z "$(find "$found" -type f)" ] || inputs=0  # otherwise it was interrupted
    fi
    echo "$inputs $reached" >"$count"
    echo "$target: $inputs inputs"
    [ $whole = 1 ] || break
  done
  write_table >"$table"
done
exit $failed
