"""Calling library-benchmark, timing libraries, meshes as arrays."""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

PROGRAM = Path(__file__).resolve().parents[2] / ".build" / "release" / "library-benchmark"


def ours(*arguments):
    """Runs library-benchmark; returns the JSON that it prints, None where it prints none."""
    command = [str(PROGRAM), *map(str, arguments)]
    process = subprocess.run(command, capture_output=True, text=True)
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{process.stderr}")
    lines = process.stdout.splitlines()
    return json.loads(lines[-1]) if lines else None


def timed(body, repetitions=1):
    """The result of a call and its CPU seconds, the minimum of several calls."""
    best = float("inf")
    for _ in range(repetitions):
        start = time.process_time()
        result = body()
        best = min(best, time.process_time() - start)
    return result, best


def title(text):
    print(f"\n{text}\n", flush=True)


def read_mesh(path):
    """Vertices and triangles of a PLY file."""
    import pymeshlab
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix(), mesh.face_matrix()


def write_mesh(path, vertices, triangles):
    import pymeshlab
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(vertices, triangles))
    meshes.save_current_mesh(str(path))


def compacted(vertices, triangles):
    """The mesh without vertices that no triangle uses."""
    used, numbers = np.unique(triangles, return_inverse=True)
    return vertices[used], numbers.reshape(-1, 3).astype(np.int32)


def triangle_areas(vertices, triangles):
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def name(path):
    """The name of the photo set that a checkpoint's file belongs to."""
    path = Path(path).resolve()
    ignored = {"mesh", "work", "dense", "images", "ck"}
    parts = [part for part in path.parts[:-1] if part not in ignored]
    return parts[-1] if parts else path.stem
