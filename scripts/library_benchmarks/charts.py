"""Charts and packing against xatlas, on the same simplified meshes."""

import tempfile
import time
from pathlib import Path

import numpy as np
import xatlas

import benchmarking
from library_benchmarks import common

SIDE, PADDING = 2048, 2
HEADER = ["mesh", "triangles", "by", "charts", "stretch L2", "stretch 99 %", "flipped or flat",
          "seams / √area", "use", "texels per unit", "CPU s charts", "packing"]


def run(arguments):
    common.title(f"Charts and packing into one square of {SIDE}², {PADDING} texels apart; texels per "
                 "unit relative to ours")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for dense in arguments.surfaces:
            path = Path(folder) / "mesh.ply"
            common.ours("simplify", dense, path, "--triangles", arguments.triangles)
            vertices, triangles = common.read_mesh(path)
            label = [common.name(dense), len(triangles)]
            layouts = [("this", *ours(path, folder, vertices, triangles)),
                       ("xatlas", *library(vertices, triangles, False)),
                       ("xatlas, brute force", *library(vertices, triangles, True))]
            density = None
            for by, corners, charts, count, size, seconds in layouts:
                *figures, texels = measured(vertices, triangles, corners, charts, size)
                density = density or texels
                rows.append([*label, by, count, *figures, f"{texels / density:.3f}", *seconds])
    benchmarking.print_table(HEADER, rows)


def ours(path, folder, vertices, triangles):
    """Texels of each triangle's corners, its chart, the size of the texture and the times."""
    output = Path(folder) / "layout"
    result = common.ours("charts", path, output, "--side", SIDE, "--padding", PADDING)
    numbers = np.fromfile(output)
    charts, corners = np.split(numbers, [len(triangles)])
    seconds = [f"{result[step]['cpuSeconds']:.1f}" for step in ("clustering", "packing")]
    return corners.reshape(-1, 3, 2), charts.astype(int), result["charts"], (SIDE, SIDE), seconds


def library(vertices, triangles, brute_force):
    atlas = xatlas.Atlas()
    atlas.add_mesh(vertices, triangles)
    packing = xatlas.PackOptions()
    packing.resolution, packing.padding, packing.bruteForce = SIDE, PADDING, brute_force
    # xatlas uses all processors: the sum of their time.
    start = time.process_time()
    atlas.generate(xatlas.ChartOptions(), packing)
    seconds = time.process_time() - start
    _, indices, coordinates = atlas[0]
    size = np.array([atlas.width, atlas.height])
    corners = coordinates[indices] * size
    charts = np.asarray(atlas.get_mesh_vertex_assignment(0)[1])[indices[:, 0]].astype(int)
    # Triangles that xatlas leaves out get a number of their own, and count as flat.
    charts[charts >= atlas.chart_count] = atlas.chart_count
    return corners, charts, atlas.chart_count, size, [f"{seconds:.1f}", "included"]


def measured(vertices, triangles, corners, charts, size):
    """Stretch (Sander et al., SIGGRAPH 2001), faults, seams, use and texels per unit at `SIDE`."""
    areas = common.triangle_areas(vertices, triangles)
    (s1, t1), (s2, t2), (s3, t3) = (corners[:, k].T for k in range(3))
    signed = ((s2 - s1) * (t3 - t1) - (s3 - s1) * (t2 - t1)) / 2
    # Whole charts may be mirrored; single triangles may not.
    side = np.sign(np.bincount(charts, signed))[charts]
    q1, q2, q3 = (vertices[triangles[:, k]] for k in range(3))
    usable = side * signed > 1e-6 * np.median(abs(signed))
    faulty = ~usable & (areas > 1e-6 * np.median(areas))
    with np.errstate(divide="ignore", invalid="ignore"):
        by_s = (q1 * (t2 - t3)[:, None] + q2 * (t3 - t1)[:, None] + q3 * (t1 - t2)[:, None])
        by_t = (q1 * (s3 - s2)[:, None] + q2 * (s1 - s3)[:, None] + q3 * (s2 - s1)[:, None])
        by_s, by_t = by_s / (2 * signed)[:, None], by_t / (2 * signed)[:, None]
    squares = (np.sum(by_s**2, 1) + np.sum(by_t**2, 1)) / 2
    scale = np.sqrt(abs(signed[usable]).sum() / areas[usable].sum())
    stretch = scale * np.sqrt(np.average(squares[usable], weights=areas[usable]))
    each = scale * np.sqrt(squares[usable])
    order = np.argsort(each)
    reached = np.cumsum(areas[usable][order]) / areas[usable].sum()
    worst = each[order][np.searchsorted(reached, 0.99)]
    seams = seam_length(vertices, triangles, corners) / np.sqrt(areas.sum())
    use = abs(signed).sum() / (size[0] * size[1])
    # A texture is a square: the longer side is fitted to it.
    texels = scale * SIDE / max(size)
    return [f"{stretch:.3f}", f"{worst:.3f}", int(faulty.sum()), f"{seams:.1f}",
            f"{100 * use:.1f} %", texels]


def seam_length(vertices, triangles, corners):
    """The length of the edges whose two triangles lie apart in the texture."""
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    places = np.concatenate([corners[:, [k, (k + 1) % 3]] for k in range(3)])
    turned = edges[:, 0] > edges[:, 1]
    edges[turned], places[turned] = edges[turned][:, ::-1], places[turned][:, ::-1]
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, places = edges[order], places[order]
    pairs = np.flatnonzero((edges[1:] == edges[:-1]).all(1))
    apart = abs(places[pairs] - places[pairs + 1]).max((1, 2)) > 1e-2
    ends = vertices[edges[pairs[apart]]]
    return np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum()
