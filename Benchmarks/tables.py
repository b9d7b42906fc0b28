"""The tables of BENCHMARKS.md, made from Benchmarks/results.json."""

import json
import statistics
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
SETS = {each["name"]: each for each in json.loads((FOLDER / "sets.json").read_text())}
TWINS = [name for name, each in SETS.items() if each.get("twin")]


class Results:
    """The measurements of one commit on one machine."""

    def __init__(self):
        content = json.loads((FOLDER / "results.json").read_text())
        self.machine = content["machine"]
        self.measurements = content["measurements"]

    def find(self, **key):
        return next((each for each in self.measurements if all(each.get(k) == v for k, v in key.items())), None)

    def all(self, **key):
        return [each for each in self.measurements if all(each.get(k) == v for k, v in key.items())]


def number(value, digits=3):
    return "–" if value is None else f"{value:.{digits}f}"


def cost(measurement, key, digits=1):
    """Median of the runs, with the range if there are several."""
    if not measurement or not measurement["runs"]:
        return "–"
    values = sorted(run[key] for run in measurement["runs"])
    text = f"{statistics.median(values):.{digits}f}"
    return text if len(values) == 1 else f"{text} ({values[0]:.{digits}f}–{values[-1]:.{digits}f})"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def percent(share):
    return "–" if share is None else f"{100 * share:.1f} %"


def triple(quality, name):
    """The scores at all thresholds, ascending."""
    keys = sorted((k for k in quality if k.startswith(name)), key=lambda k: float(k[len(name):]))
    return ", ".join(number(quality[k]) for k in keys) or "–"


def models(results):
    rows = []
    for each in results.all(part="models"):
        q, name = each["quality"], each["set"]
        split = results.find(part="splits", set=name) or each
        psnr = (split["quality"] or {}).get("psnr")
        rows.append([name, f"{q.get('posed', 0)} of {q.get('photos', 0)}", number(q.get("reprojection"), 2),
                     cost(each, "seconds"), cost(each, "cpuSeconds"),
                     cost(results.find(part="alignment", set=name, program="COLMAP"), "cpuSeconds"),
                     cost(each, "peakGB", 2), f"{q.get('finalTriangles', 0):,}", str(q.get("verdict", "–")),
                     "clean" if q.get("findings") == 0 else f"{q.get('findings', '–')} findings", number(psnr, 1)])
    return table(["set", "photos with a pose", "reprojection px", "wall s", "CPU s", "COLMAP's cameras, CPU s", "peak GB", "triangles",
                  "verdict", "USDZ", "PSNR held out"], rows)


def seconds(measurement):
    """CPU seconds, the median of the runs."""
    return statistics.median(run["cpuSeconds"] for run in measurement["runs"])


def level(name):
    """The detail level of a set's default command."""
    options = SETS.get(name, {}).get("options", ["-d", "reduced"])
    return options[options.index("-d") + 1]


def against_colmap(results):
    """The whole run beside COLMAP's cameras alone, in CPU seconds."""
    rows = []
    for each in results.all(part="alignment", program="COLMAP"):
        name = each["set"]
        whole = results.find(part="models", set=name)
        cameras = results.find(part="alignment", set=name, program="photogrammetry-cli")
        if whole and cameras:
            rows.append([name, level(name), cost(whole, "cpuSeconds"), cost(cameras, "cpuSeconds"), cost(each, "cpuSeconds")])
    return table(["set", "detail", "photos to model", "of it to cameras (`align`)", "COLMAP, photos to cameras"], rows)


def poses(results):
    """One row for each set; each cell has this project's figure, and COLMAP's behind it."""
    rows = []
    for name in dict.fromkeys(each["set"] for each in results.all(part="alignment")):
        both = [results.find(part="alignment", set=name, program=program) for program in ("photogrammetry-cli", "COLMAP")]
        both = [each for each in both if each]
        qualities = [each["quality"] or {} for each in both]

        def pair(key, digits=3, instead=None):
            return " / ".join(str(q.get(key, q.get(instead, "–"))) if digits == 0 else number(q.get(key), digits) for q in qualities)
        unit = "" if "--unit" in SETS.get(name, {}).get("evaluate", []) else " mm"
        centers = pair("centers", 2) + unit if any("centers" in q for q in qualities) else "–"
        rows.append([name, pair("registered", 0, "posed"), centers, pair("rotation"), pair("auc0.1"), pair("auc0.5"),
                     pair("reprojection", 2), " / ".join(cost(each, "cpuSeconds") for each in both)])
    return table(["set", "registered", "centers, RMSE", "rotation °", "AUC@0.1°", "AUC@0.5°", "reprojection px", "CPU s"], rows)


def surfaces(results):
    rows = []
    for each in results.all(part="models"):
        q = each["quality"]
        if any(k.startswith("mesh.F") for k in q):
            rows.append([each["set"], triple(q, "mesh.F"), triple(q, "mesh.R"), triple(q, "cloud.F"),
                         number(q.get("mesh.chamfer")), number(q.get("psnr"), 2), number(q.get("ssim")),
                         number(q.get("denseRatio"), 0)])
    return table(["set", "model, F", "model, recall", "points, F", "Chamfer mm", "PSNR dB", "SSIM", "dense / sparse"], rows)


def outlines(results):
    """A sentence."""
    return "; ".join(
        f"{each['set']}: IoU {number(q['iou'])}, {100 * q['outside']:.2f} % of the area outside, "
        f"{100 * q['missing']:.2f} % missing"
        for each in results.all(part="models") if "iou" in (q := each["quality"]))


def paper(results):
    """The projections of the paper, and what was measured on twins of its sets."""
    rows = [["the paper, projected", "0.5 to 1.5", "1 mm", "70 to 95 %", "–", "–", "5 to 10 ×", "600 to 1800", "–"]]
    for name in TWINS:
        each = results.find(part="models", set=name)
        if not each:
            continue
        q, at = each["quality"], SETS[name].get("completenessAt", 1)
        shares = [percent(completeness(results, name, what)) for what in ("cloud", "mesh", "anyAngle.cloud")]
        rows.append([name, number(q.get("reprojection"), 2), f"{at} mm", *shares, number(q.get("denseRatio"), 0) + " ×",
                     cost(each, "seconds", 0), cost(each, "cpuSeconds", 0)])
    return table(["set", "reprojection px", "within", "points", "model", "points, any angle", "dense / sparse", "wall s", "CPU s"], rows)


def completeness(results, name, what):
    """The share of a twin's surface within the distance that its pixels resolve; `what` is `cloud`, `mesh` or
    `anyAngle.cloud`."""
    return results.find(part="models", set=name)["quality"].get(f"{what}.R{SETS[name].get('completenessAt', 1)}")


def parameters(results):
    sets = sorted({each["set"] for each in results.all(part="parameters")})
    names = list(dict.fromkeys(each["variant"] for each in results.all(part="parameters")))
    rows = []
    for variant in names:
        row = [variant]
        for name in sets:
            each = results.find(part="parameters", set=name, variant=variant)
            q = (each or {}).get("quality") or {}
            score = q.get("mesh.F1", q.get("auc0.5"))
            row.append(f"{q.get('posed', '–')}; {number(q.get('rotation'))}; {number(score)}; {cost(each, 'cpuSeconds', 0)}")
        rows.append(row)
    return table(["changed"] + [f"{name}" for name in sets], rows)
