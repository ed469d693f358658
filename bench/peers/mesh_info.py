"""What trimesh and PyVista take for the question that `inspect` answers, in processor time: python mesh_info.py FILE ..."""

import sys
import time


def trimesh_info(path):
    import trimesh

    start = time.process_time()
    mesh = trimesh.load(path, process=True)
    loaded = time.process_time()
    figures = (len(mesh.faces), mesh.is_watertight, mesh.is_winding_consistent, mesh.volume, mesh.area, mesh.euler_number)
    return loaded - start, time.process_time() - loaded, figures


def pyvista_info(path):
    import pyvista

    start = time.process_time()
    mesh = pyvista.read(path)
    loaded = time.process_time()
    mesh = mesh.clean()
    figures = (mesh.n_cells, mesh.is_manifold, mesh.n_open_edges, mesh.volume, mesh.area)
    return loaded - start, time.process_time() - loaded, figures


for path in sys.argv[1:]:
    for name, ask in (("trimesh", trimesh_info), ("PyVista", pyvista_info)):
        try:
            load, look, figures = ask(path)
            print(f"{path} {name}: load {load:.3f} s, look {look:.3f} s, {figures}")
        except Exception as error:
            print(f"{path} {name}: {error!r}")
