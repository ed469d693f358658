#!/usr/bin/env python3
"""Renders a bench scene with luch and records the time of the render alone.

Takes the arguments of the harness's own render_*.py and writes what they write: SCENE_luch_SPP_SEED.npy and a line
of results.jsonl. Needs numpy only. The folder of the harness is in LUCH_PEER_HARNESS, the command in LUCH_COMMAND;
further words for `luch render` in LUCH_PEER_OPTIONS. The peer's name is luch, or as --peer says.
"""
import argparse
import json
import os
import shlex
import subprocess
import sys
import tempfile
import time

import numpy as np

sys.path.insert(0, os.environ["LUCH_PEER_HARNESS"])
import benchlib as bl  # noqa: E402


def scene_file(folder):
    """The peers' scene, or one of luch's own for trials without the importer."""
    for name in ["scene.xml", "scene.kdl"]:
        if os.path.exists(os.path.join(folder, name)):
            return os.path.join(folder, name)
    sys.exit(f"{folder}: holds neither scene.xml nor scene.kdl")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    bl.common_arguments(parser)
    parser.add_argument("--peer", default="luch")
    args = parser.parse_args()
    options = shlex.split(os.environ.get("LUCH_PEER_OPTIONS", ""))
    if args.max_depth is not None:
        # The harness counts path segments, luch counts scatterings.
        options += ["--max-depth", str(args.max_depth - 1)]
    for spp in args.spp:
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "picture.npy")
            command = [os.environ["LUCH_COMMAND"], "render", scene_file(args.scene), "-o", picture, "--no-checkpoint",
                       "--progress", "json", "--spp", str(spp), "--seed", str(args.seed + 1),
                       "--threads", str(args.threads), *options]
            with bl.bench_lock():
                start = time.time()
                said = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout
                wall_s = time.time() - start
            end = json.loads(said.splitlines()[-1])
            image = np.load(picture)
        if end["event"] != "end" or end["ending"] != "samples":
            sys.exit(f"{args.scene}: the render did not reach its samples: {end}")
        bl.finish_run(args, os.path.basename(os.path.normpath(args.scene)), args.peer, spp, image,
                      end["render_seconds"], end["processor_seconds"], wall_s)


if __name__ == "__main__":
    main()
