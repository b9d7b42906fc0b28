"""The EXIF parser against Pillow's."""

import sys

from PIL import ExifTags, Image

import benchmarking
from library_benchmarks import common

FIELDS = ["make", "model", "orientation", "focalLength", "focalLengthIn35mmFilm", "originalWidth",
          "captureTime", "latitude", "longitude", "altitude"]


def run(arguments):
    if not arguments.photos:
        return print("metadata: needs --photos", file=sys.stderr)
    result = common.ours("metadata", *arguments.photos)
    theirs, seconds = common.timed(lambda: [read(path) for path in arguments.photos])
    rows = []
    for field in FIELDS:
        pairs = [(ours.get(field), other.get(field))
                 for ours, other in zip(result["fields"], theirs)]
        rows.append([field, sum(a is not None for a, _ in pairs),
                     sum(b is not None for _, b in pairs),
                     sum(same(a, b) for a, b in pairs if a is not None or b is not None)])
    milliseconds = [1000 * s / len(theirs) for s in (result["cost"]["cpuSeconds"], seconds)]
    rows.append(["ms per photo", *(f"{m:.2f}" for m in milliseconds), ""])
    common.title(f"EXIF of {len(theirs)} photos")
    benchmarking.print_table(["field", "this", "Pillow", "equal"], rows)


def same(a, b):
    if isinstance(a, str) or isinstance(b, str):
        return a == b
    return a is not None and b is not None and abs(a - b) <= 1e-6 * max(1, abs(a))


def read(path):
    tags = Image.open(path).getexif()
    exif, gps = tags.get_ifd(ExifTags.IFD.Exif), tags.get_ifd(ExifTags.IFD.GPSInfo)
    text = lambda value: str(value).split("\0")[0].strip() or None if value else None
    number = lambda value: float(value) if value else None
    fields = {"make": text(tags.get(271)), "model": text(tags.get(272)),
              "orientation": tags.get(274, 1), "focalLength": number(exif.get(37386)),
              "focalLengthIn35mmFilm": number(exif.get(41989)), "originalWidth": exif.get(40962),
              "captureTime": text(exif.get(36867) or tags.get(306))}
    if 2 in gps and 4 in gps:
        angle = lambda values: float(values[0]) + float(values[1]) / 60 + float(values[2]) / 3600
        fields["latitude"] = angle(gps[2]) * (-1 if gps.get(1) == "S" else 1)
        fields["longitude"] = angle(gps[4]) * (-1 if gps.get(3) == "W" else 1)
        if 6 in gps:
            below = gps.get(5) in (1, b"\x01")
            fields["altitude"] = float(gps[6]) * (-1 if below else 1)
    return fields
