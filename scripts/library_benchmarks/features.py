"""SIFT and matching against OpenCV's, on two photos of one scene."""

import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np
import poselib

import benchmarking
from library_benchmarks import common

HEADER = ["by", "features", "detection CPU s", "µs per feature", "matches", "matching CPU s",
          "agree with one fundamental matrix"]
MAXIMUM = 8000


def run(arguments):
    if len(arguments.photos) < 2:
        return print("features: needs --photos", file=sys.stderr)
    first, second = arguments.photos[:2]
    cv2.setNumThreads(1)
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "matches"
        result = common.ours("features", first, second, output, "--maximum", MAXIMUM)
        places = np.fromfile(output).reshape(-1, 4)
    count, seconds = sum(result["counts"]), result["detection"]["cpuSeconds"]
    rows = [["this", count, f"{seconds:.2f}", f"{1e6 * seconds / count:.1f}", result["matches"],
             f"{result['matching']['cpuSeconds']:.3f}", agreeing(places)]]
    rows += [with_opencv(first, second, way) for way in ("brute force", "FLANN")]
    common.title(f"Features of {first.name} and {second.name}, one thread, at most {MAXIMUM} per "
                 "photo")
    benchmarking.print_table(HEADER, rows)


def with_opencv(first, second, way):
    images = [cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) for path in (first, second)]
    detector = cv2.SIFT_create(nfeatures=MAXIMUM, contrastThreshold=0.02, edgeThreshold=10)
    found, seconds = common.timed(
        lambda: [detector.detectAndCompute(image, None) for image in images], 3)
    count = sum(len(keypoints) for keypoints, _ in found)
    matcher = (cv2.BFMatcher(cv2.NORM_L2) if way == "brute force"
               else cv2.FlannBasedMatcher({"algorithm": 1, "trees": 5}, {"checks": 50}))

    def matches():
        """Mutual matches that pass the ratio test both ways, as ours."""
        passed = []
        for a, b in ((0, 1), (1, 0)):
            pairs = matcher.knnMatch(found[a][1], found[b][1], k=2)
            passed.append({m.queryIdx: m.trainIdx for m, n in pairs
                           if m.distance < 0.7 * n.distance})
        return [(i, j) for i, j in passed[0].items() if passed[1].get(j) == i]

    result, matching = common.timed(matches, 2)
    places = np.array([[*found[0][0][i].pt, *found[1][0][j].pt] for i, j in result])
    return [f"OpenCV, {way}", count, f"{seconds:.2f}", f"{1e6 * seconds / count:.1f}", len(result),
            f"{matching:.3f}", agreeing(places)]


def agreeing(places):
    """How many matches are within a pixel of the epipolar lines of one fundamental matrix."""
    _, details = poselib.estimate_fundamental(
        places[:, :2], places[:, 2:], {"max_epipolar_error": 1.0}, {})
    return int(np.sum(details["inliers"]))
