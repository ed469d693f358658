#!/usr/bin/env python3
"""Renders the bench scenes with luch and its peers, interleaved, and says how far ahead luch is at equal error.

Stands on the harness's own bench.py and report.py, so that all figures are defined in one place: relMSE without the
worst 0.1 % of the pixels, noise from pairs of seeds, seconds to an error by log-log interpolation and slope -1
beyond the ends, processor time over the threads, each ratio within one repetition.

usage: peers.py run|report --harness DIR --scenes DIR --out DIR [options of the harness's bench.py or report.py]
"""
import argparse
import contextlib
import io
import json
import math
import os
import statistics
import sys

HERE = os.path.dirname(os.path.abspath(__file__))

# S of the strongest peer of each scene, as measured with the harness on 2026-11-22 on two cores, with Cycles and
# LuxCore among the peers: Mitsuba llvm's seconds over that peer's seconds to the same error.
STRONGEST = {
    64: {"cornell": 1.68, "veach_mis": 4.34, "bunny_sky": 1.88, "caustics": 1.02, "corridor": 1.10, "many_lights": 1.27},
    256: {"cornell": 1.74, "veach_mis": 5.59, "bunny_sky": 2.12, "caustics": 1.02, "corridor": 1.07, "many_lights": 1.42},
}
# Ratios below this are within what repetitions differ by.
DRAW = 1.25


def run(args, rest):
    os.environ["LUCH_PEER_HARNESS"] = args.harness
    os.environ.setdefault("LUCH_PYTHON", sys.executable)
    import bench

    bench.PEERS["luch"] = ("LUCH_PYTHON", [os.path.join(HERE, "render_luch.py")])
    if "--peers" not in rest:
        rest += ["--peers", "mitsuba-llvm", "mitsuba-llvm-multijitter", "luch"]
    sys.argv = ["bench.py", "--scenes", args.scenes, "--out", args.out, *rest]
    bench.main()


def report(args, rest):
    import report as harness

    harness.ORDER.insert(0, "luch")
    figures = os.path.join(args.out, "figures.json")
    tables = {}
    for spp in STRONGEST:
        sys.argv = ["report.py", "--scenes", args.scenes, "--out", args.out, "--target-spp", str(spp),
                    "--json", figures, *rest]
        text = io.StringIO()
        with contextlib.redirect_stdout(text):
            harness.main()
        with open(figures) as source:
            tables[spp] = (text.getvalue(), json.load(source)["figures"])
    for spp, (_, scenes) in tables.items():
        lead(spp, scenes)
    print(tables[64][0])


def lead(spp, scenes):
    """How far ahead luch is at the error that Mitsuba llvm reaches with so many samples."""
    print(f"### Lead at the relMSE that Mitsuba llvm reaches at {spp} spp\n")
    print("S = Mitsuba llvm's seconds over luch's seconds to that error, in one repetition; the median, smallest and largest.\n"
          "1x, 2x, 4x: the S that is level with, twice and four times as fast as the strongest peer known.\n")
    print("| scene | target relMSE | luch, s | S | 1x | 2x | 4x | S / 1x | times the best here |")
    print("|---|---|---|---|---|---|---|---|---|")
    leads = []
    for scene, figure in scenes.items():
        own = figure["peers"].get("luch")
        if own is None or not own["ratios"]:
            continue
        ratios = own["ratios"]
        s, level = statistics.median(ratios), STRONGEST[spp][scene]
        here = max(f["speedup"] for p, f in figure["peers"].items() if p != "luch" and f["speedup"])
        leads.append(s / level)
        word = " (draw)" if 1 / DRAW < s / level < DRAW else ""
        print(f"| {scene} | {figure['target']:.3e} | {own['seconds']:.2f} | {s:.2f} ({min(ratios):.2f}-{max(ratios):.2f}) | "
              f"{level:.2f} | {2 * level:.2f} | {4 * level:.2f} | {s / level:.2f}{word} | {s / here:.2f} |")
    if leads:
        mean = math.exp(statistics.fmean(map(math.log, leads)))
        print(f"| geometric mean of {len(leads)} | | | | | | | {mean:.2f} | |")
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["run", "report"])
    parser.add_argument("--harness", required=True, help="folder of the harness (bench.py, report.py)")
    parser.add_argument("--scenes", required=True)
    parser.add_argument("--out", required=True)
    args, rest = parser.parse_known_args()
    args.harness = os.path.abspath(args.harness)
    sys.path.insert(0, args.harness)
    {"run": run, "report": report}[args.what](args, rest)


if __name__ == "__main__":
    main()
