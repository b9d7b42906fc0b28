"""Lines of the components written here, comments and empty lines included."""

from pathlib import Path

import benchmarking
from library_benchmarks import common

SOURCES = Path(__file__).resolve().parents[2] / "Sources"
COMPONENTS = {
    "SIFT": ["CKernels/features/s*", "CKernels/features/describe.inl",
             "CKernels/features/gaussian_blur.inl"],
    "descriptor matching": ["CKernels/features/matching.cpp", "CKernels/features/nearest*",
                            "CKernels/features/guided.cpp"],
    "image retrieval": ["CKernels/features/retrieval.cpp"],
    "patch stereo": ["CKernels/patches/*"],
    "two-view solvers and RANSAC": ["CKernels/two_view/*"],
    "P3P and resection": ["CKernels/resection/*"],
    "rotation averaging, global positioning": ["CKernels/global/*"],
    "bundle adjustment, triangulation": ["CKernels/bundle/*"],
    "least squares matching": ["CKernels/refinement/*"],
    "photo refinement": ["CKernels/surface/photo_refinement*"],
    "simplifier and surface fit": ["CKernels/mesh/*"],
    "charts": ["CKernels/texture/c*", "CKernels/texture/overlaps.cpp"],
    "packing": ["CKernels/texture/pack.cpp", "CKernels/texture/atlas_occupancy*",
                "CKernels/texture/bitmap*", "CKernels/texture/atlas*"],
    "visibility, painting, baking": ["CKernels/texture/observe.cpp", "CKernels/texture/paint.cpp",
                                     "CKernels/texture/bake*", "CKernels/texture/occlusion.cpp",
                                     "CKernels/texture/fill.cpp", "CKernels/geometry/ray_scene*"],
    "MRF labeling": ["CKernels/texture/labels.cpp"],
    "codecs around the libraries": ["CKernels/image/codec.cpp", "CKernels/image/jpeg*.cpp",
                                    "CKernels/image/tiff.cpp", "CKernels/image/webp.cpp",
                                    "CKernels/image/bmp.cpp", "CKernels/image/heif*",
                                    "CKernels/image/color.cpp", "CKernels/image/inflate.cpp"],
    "PNG writer": ["CKernels/image/png_encode.cpp"],
    "USD, USDC, USDZ, LZ4": ["Formats/USD/*", "Formats/USD/Crate/*", "Formats/USDZ/*",
                             "Formats/Bytes/CRC32.swift"],
    "GLB": ["Formats/GLTF/*"],
    "PLY": ["Formats/PLY/*"],
    "COLMAP text": ["Formats/COLMAP/*"],
    "image headers, EXIF, TIFF, color profiles": ["ImageFiles/Containers/*",
                                                  "ImageFiles/PhotoMetadata*",
                                                  "ImageFiles/ColorProfile.swift"],
    "preview rasterizer": ["Pipeline/Export/Preview/*"],
    "simd": ["AppleModules/simd/*"],
    "Combine": ["AppleModules/Combine/*"],
    "ImageIO, CoreGraphics, CoreImage, CoreVideo": [
        f"AppleModules/{module}/*" for module in (
            "BitmapGraphics", "CoreFoundationTypes", "CoreGraphics", "CoreImage", "CoreVideo",
            "ImageIO")],
    "evaluation of poses and surfaces": ["Evaluation/*", "Evaluation/*/*"],
    "os, OSLog": ["AppleModules/os/*", "AppleModules/OSLog*/*"],
}


def run(_):
    common.title("Components written here")
    rows = []
    for component, patterns in COMPONENTS.items():
        files = {path for pattern in patterns for path in SOURCES.glob(pattern) if path.is_file()}
        lines = sum(len(path.read_text().splitlines()) for path in files)
        rows.append([component, len(files), lines])
    benchmarking.print_table(["component", "files", "lines"], rows)
