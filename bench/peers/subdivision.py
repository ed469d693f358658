"""Loop subdivision beside a port of OpenSubdiv, VTK and trimesh, in one run.

    cargo build --release -p luch-mesh --example divide
    python bench/peers/subdivision.py target/release/examples/divide [--levels 3] [--repeats 5]

Needs numpy, trimesh and vtk (pyvista brings it). The mesh lies in memory before the clock starts; medians in milliseconds.
"""

import argparse
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import trimesh
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
import numpy as np


def by_vtk(ball, levels, repeats):
    mesh = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(ball.vertices.astype(np.float32), deep=True))
    mesh.SetPoints(points)
    corners = np.hstack([np.full((len(ball.faces), 1), 3), ball.faces]).astype(np.int64).ravel()
    cells = vtk.vtkCellArray()
    cells.SetCells(len(ball.faces), numpy_to_vtkIdTypeArray(corners, deep=True))
    mesh.SetPolys(cells)
    times = []
    for _ in range(repeats):
        divide = vtk.vtkLoopSubdivisionFilter()
        divide.SetInputData(mesh)
        divide.SetNumberOfSubdivisions(levels)
        start = time.perf_counter()
        divide.Update()
        times.append((time.perf_counter() - start) * 1e3)
    return times, divide.GetOutput().GetNumberOfPoints(), divide.GetOutput().GetNumberOfCells()


def by_trimesh(ball, levels, repeats):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        vertices, faces = trimesh.remesh.subdivide_loop(ball.vertices, ball.faces, iterations=levels)
        times.append((time.perf_counter() - start) * 1e3)
    return times, len(vertices), len(faces)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--levels", type=int, default=3)
    parser.add_argument("--repeats", type=int, default=5)
    args = parser.parse_args()
    ball = trimesh.creation.icosphere(subdivisions=5)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ball.ply"
        ball.export(path)
        print(f"{len(ball.faces)} triangles, {args.levels} levels")
        print("| program | ms | vertices | triangles |\n|---|---|---|---|")
        for threads in (1, 2):
            command = [args.program, path, str(args.levels), str(threads), str(args.repeats)]
            lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
            names = [f"luch, {threads} threads", "port of OpenSubdiv, 1 thread"]
            for name, line in list(zip(names, lines))[: 2 if threads == 1 else 1]:
                *times, vertices, triangles = line.split("\t")
                print(f"| {name} | {statistics.median(map(float, times)):.1f} | {vertices} | {triangles} |")
    for name, program in (("VTK", by_vtk), ("trimesh", by_trimesh)):
        times, vertices, triangles = program(ball, args.levels, args.repeats)
        print(f"| {name} | {statistics.median(times):.1f} | {vertices} | {triangles} |")


main()
