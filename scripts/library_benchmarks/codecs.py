"""The PNG writer against libpng, decoding against Pillow and OpenCV."""

import ctypes
import ctypes.util
import hashlib
import io
import zlib

import cv2
import numpy as np
import xxhash
from PIL import Image

import benchmarking
from library_benchmarks import common


def run(arguments):
    files = [*arguments.photos[:1], *arguments.textures]
    if files:
        encoding(files)
    hashes()


def encoding(files):
    common.title("Encoding as PNG, decoding; CPU seconds, the least of three calls")
    cv2.setNumThreads(1)
    rows = []
    for path in files:
        result = common.ours("codecs", path)
        pixels = np.asarray(Image.open(path).convert("RGB"))
        name = f"{path.name}, {result['width']} × {result['height']}"
        rows.append([name, "this", result["pngBytes"],
                     f"{result['pngEncoding']['cpuSeconds']:.2f}",
                     f"{result['decoding']['cpuSeconds']:.3f}"])
        for by, encode, decode in LIBRARIES:
            size, seconds = common.timed(lambda: encode(pixels), 3)
            decoding = f"{common.timed(lambda: decode(path), 3)[1]:.3f}" if decode else ""
            rows.append([name, by, size, f"{seconds:.2f}", decoding])
    benchmarking.print_table(["image", "by", "bytes of PNG", "encoding", "decoding"], rows)


def hashes():
    """The throughput of hashes for the fingerprints of files."""
    common.title("Hashes of 256 MB")
    data = bytes(1 << 28)
    rows = []
    for name, make in (("XXH64", xxhash.xxh64), ("CRC-32 of zlib", zlib.crc32),
                       ("SHA-256 of OpenSSL", hashlib.sha256)):
        _, seconds = common.timed(lambda: make(data), 3)
        rows.append([name, f"{len(data) / seconds / 1e9:.1f}"])
    benchmarking.print_table(["hash", "GB per CPU second"], rows)


class PNGImage(ctypes.Structure):
    """png_image of libpng 1.6."""
    _fields_ = [("opaque", ctypes.c_void_p), ("version", ctypes.c_uint32),
                ("width", ctypes.c_uint32), ("height", ctypes.c_uint32),
                ("format", ctypes.c_uint32), ("flags", ctypes.c_uint32),
                ("colormap_entries", ctypes.c_uint32), ("warning_or_error", ctypes.c_uint32),
                ("message", ctypes.c_char * 64)]


def with_libpng(pixels, flags=0):
    """The system's libpng with its defaults; returns the number of bytes."""
    library = ctypes.CDLL(ctypes.util.find_library("png16"))
    image = PNGImage(version=1, width=pixels.shape[1], height=pixels.shape[0], format=2,
                     flags=flags)
    size = ctypes.c_size_t(pixels.nbytes + pixels.nbytes // 8 + 65536)
    memory = ctypes.create_string_buffer(size.value)
    written = library.png_image_write_to_memory(
        ctypes.byref(image), memory, ctypes.byref(size), 0,
        np.ascontiguousarray(pixels).ctypes.data_as(ctypes.c_void_p), 0, None)
    if not written:
        raise RuntimeError(image.message)
    return size.value


def with_fast_libpng(pixels):
    """PNG_IMAGE_FLAG_FAST: for speed, not size."""
    return with_libpng(pixels, flags=2)


def with_pillow(pixels):
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return len(file.getvalue())


LIBRARIES = [
    ("libpng, defaults", with_libpng, None),
    ("libpng, fast", with_fast_libpng, None),
    ("Pillow", with_pillow, lambda path: Image.open(path).convert("RGB").load()),
    ("OpenCV", lambda pixels: len(cv2.imencode(".png", pixels)[1]),
     lambda path: cv2.imread(str(path), cv2.IMREAD_COLOR)),
]
