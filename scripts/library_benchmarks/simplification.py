"""The simplifier against meshoptimizer, fast-simplification and MeshLab's.

scripts/benchmark-simplification compares it with Open3D's.
"""

import tempfile
from pathlib import Path

import fast_simplification
import meshoptimizer
import numpy as np
import pymeshlab

import benchmarking
from library_benchmarks import common

HEADER = ["surface", "triangles", "by", "left", "mean", "mean back", "RMS",
          "greatest", "CPU s"]


def run(arguments):
    common.title("Simplification; distances in millionths of the diagonal, by samples of the "
                 "dense surface and of the simplified one (back)")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for path in arguments.surfaces:
            vertices, triangles = common.read_mesh(path)
            for by, simplify in WAYS.items():
                *mesh, seconds = simplify(path, vertices, triangles, arguments.triangles, folder)
                rows.append([common.name(path), len(triangles), by, len(mesh[1]),
                             *distances((vertices, triangles), mesh), f"{seconds:.2f}"])
    benchmarking.print_table(HEADER, rows)


def ours(path, vertices, triangles, count, folder):
    output = Path(folder) / "mesh.ply"
    cost = common.ours("simplify", path, output, "--triangles", count)
    return *common.read_mesh(output), cost["cpuSeconds"]


def with_meshoptimizer(path, vertices, triangles, count, folder):
    positions = np.ascontiguousarray(vertices, dtype=np.float32)
    indices = np.ascontiguousarray(triangles.ravel(), dtype=np.uint32)
    result = np.zeros_like(indices)
    length, seconds = common.timed(lambda: meshoptimizer.simplify(
        result, indices, positions, target_index_count=3 * count, target_error=1e30))
    return *common.compacted(vertices, result[:length].reshape(-1, 3)), seconds


def with_fast_simplification(path, vertices, triangles, count, folder):
    points, faces = vertices.astype(np.float32), triangles.astype(np.int32)
    mesh, seconds = common.timed(
        lambda: fast_simplification.simplify(points, faces, target_count=count))
    return mesh[0].astype(float), mesh[1].astype(np.int32), seconds


def with_meshlab(path, vertices, triangles, count, folder):
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(vertices, triangles))
    _, seconds = common.timed(lambda: meshes.meshing_decimation_quadric_edge_collapse(
        targetfacenum=count, preserveboundary=True, preservenormal=True, optimalplacement=True))
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix(), mesh.face_matrix(), seconds


WAYS = {"this": ours, "meshoptimizer": with_meshoptimizer,
        "fast-simplification": with_fast_simplification, "MeshLab": with_meshlab}


def distances(dense, simplified, samples=300_000):
    meshes = pymeshlab.MeshSet(verbose=False)
    for vertices, triangles in (dense, simplified):
        meshes.add_mesh(pymeshlab.Mesh(vertices, triangles))
    diagonal = np.linalg.norm(dense[0].max(0) - dense[0].min(0))
    there, back = (meshes.get_hausdorff_distance(
        sampledmesh=a, targetmesh=b, samplevert=False, sampleface=True, samplenum=samples,
        maxdist=pymeshlab.PercentageValue(10)) for a, b in ((0, 1), (1, 0)))
    values = [there["mean"], back["mean"], there["RMS"], max(there["max"], back["max"])]
    return [f"{1e6 * value / diagonal:.1f}" for value in values]
