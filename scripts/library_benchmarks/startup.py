"""Start-up time of the linked libraries, and their transitive dependencies."""

import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import benchmarking
from library_benchmarks import common

SMALL = ["embree3", "jpeg", "png", "deflate", "xxhash", "lcms2"]
IMAGES = ["tiff", "webp", "heif"]
OPENCV = ["opencv_core", "opencv_imgproc"]
LIBRARIES = {
    "nothing": [],
    "Embree, libjpeg, libpng, libdeflate, xxHash, lcms2": SMALL,
    "libtiff and libwebp": ["tiff", "webp"],
    "libheif": ["heif"],
    "OpenCV core and imgproc": OPENCV,
    "all": [*SMALL, *IMAGES, *OPENCV],
}
# Transitive dependencies under the GPL, or with parts under it.
GPL = ["libx265", "libjbig"]


def run(arguments):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for label, libraries in LIBRARIES.items():
            program = Path(folder) / "program"
            flags = ["-Wl,--no-as-needed", *(f"-l{library}" for library in libraries)]
            subprocess.run(["g++", "-x", "c++", "-", "-o", program, *flags], input="int main() {}",
                           text=True, check=True)
            rows.append(["an empty program with " + label, *measured([program])])
    if shutil.which(arguments.program):
        rows.append([arguments.program.name + " --help", *measured([arguments.program, "--help"])])
    else:
        print(f"startup: {arguments.program} is not built", file=sys.stderr)
    common.title("Starting a program: median of 21 runs")
    benchmarking.print_table(["program", "shared objects", "MB of them", "ms wall",
                            "under the GPL"], rows)


def measured(command):
    listed = subprocess.run(["ldd", command[0]], capture_output=True, text=True).stdout
    paths = {line.split("=>")[1].split()[0] for line in listed.splitlines() if "=> /" in line}
    size = sum(Path(path).resolve().stat().st_size for path in paths)
    times = []
    for _ in range(21):
        start = time.monotonic()
        subprocess.run([str(part) for part in command], stdout=subprocess.DEVNULL, check=True)
        times.append(time.monotonic() - start)
    return [len(paths), f"{size / 1e6:.0f}", f"{1000 * statistics.median(times):.0f}",
            ", ".join(name for name in GPL if any(name in path for path in paths))]
