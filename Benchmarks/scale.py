"""The tables on many photos and many machines of BENCHMARKS.md, made from Benchmarks/scale.json."""

import json
from pathlib import Path

from tables import number, table

FILE = Path(__file__).resolve().parent / "scale.json"


class Scale:
    """What scripts/benchmark-scale measured: by part, the machine and the result."""

    def __init__(self):
        self.parts = json.loads(FILE.read_text()) if FILE.exists() else {}

    def result(self, part):
        return self.parts.get(part, {}).get("result")

    @property
    def commits(self):
        return ", ".join(sorted({f"`{each['machine']['commit']}`" for each in self.parts.values()}))


def growth(scale):
    rows = [town(each) for each in scale.result("towns") or []] + [
        synthetic(each) for each in scale.result("growth") or []]
    return table(["photos", "with a pose", "centers, RMSE", "F at 5, 10 cm", "wall s", "CPU s per photo", "peak GB",
                  "disk GB"], rows)


def town(each):
    poses, mesh = each["quality"].get("poses"), each["quality"].get("mesh")
    scores = {at["threshold"]: at["fScore"] for at in mesh["thresholds"]} if mesh else {}
    return [f"{each['photos']:,}", f"{each['registered']:,}" if poses else "refused",
            f"{100 * poses['centerRMSE']:.1f} cm" if poses else "–",
            f"{number(scores.get(0.05))}, {number(scores.get(0.1))}" if mesh else "–", *cost(each)]


def cost(each):
    return [f"{each['seconds']:.0f}", f"{each['cpuSeconds'] / each['photos']:.2f}", f"{each['peakBytes'] / 1e9:.2f}",
            f"{each['diskBytes'] / 1e9:.2f}"]


def synthetic(each):
    photos = each["photos"]
    steps = [each[step] for step in ("matching", "mapping") if each.get(step)]
    return [f"{photos:,} (features only)", f"{each['registered']:,}", f"{1000 * each['relativeCenterError']:.3f} ‰", "–",
            f"{sum(step['seconds'] for step in steps):.0f}",
            f"{sum(step['cpuSeconds'] for step in steps) / photos:.2f}", f"{each['peakMemoryBytes'] / 1e9:.2f}", "–"]


def machines(scale):
    names = {"saharov32": "saharov32", "town-100": "100 photos of a town, tiles", "batch": "twenty sets, preview",
             "town-1000": "1,000 photos of a town, tiles"}
    rows = [chunks(name, scale.result(part)) for part, name in names.items() if scale.result(part)]
    return table(["set", "one process, CPU s", "chunks, CPU s", "killed", "made again", "same bytes",
                  "speed-up with 2, 4, 8, 16 nodes"], rows)


def chunks(name, each):
    whole, parts, killed = each["whole"], each["chunks"], each.get("killed")
    cpu = f"{parts['cpuSeconds']:.0f}"
    if whole:
        cpu += f" ({100 * (parts['cpuSeconds'] / whole['cpuSeconds'] - 1):+.1f} %)"
    same = [each["sameBytes"]] + ([killed["sameBytes"]] if killed else [])
    count = sum(" " in victim for victim in killed["killed"]) if killed else 0
    return [name, f"{whole['cpuSeconds']:.0f}" if whole else "–", cpu,
            f"{count} chunks, {len(killed['killed']) - count} nodes" if killed else "–",
            f"{len(killed['repeated'])} chunks" if killed else "–",
            "–" if whole is None else "yes" if all(same) else "no",
            ", ".join(f"{each['speedUp'][nodes]:.1f}" for nodes in ["2", "4", "8", "16"])]
