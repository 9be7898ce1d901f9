#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# with_display.sh WIDTHxHEIGHT COMMAND...: runs the command on a display of its own and exits as the command does.
# The server picks its number and says when it listens; xvfb-run guesses both, and exits 5 where its own cleaning up fails.
size=$1
shift
folder=$(mktemp -d) || exit 1
mkfifo "$folder/number"
Xvfb -displayfd 3 -screen 0 "${size}x24" -nolisten tcp 3>"$folder/number" >/dev/null 2>&1 &
server=$!
read -r number <"$folder/number"
if [ -n "$number" ]; then
  DISPLAY=:$number "$@"
  code=$?
else
  echo "with_display.sh: Xvfb did not start" >&2
  code=1
fi
kill "$server" 2>/dev/null
wait "$server" 2>/dev/null
rm -rf "$folder"
exit "$code"
