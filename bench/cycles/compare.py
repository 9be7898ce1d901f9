#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Time until lightmaps reach a relative RMSE: sconce against Cycles, which bakes each light group anew. See README.md."""

import argparse
import json
import math
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TARGETS = (0.10, 0.05)


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", metavar="SCENE:GROUPING:ATLAS",
                        help="default: modern-hall with 1, 5 (named) and 13 (per-light) groups, luxcore-kitchen with 5")
    parser.add_argument("--solver", default="radiosity", help="of sconce (default: radiosity)")
    parser.add_argument("--samples", default="32,128,512", help="of sconce, two or more (default: 32,128,512)")
    parser.add_argument("--cycles-samples", default="32,128,512", help="of Cycles")
    parser.add_argument("--reference", type=int, default=4096,
                        help="paths per texel in each of the two references (default: 4096)")
    parser.add_argument("--drop", type=float, default=0.001, help="share of texels, the worst, to leave out (default: 0.001)")
    parser.add_argument("--denoise", action="store_true", help="sconce's layers are denoised, which counts as its time")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="of both")
    parser.add_argument("--clock", choices=("wall", "cpu"), default="wall",
                        help="cpu: of all threads, for a machine that has more to do")
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path,
                        default=os.environ.get("SCONCE_TEST_DATA", ROOT / "../shared/data"))
    parser.add_argument("--work", type=pathlib.Path, help="keep all packages here (default: a folder that is removed)")
    parser.add_argument("--reuse", action="store_true",
                        help="take references and Cycles' bakes that stand in --work: of the same scene and atlas")
    parser.add_argument("--output", default=HERE.parent / "results/cycles.md", type=pathlib.Path)
    options = parser.parse_args()
    glb = options.data / "glb"
    options.cases = [split(case) for case in options.cases] or [
        (glb / "modern-hall.glb", "one", 256), (glb / "modern-hall.glb", "named", 256),
        (glb / "modern-hall.glb", "per-light", 256), (glb / "luxcore-kitchen.glb", "named", 512)]
    options.samples, options.cycles_samples = (
        [int(n) for n in text.split(",")] for text in (options.samples, options.cycles_samples))
    return options


def split(case):
    try:
        scene, grouping, atlas = case.rsplit(":", 2)
        return pathlib.Path(scene).resolve(), grouping, int(atlas)
    except ValueError:
        sys.exit(f"compare.py: '{case}' is no SCENE:GROUPING:ATLAS")


class Bench:
    def __init__(self, options, work):
        self.options = options
        self.work = work

    def now(self):
        if self.options.clock == "wall":
            return time.monotonic()
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    def stands(self, package):
        return self.options.reuse and package.exists()

    def bake(self, case, name, solver, samples, seed=1, more=()):
        """@return (package, seconds)"""
        scene, grouping, atlas = case
        package = self.work / f"{name}.sconce"
        command = [self.options.build / "sconce", "bake", scene, "--groups", grouping, "--atlas", str(atlas), "--solver", solver,
                   "--samples", str(samples), "--seed", str(seed), "--threads", str(self.options.threads), "--encoding", "f32",
                   "--force", "--quiet", "-o", package, *more]
        start = self.now()
        if subprocess.run(command, stdout=subprocess.DEVNULL).returncode != 0:
            sys.exit(f"compare.py: {name} failed")
        return package, self.now() - start

    def errors(self, package, references):
        """group -> (relative RMSE, relative noise of the reference)"""
        command = [self.options.build / "tests/lightmap_error", package, *references, str(self.options.drop)]
        text = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
        rows = [line.split(" ", 4) for line in text.splitlines()]
        return {row[4]: (float(row[0]), float(row[2])) for row in rows}, int(rows[0][3])

    def sconce(self, case, references):
        """Points (samples, seconds, {group: error}). The atlas and the reading of the scene are not counted: Cycles uses what
        they give."""
        _, before = self.bake(case, "dry", "external:true", 1, more=["--dry-run"])  # no solver is prepared
        points = []
        for samples in self.options.samples:
            package, seconds = self.bake(case, f"sconce-{samples}", self.options.solver, samples,
                                         more=["--denoise", "on"] if self.options.denoise else [])
            errors, _ = self.errors(package, references)
            points.append((samples, seconds - before, {g: e for g, (e, _) in errors.items()}))
        return points

    def cycles(self, case, references):
        """The same per group: {group: [(samples, seconds, error)]}. Blender's start and all files are not counted."""
        os.environ["BLENDER"] = os.environ.get("BLENDER", "blender") + f" -t {self.options.threads}"
        points = {}
        for samples in self.options.cycles_samples:
            times = self.work / f"times-{samples}.jsonl"
            package = self.work / f"cycles-{samples}.sconce"
            if not self.stands(package):
                times.unlink(missing_ok=True)
                solver = f"external:'{ROOT}/solvers/cycles/sconce-cycles' --times '{times}'"
                self.bake(case, package.stem, solver, samples)
            errors, _ = self.errors(package, references)
            ending = "_s" if self.options.clock == "wall" else "_cpu_s"
            for line in times.read_text().splitlines():
                entry = json.loads(line)
                points.setdefault(entry["group"], []).append(
                    (samples, entry["setup" + ending] + entry["bake" + ending], errors[entry["group"]][0]))
        return points


def line(points):
    """Least squares of y = a + b x with weights, a >= 0: (a, b) of points (x, y, weight)."""
    w, x, y = (sum(f(p) for p in points) for f in (lambda p: p[2], lambda p: p[2] * p[0], lambda p: p[2] * p[1]))
    xx, xy = (sum(f(p) for p in points) for f in (lambda p: p[2] * p[0] ** 2, lambda p: p[2] * p[0] * p[1]))
    b = (w * xy - x * y) / (w * xx - x * x)
    a = (y - b * x) / w
    if a < 0:
        a, b = 0.0, xy / xx
    return a, max(b, 0.0)


def fit_time(points):
    """seconds = ready + per_sample * samples"""
    return line([(n, t, 1 / t**2) for n, t, _ in points])


def fit_error(points):
    """Relative: (floor, variance) of error^2 = floor^2 + variance / samples."""
    square, variance = line([(1 / n, e * e, 1 / max(e, 1e-9) ** 4) for n, _, e in points])
    return math.sqrt(square), variance


def samples_for(points, target):
    """Number of samples n at which a line through (log n, log error) of the two points about the target meets it: errors need
    not fall with the root of n."""
    points = sorted(points)
    at = next((i for i in range(1, len(points)) if points[i][1] <= target), len(points) - 1)
    (n0, e0), (n1, e1) = points[at - 1], points[at]
    if e1 >= e0:
        return n1 * max(1.0, (e1 / target) ** 2)
    return n0 * math.exp(math.log(e0 / target) * math.log(n1 / n0) / math.log(e0 / e1))


def compare(bench, case):
    scene, grouping, atlas = case
    references = []
    for seed in (1001, 1002):
        references.append(bench.work / f"reference-{seed}.sconce")
        if not bench.stands(references[-1]):
            bench.bake(case, references[-1].stem, "path", bench.options.reference, seed)
    checks, texels = bench.errors(references[0], references)
    ours, theirs = bench.sconce(case, references), bench.cycles(case, references)
    ready, per_sample = fit_time([(n, t, None) for n, t, _ in ours])
    fits = {}
    for group in theirs:
        ours_here = fit_error([(n, t, e[group]) for n, t, e in ours])
        fits[group] = (ours_here, fit_time(theirs[group]), fit_error(theirs[group]))

    name = f"{scene.stem}, {len(fits)} group{'s' if len(fits) > 1 else ''} (`--groups {grouping}`)"
    summary, details = [], [f"### {name}", "",
                            f"Atlas {atlas}, {texels} interior texels; reference 2 × {bench.options.reference} paths; sconce "
                            f"{ready:.2f} s + {1000 * per_sample:.3g} ms per sample.", "",
                            "| group | reference noise | sconce at each number of samples | its floor | Cycles | its floor | "
                            "Cycles s + ms per sample |", "|---|---|---|---|---|---|---|"]
    for group, ((floor, _), (setup, rate), (their_floor, _)) in fits.items():
        shown = [" ".join(f"{100 * e:.2f}" for e in errors) for errors in
                 ([e[group] for _, _, e in ours], [e for _, _, e in theirs[group]])]
        details.append(f"| {group} | {100 * checks[group][1]:.2f} % | {shown[0]} % | {100 * floor:.2f} % | {shown[1]} % | "
                       f"{100 * their_floor:.2f} % | {setup:.2f} + {1000 * rate:.3g} |")
    for target in TARGETS:
        needed = max(samples_for([(n, e[group]) for n, _, e in ours], target) for group in fits)
        mine = ready + per_sample * needed
        cycles = sum(setup + rate * variance / target**2 for _, (setup, rate), (_, variance) in fits.values())
        summary.append(f"| {name} | {100 * target:.0f} % | {cycles:.3g} s | {mine:.3g} s | {needed:.0f} | "
                       f"{cycles / mine:.1f} × |")
    return summary, details


def main():
    options = parse()
    for program in (options.build / "sconce", options.build / "tests/lightmap_error"):
        if not program.exists():
            sys.exit(f"compare.py: {program} is absent (ninja -C {options.build})")
    rows, details = [], []
    with tempfile.TemporaryDirectory() as scratch:
        for case in options.cases:
            work = (options.work or pathlib.Path(scratch)) / f"{case[0].stem}-{case[1]}"
            work.mkdir(parents=True, exist_ok=True)
            some, more = compare(Bench(options, work), case)
            print("\n".join(some), flush=True)
            rows += some
            details += ["", *more]
    version = subprocess.run(["blender", "--version"], stdout=subprocess.PIPE, text=True).stdout.split("\n")[0]
    head = [f"# sconce (`--solver {options.solver}{' --denoise on' if options.denoise else ''}`) against {version}, Cycles on the CPU", "",
            f"{options.threads} thread(s) for both, {options.clock} time; `bench/cycles/README.md` says what is compared.", "",
            "| scene | error | Cycles, all groups | sconce | its samples | factor |", "|---|---|---|---|---|---|"]
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text("\n".join(head + rows + details) + "\n", encoding="utf-8")


main()
