"""PLY, GLB and USDZ against trimesh, plyfile and OpenUSD; COLMAP's text read by pycolmap."""

import tempfile
import zipfile
from pathlib import Path

import pycolmap
import trimesh
from plyfile import PlyData
from pxr import Sdf, Usd

import benchmarking
from library_benchmarks import common


def run(arguments):
    if arguments.surfaces:
        meshes(arguments)
    if arguments.models:
        models(arguments.models)
    if arguments.sparse:
        sparse(arguments.sparse)


def meshes(arguments):
    common.title("Containers, a mesh without images; CPU seconds, the least of three calls")
    rows = []
    for dense in arguments.surfaces:
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            path = folder / "source.ply"
            common.ours("simplify", dense, path, "--triangles", arguments.triangles)
            cost = common.ours("containers", path, folder)
            rows += rows_of(common.name(dense), folder, cost)
    benchmarking.print_table(["mesh", "format", "by", "bytes", "writing", "reading"], rows)


def rows_of(name, folder, cost):
    size = lambda file: (folder / file).stat().st_size
    seconds = lambda key: f"{cost[key]['cpuSeconds']:.3f}"
    load = lambda file: trimesh.load(folder / file, process=False, force="mesh")
    ply, reading = common.timed(lambda: load("mesh.ply"), 3)
    bytes_, writing = common.timed(lambda: ply.export(file_type="ply"), 3)
    _, plain = common.timed(lambda: PlyData.read(str(folder / "mesh.ply"))["face"], 3)
    rows = [[name, "PLY", "this", size("mesh.ply"), seconds("plyWriting"), seconds("plyReading")],
            [name, "PLY", "trimesh", len(bytes_), f"{writing:.3f}", f"{reading:.3f}"],
            [name, "PLY", "plyfile", "", "", f"{plain:.3f}"]]
    glb, reading = common.timed(lambda: load("mesh.glb"), 3)
    bytes_, writing = common.timed(lambda: glb.export(file_type="glb"), 3)
    rows += [[name, "GLB", "this", size("mesh.glb"), seconds("glbWriting"), ""],
             [name, "GLB", "trimesh", len(bytes_), f"{writing:.3f}", f"{reading:.3f}"]]
    stage, reading = common.timed(lambda: Usd.Stage.Open(str(folder / "mesh.usdz")), 3)
    # Export of a flattened layer: everything is read and written once.
    layer = stage.Flatten()
    _, writing = common.timed(lambda: layer.Export(str(folder / "other.usdc")), 3)
    rows += [[name, "USDC", "this, in its USDZ", size("mesh.usdz"), seconds("usdzWriting"), ""],
             [name, "USDC", "OpenUSD", size("other.usdc"), f"{writing:.3f}", f"{reading:.3f}"]]
    return rows


def models(paths):
    """The crate layer of whole models, and the same written by OpenUSD."""
    common.title("Crate layers of models")
    rows = []
    for path in paths:
        with zipfile.ZipFile(path) as archive, tempfile.TemporaryDirectory() as folder:
            name = next(name for name in archive.namelist() if name.endswith(".usdc"))
            archive.extract(name, folder)
            file, other = Path(folder) / name, Path(folder) / "other.usdc"
            Sdf.Layer.FindOrOpen(str(file)).Export(str(other))
            version = lambda file: ".".join(map(str, file.read_bytes()[8:11]))
            rows.append([f"{common.name(path)}/{path.name}", file.stat().st_size, version(file),
                         other.stat().st_size, version(other)])
    benchmarking.print_table(["model", "bytes, this", "version", "bytes, OpenUSD", "version"], rows)


def sparse(folder):
    """What pycolmap reads of our text: to be compared with the run's report."""
    common.title("COLMAP's text, read by pycolmap")
    model, seconds = common.timed(lambda: pycolmap.Reconstruction(str(folder)))
    rows = [["images", model.num_reg_images()], ["points", model.num_points3D()],
            ["observations", model.compute_num_observations()],
            ["mean reprojection error, px", f"{model.compute_mean_reprojection_error():.4f}"],
            ["reading, s", f"{seconds:.2f}"]]
    benchmarking.print_table(["", "pycolmap"], rows)
