"""This project's screened Poisson against MeshLab's, a version of Kazhdan's program."""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import benchmarking
from library_benchmarks import common

HEADER = ["by", "threads", "triangles", "mean distance", "CPU s", "wall s", "peak MB"]
LIBRARY = """
import json, sys, time
import pymeshlab
source, output, depth, threads = sys.argv[1:]
meshes = pymeshlab.MeshSet(verbose=False)
meshes.load_new_mesh(source)
start, processor = time.monotonic(), time.process_time()
meshes.generate_surface_reconstruction_screened_poisson(
    depth=int(depth), scale=1.1, threads=int(threads))
cost = {"seconds": time.monotonic() - start, "cpuSeconds": time.process_time() - processor}
meshes.save_current_mesh(output)
print(json.dumps(cost))
"""


def run(arguments):
    if arguments.cloud is None:
        return print("poisson: needs --cloud", file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        cloud, points = sample(arguments.cloud, arguments.points, Path(folder) / "cloud.ply")
        common.title(f"Screened Poisson of {len(points)} points of {common.name(arguments.cloud)} "
                     f"at depth {arguments.depth}; distance from the points to the surface in "
                     "millionths of the diagonal")
        output = Path(folder) / "surface.ply"
        rows = []
        own = [common.PROGRAM, "poisson", cloud, output, "--depth", arguments.depth]
        for threads in (1, 2):
            rows.append(["ours", threads,
                         *measured([*own, "--threads", threads], output, points)])
        library = [sys.executable, "-c", LIBRARY, cloud, output, arguments.depth, 1]
        rows.append(["MeshLab", 1, *measured(library, output, points)])
    benchmarking.print_table(HEADER, rows)


def sample(path, count, output):
    """A PLY file of positions and normals of random points of a cloud, and these points."""
    from plyfile import PlyData, PlyElement
    vertices = PlyData.read(str(path))["vertex"]
    chosen = np.random.default_rng(1).permutation(len(vertices))[:count]
    fields = [(name, "f4") for name in ("x", "y", "z", "nx", "ny", "nz")]
    rows = np.empty(len(chosen), dtype=fields)
    for field, _ in fields:
        rows[field] = np.asarray(vertices[field])[chosen]
    PlyData([PlyElement.describe(rows, "vertex")], byte_order="<").write(str(output))
    return output, np.stack([rows["x"], rows["y"], rows["z"]], 1).astype(float)


def measured(command, output, points):
    process = subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, text=True)
    peak = 0
    while process.poll() is None:
        peak = max(peak, peak_kilobytes(process.pid))
        time.sleep(0.02)
    cost = json.loads(process.stdout.read().splitlines()[-1])
    vertices, triangles = common.read_mesh(output)
    return [len(triangles), f"{distance(points, vertices, triangles):.1f}",
            f"{cost['cpuSeconds']:.1f}", f"{cost['seconds']:.1f}",
            f"{peak * 1024 / 1e6:.0f}"]


def peak_kilobytes(process):
    """Peak memory up to now; rusage would include what this script held when it forked."""
    try:
        status = Path(f"/proc/{process}/status").read_text()
    except OSError:
        return 0
    lines = [line for line in status.splitlines() if line.startswith("VmHWM")]
    return int(lines[0].split()[1]) if lines else 0


def distance(points, vertices, triangles):
    import pymeshlab
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(points))
    meshes.add_mesh(pymeshlab.Mesh(vertices, triangles))
    found = meshes.get_hausdorff_distance(
        sampledmesh=0, targetmesh=1, samplevert=True, sampleface=False, sampleedge=False,
        samplenum=len(points))
    return 1e6 * found["mean"] / np.linalg.norm(points.max(0) - points.min(0))
