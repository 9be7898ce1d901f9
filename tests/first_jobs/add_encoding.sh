#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/first_jobs/add_encoding.sh: CONTRIBUTING.md's "Adding an encoding", applied word for word to a copy
# of the tree: `FILE` and the block after it is a new file, a diff block is applied, a sh block is run.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
tar -C "$root" --exclude ./build --exclude ./.git --exclude ./out --exclude ./shared --exclude node_modules -cf - . | tar -C "$copy" -xf -
cd "$copy"

python3 - <<'PY'
import pathlib, re, subprocess
page = pathlib.Path("CONTRIBUTING.md").read_text().split("## Adding an encoding", 1)[1]
script = []
for name, kind, text in re.findall(r"(?:^`([^`\n]+)`\n\n)?^```(\w+)\n(.*?)^```$", page, re.M | re.S):
    if kind == "diff":
        subprocess.run(["patch", "-p1", "--fuzz=0"], input=text.encode(), check=True)
    elif kind == "sh":
        script.append(text)
    else:
        assert name, "a block of code without its file"
        pathlib.Path(name).write_text(text)
assert script, "the page says nothing to run"
pathlib.Path("page.sh").write_text("set -e\n" + "".join(script))
PY
bash page.sh > page.log 2>&1 || { tail -40 page.log; exit 1; }
tail -3 page.log
build/release/encode_test --gtest_filter='Encoding.*' | grep -c '\[       OK \]'
