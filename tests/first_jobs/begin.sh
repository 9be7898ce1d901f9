# SPDX-License-Identifier: Apache-2.0
# What the first jobs share; each is `NAME.sh PREFIX/bin/sconce [FOLDER]`, takes nothing of sconce but what is installed there, and
# says at its end how long it took. Sourced.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: $0 PREFIX/bin/sconce [FOLDER]" >&2; exit 2; }
sconce=$(realpath "$1")
prefix=$(dirname "$(dirname "$sconce")")
scenes=$prefix/share/sconce/scenes
here=$(cd "$(dirname "$0")" && pwd)
[ -d "$scenes" ] || { echo "$0: $prefix is no installed sconce (cmake --install BUILD --prefix PREFIX)" >&2; exit 2; }
if [ $# -ge 2 ]; then
  mkdir -p "$2"
  out=$(realpath "$2")
else
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
fi
cd "$out"
SECONDS=0

fail() { echo "$(basename "$0"): $*" >&2; exit 1; }
need() { command -v "$1" >/dev/null || fail "needs $1 (Debian: $2)"; }
finish() { echo "$(basename "$0"): done in $SECONDS s"; }
