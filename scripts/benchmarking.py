"""Shared by the benchmark scripts: running a program, the machine, tables, plots."""

import datetime
import json
import math
import os
import platform
import subprocess
import sys
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent


def run(command):
    """Runs a program; returns its exit code, seconds and resource usage."""
    start = time.monotonic()
    process = subprocess.Popen([str(part) for part in command], stdout=sys.stderr)
    while True:
        try:
            _, wait_status, usage = os.wait4(process.pid, 0)
            break
        except KeyboardInterrupt:
            continue  # The terminal has interrupted the program, too: it will exit.
    seconds = time.monotonic() - start
    code = os.waitstatus_to_exitcode(wait_status)
    process.returncode = code
    return (code if code >= 0 else 128 - code), seconds, usage


def read_report(path):
    """The report as a dictionary; empty if there is none."""
    try:
        report = json.loads(Path(path).read_text())
    except (OSError, ValueError):
        return {}
    return report if isinstance(report, dict) else {}


def peak_bytes(usage):
    """The peak memory measured by `run`; the kernel reports KiB on Linux, bytes on macOS."""
    return usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def machine():
    """What the figures depend on besides the photos."""
    def git(*words):
        return subprocess.run(["git", "-C", REPOSITORY, *words], capture_output=True, text=True, check=True).stdout.strip()
    cpu = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), "")
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    changes = git("status", "--porcelain", "--untracked-files=no", "--", "Sources", "Package.swift")
    return {"commit": git("rev-parse", "--short", "HEAD") + ("+changes" if changes else ""),
            "processor": cpu, "cores": os.cpu_count(), "memoryGB": round(memory / 1e9),
            "system": platform.freedesktop_os_release().get("PRETTY_NAME", platform.system()),
            "date": datetime.date.today().isoformat()}


def print_table(header, rows):
    """Prints a Markdown table with columns that are aligned in a terminal, too."""
    rows = [[str(cell) for cell in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(header, *rows)]
    for row in [header, ["-" * width for width in widths], *rows]:
        print("| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |")


def diagrams(named_series, dashed=()):
    """Plots with logarithmic axes, in a row, as SVG.

    `named_series` maps a title to named lines of values by number of photos. Lines in `dashed` are
    references, not measurements.
    """
    parts = []
    for index, (title, series) in enumerate(named_series.items()):
        parts += diagram(70 + 480 * index, title, series, dashed)
    width = 480 * len(named_series)
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="400" '
        'font-family="sans-serif" font-size="13">',
        f'<rect width="{width}" height="400" fill="white"/>', *parts, "</svg>", ""])


COLORS = ["#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#8c564b"]


def diagram(left, title, series, dashed):
    """One plot whose axes start at x = `left`."""
    top, width, height = 40, 360, 300
    points = [(n, v) for line in series.values() for n, v in line.items() if v > 0]
    if not points:
        return []
    low_x, high_x = min(n for n, _ in points), max(n for n, _ in points)
    low_y = 10 ** math.floor(math.log10(min(v for _, v in points)))
    high_y = max(10 * low_y, 10 ** math.ceil(math.log10(max(v for _, v in points))))

    def x(n):
        return left + width * math.log(n / low_x) / max(1e-9, math.log(high_x / low_x))

    def y(v):
        return top + height * (1 - math.log(v / low_y) / math.log(high_y / low_y))

    parts = [f'<text x="{left}" y="{top - 15}" font-weight="bold">{title}</text>']
    for n in sorted({n for n, _ in points}):
        parts.append(f'<line x1="{x(n):.1f}" y1="{top}" x2="{x(n):.1f}" y2="{top + height}" '
                     'stroke="#ddd"/>')
        parts.append(f'<text x="{x(n):.1f}" y="{top + height + 18}" text-anchor="middle">'
                     f'{n}</text>')
    value = low_y
    while value <= high_y * 1.01:
        parts.append(f'<line x1="{left}" y1="{y(value):.1f}" x2="{left + width}" '
                     f'y2="{y(value):.1f}" stroke="#ddd"/>')
        parts.append(f'<text x="{left - 6}" y="{y(value) + 4:.1f}" text-anchor="end">'
                     f'{value:g}</text>')
        value *= 10
    parts.append(f'<text x="{left + width / 2}" y="{top + height + 38}" text-anchor="middle">'
                 'photos</text>')
    for index, (name, line) in enumerate(series.items()):
        color = COLORS[index % len(COLORS)]
        path = " ".join(f"{x(n):.1f},{y(v):.1f}" for n, v in sorted(line.items()) if v > 0)
        dash = ' stroke-dasharray="5 4"' if name in dashed else ""
        parts.append(f'<polyline points="{path}" fill="none" stroke="{color}" '
                     f'stroke-width="2"{dash}/>')
        parts.append(f'<text x="{left + 10}" y="{top + 20 + 18 * index}" fill="{color}">'
                     f'{name}</text>')
    return parts
