"""Points a second beside SciPy, QMCPy and the crate sobol_burley, in one run, on one thread.

    cargo build --release -p luch-lab --example points_speed
    python bench/peers/points.py target/release/examples/points_speed [--count 65536] [--repeats 7]

Needs numpy, scipy and qmcpy. Everybody fills the same number of points; setting up is part of it where the program cannot be asked
without. Medians, millions of coordinates a second.
"""

import argparse
import statistics
import subprocess
import time
import warnings

warnings.filterwarnings("ignore")

import numpy as np
import qmcpy
from scipy.stats import qmc

OURS = {
    "independent": "independent",
    "latin hypercube": "latin-hypercube",
    "Halton, plain": "halton",
    "Halton, scrambled": "halton-scrambled",
    "Sobol', plain": "sobol",
    "Sobol', linear scramble": "sobol-linear",
    "Sobol', Owen": "sobol-owen",
    "Sobol', hashed Owen": "sobol-hashed",
    "lattice, shifted": "lattice",
}


def peers(d, n):
    rng = np.random.default_rng(1)
    yield "independent", "numpy PCG64", lambda: rng.random((n, d))
    yield "latin hypercube", "SciPy", lambda: qmc.LatinHypercube(d, rng=1).random(n)
    yield "Halton, plain", "SciPy", lambda: qmc.Halton(d, scramble=False).random(n)
    yield "Halton, plain", "QMCPy", lambda: qmcpy.Halton(d, randomize=False).gen_samples(n, warn=False)
    yield "Halton, scrambled", "SciPy", lambda: qmc.Halton(d, scramble=True, rng=1).random(n)
    yield "Halton, scrambled", "QMCPy", lambda: qmcpy.Halton(d, randomize="LMS_PERM", seed=1).gen_samples(n)
    yield "Sobol', plain", "SciPy", lambda: qmc.Sobol(d, scramble=False).random(n)
    yield "Sobol', plain", "QMCPy", lambda: qmcpy.DigitalNetB2(d, randomize=False).gen_samples(n, warn=False)
    yield "Sobol', linear scramble", "SciPy", lambda: qmc.Sobol(d, scramble=True, rng=1).random(n)
    yield "Sobol', linear scramble", "QMCPy", lambda: qmcpy.DigitalNetB2(d, randomize="LMS_DS", seed=1).gen_samples(n)
    yield "Sobol', Owen", "QMCPy", lambda: qmcpy.DigitalNetB2(d, randomize="NUS", seed=1).gen_samples(n)
    yield "lattice, shifted", "QMCPy", lambda: qmcpy.Lattice(d, seed=1).gen_samples(n)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=1 << 16)
    parser.add_argument("--repeats", type=int, default=7)
    args = parser.parse_args()
    print("| points | dimensions | luch | best of the others | | ratio |\n|---|---|---|---|---|---|")
    for d in (2, 8, 32):
        command = [args.program, str(args.count), str(d), str(args.repeats), *OURS.values()]
        lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
        ours = {name: float(rate) for name, rate in (line.split("\t") for line in lines)}
        best = {"Sobol', hashed Owen": (ours["sobol_burley"], "sobol_burley")}
        for kind, who, work in peers(d, args.count):
            work()
            times = []
            # Slow ones need no seven rounds.
            for _ in range(args.repeats):
                start = time.perf_counter()
                work()
                times.append(time.perf_counter() - start)
                if sum(times) > 10:
                    break
            rate = args.count * d / statistics.median(times) / 1e6
            best[kind] = max(best.get(kind, (0, "")), (rate, who))
        for kind, rule in OURS.items():
            rate, who = best[kind]
            print(f"| {kind} | {d} | {ours[rule]:.0f} | {rate:.1f} | {who} | {ours[rule] / rate:.1f} |", flush=True)


main()
