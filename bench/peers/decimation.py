"""Decimation beside meshoptimizer's and fast_simplification's, in one run.

    cargo build --release -p luch-mesh --example decimate
    python bench/peers/decimation.py target/release/examples/decimate [--levels 6] [--repeats 5]

Needs numpy, trimesh, meshoptimizer, fast-simplification and vtk. A ball with bumps of 1.3 million triangles becomes one of a tenth. Rounds are
interleaved; printed are medians of elapsed milliseconds with the mesh in memory, and how far a sample of the original's vertices lies from
the result (root of the mean square, and greatest).
"""

import argparse
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import fast_simplification
import meshoptimizer
import numpy as np
import trimesh
import vtk


def bumpy_ball(levels):
    ball = trimesh.creation.icosphere(subdivisions=2)
    vertices, faces = trimesh.remesh.subdivide_loop(ball.vertices, ball.faces, iterations=levels)
    n = vertices / np.linalg.norm(vertices, axis=1)[:, None]
    x, y, z = n.T
    height = 1 + 0.05 * np.sin(9 * x) * np.sin(11 * y) * np.sin(7 * z) + 0.01 * np.sin(40 * x + 30 * y)
    return (n * height[:, None]).astype(np.float32), faces.astype(np.uint32)


def meshopt(vertices, faces, goal):
    result = np.zeros(faces.size, dtype=np.uint32)
    start = time.perf_counter()
    count = meshoptimizer.simplify(result, faces.ravel(), vertices, target_index_count=goal * 3, target_error=1e9)
    return (time.perf_counter() - start) * 1e3, vertices, result[:count].reshape(-1, 3)


def fast(vertices, faces, goal):
    faces = faces.astype(np.int32)
    start = time.perf_counter()
    vertices, faces = fast_simplification.simplify(vertices, faces, target_count=goal)
    return (time.perf_counter() - start) * 1e3, vertices, faces


def luch(program, source, goal, threads, folder):
    path = Path(folder) / "result.ply"
    line = subprocess.run(
        [program, source, str(goal), str(threads), "2", path], check=True, capture_output=True, text=True
    ).stdout.split("\t")
    mesh = trimesh.load(path, process=False)
    return float(line[1]), np.asarray(mesh.vertices), np.asarray(mesh.faces)


def distances(points, vertices, faces):
    """How far points lie from a surface: root of the mean square, and greatest."""
    surface = vtk.vtkPolyData()
    places = vtk.vtkPoints()
    places.SetData(vtk.util.numpy_support.numpy_to_vtk(np.ascontiguousarray(vertices, np.float64), deep=True))
    cells = vtk.vtkCellArray()
    rows = np.hstack([np.full((len(faces), 1), 3), faces]).astype(np.int64).ravel()
    cells.ImportLegacyFormat(vtk.util.numpy_support.numpy_to_vtkIdTypeArray(rows, deep=True))
    surface.SetPoints(places)
    surface.SetPolys(cells)
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    closest, cell, part, square = [0.0] * 3, vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    squares = []
    for point in points:
        locator.FindClosestPoint(point, closest, cell, part, square)
        squares.append(square.get())
    return np.sqrt(np.mean(squares)), np.sqrt(np.max(squares))


def main():
    import vtk.util.numpy_support  # noqa: F401

    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--levels", type=int, default=6)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    vertices, faces = bumpy_ball(options.levels)
    goal = len(faces) // 10
    picked = np.random.default_rng(1).choice(len(vertices), min(20000, len(vertices)), replace=False)
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "source.ply"
        trimesh.Trimesh(vertices, faces, process=False).export(source)
        programs = {
            "luch, 1 thread": lambda: luch(options.program, source, goal, 1, folder),
            "luch, 2 threads": lambda: luch(options.program, source, goal, 2, folder),
            "meshoptimizer": lambda: meshopt(vertices, faces, goal),
            "fast_simplification": lambda: fast(vertices, faces, goal),
        }
        times = {program: [] for program in programs}
        results = {}
        for _ in range(options.repeats):
            for program, run in programs.items():
                elapsed, *results[program] = run()
                times[program].append(elapsed)
        print(f"{len(faces)} -> {goal} triangles\n| program | ms | triangles | rms | greatest |\n|---|---|---|---|---|")
        for program, found in times.items():
            mean, most = distances(vertices[picked].astype(float), *results[program])
            count = len(results[program][1])
            print(f"| {program} | {statistics.median(found):.0f} | {count} | {mean:.2e} | {most:.2e} |")


if __name__ == "__main__":
    main()
