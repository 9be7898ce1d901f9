#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing of the sections of packages.txt that are named (default: lean). Prints the exact line first;
# touches nothing when everything is there.
set -euo pipefail
cd "$(dirname "$0")/.."

sections=("$@")
[ ${#sections[@]} -gt 0 ] || sections=(lean)

packages_of() {  # packages_of SECTION
  awk -v wanted="[$1]" '{ sub(/#.*/, "") } /^\[/ { inside = ($1 == wanted); found = found || inside; next }
    inside && NF { print $1 } END { exit !found }' packages.txt
}

if ! command -v dpkg-query >/dev/null; then
  echo "setup: this is no Debian; install what packages.txt lists by other means" >&2
  exit 0
fi

# A package that another one stands in for (npm of a newer nodejs) is there.
installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}, ${Provides}\n' | awk '$1 == "installed"' |
  sed 's/^installed //; s/([^)]*)//g' | tr -s ', ' '\n')
missing=()
for section in "${sections[@]}"; do
  packages=$(packages_of "$section") || {
    echo "setup: packages.txt has no section '$section'" >&2
    exit 2
  }
  for package in $packages; do
    grep -qxF -- "$package" <<<"$installed" || missing+=("$package")
  done
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" != 0 ]; then as_root=(sudo); fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600)
install=("${apt[@]}" install -y --no-install-recommends "${missing[@]}")

echo "setup: ${#missing[@]} packages are missing; running:"
echo "  ${apt[*]} update && ${install[*]}"
if [ ${#as_root[@]} -gt 0 ] && ! command -v sudo >/dev/null; then
  echo "setup: needs root or sudo; run the line above as root, then try again" >&2
  exit 1
fi
"${apt[@]}" update
"${install[@]}"
