"""Marching cubes beside scikit-image's and VTK's, in one run.

    cargo build --release -p luch-mesh --example march
    python bench/peers/surfaces.py target/release/examples/march [--size 256] [--repeats 5]

Needs numpy, scikit-image and vtk (pyvista brings it). Samples lie in memory before the clock starts; the clock stops when positions,
normals and triangles are there, which all programs give. Rounds are interleaved; printed are medians in milliseconds.
"""

import argparse
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from skimage.measure import marching_cubes

import vtk
from vtk.util.numpy_support import numpy_to_vtk


def fields(size):
    axis = np.linspace(-1.2, 1.2, size, dtype=np.float32)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    yield "ball", np.sqrt(x * x + y * y + z * z) - np.float32(1)
    k = np.float32(2 * np.pi * 2.5)
    yield "gyroid", np.sin(k * x) * np.cos(k * y) + np.sin(k * y) * np.cos(k * z) + np.sin(k * z) * np.cos(k * x)


def scikit(values):
    start = time.perf_counter()
    positions, faces, _, _ = marching_cubes(values, 0.0)
    return (time.perf_counter() - start) * 1e3, len(positions), len(faces)


def vtk_image(values):
    image = vtk.vtkImageData()
    image.SetDimensions(*values.shape[::-1])
    scalars = numpy_to_vtk(values.ravel(), deep=True)
    image.GetPointData().SetScalars(scalars)
    return image


def flying_edges(image, threads):
    vtk.vtkSMPTools.Initialize(threads)
    edges = vtk.vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, 0.0)
    edges.ComputeNormalsOn()
    edges.ComputeScalarsOff()
    start = time.perf_counter()
    edges.Update()
    elapsed = (time.perf_counter() - start) * 1e3
    mesh = edges.GetOutput()
    return elapsed, mesh.GetNumberOfPoints(), mesh.GetNumberOfCells()


def luch(program, path, size, threads):
    # The first repeat warms the memory up, as the rounds before do for the others.
    line = subprocess.run(
        [program, path, str(size), "0", str(threads), "2"], check=True, capture_output=True, text=True
    ).stdout.split("\t")
    return float(line[1]), int(line[2]), int(line[3])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    vtk.vtkSMPTools.SetBackend("STDThread")
    print(f"VTK {vtk.vtkVersion.GetVTKVersion()}, SMP {vtk.vtkSMPTools.GetBackend()}")
    print("| field | program | ms | vertices | triangles |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, values in fields(options.size):
            path = Path(folder) / f"{name}.raw"
            values.astype("<f4").tofile(path)
            image = vtk_image(values)
            programs = {
                "luch, 1 thread": lambda: luch(options.program, path, options.size, 1),
                "luch, 2 threads": lambda: luch(options.program, path, options.size, 2),
                "VTK flying edges, 1 thread": lambda: flying_edges(image, 1),
                "VTK flying edges, 2 threads": lambda: flying_edges(image, 2),
                "scikit-image": lambda: scikit(values),
            }
            times = {program: [] for program in programs}
            sizes = {}
            for _ in range(options.repeats + 1):
                for program, run in programs.items():
                    elapsed, *sizes[program] = run()
                    times[program].append(elapsed)
            for program, found in times.items():
                vertices, triangles = sizes[program]
                median = statistics.median(found[1:])
                print(f"| {name} | {program} | {median:.1f} | {vertices} | {triangles} |")


if __name__ == "__main__":
    main()
