"""Minimal solvers, relative and absolute poses, against PoseLib."""

import tempfile
import time
from pathlib import Path

import numpy as np
import poselib

import benchmarking
from library_benchmarks import common

FOCAL, WIDTH, HEIGHT = 1000.0, 1280.0, 960.0
NOISES = [0.2, 0.5, 1.0]
CAMERA = {"model": "SIMPLE_PINHOLE", "width": int(WIDTH), "height": int(HEIGHT),
          "params": [FOCAL, 0, 0]}


def run(arguments):
    with tempfile.TemporaryDirectory() as folder:
        solvers(Path(folder))
        relative(Path(folder), arguments.scenes)
        absolute(Path(folder), arguments.scenes)


# Scenes

def rotation(axis_angle):
    angle = np.linalg.norm(axis_angle)
    x, y, z = axis_angle / max(angle, 1e-12)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def from_quaternion(x, y, z, w):
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def random_direction(random):
    direction = random.normal(size=3)
    return direction / np.linalg.norm(direction)


def in_image(pixels):
    return (abs(pixels[:, 0]) < WIDTH / 2) & (abs(pixels[:, 1]) < HEIGHT / 2)


def random_pixels(random, count):
    return (random.random((count, 2)) - 0.5) * [WIDTH, HEIGHT]


def two_views(random, count):
    """Points in depths 4 to 12 seen by two cameras at distance 1, and the pose of the second."""
    while True:
        turn = rotation(random_direction(random) * np.radians(20) * random.random())
        direction = random_direction(random) * [1, 1, 0.5]
        direction /= np.linalg.norm(direction)
        candidates = 20 * count
        depths = 4 + 8 * random.random((candidates, 1))
        first = random_pixels(random, candidates)
        points = np.hstack([first / FOCAL * depths, depths])
        moved = points @ turn.T + direction
        second = moved[:, :2] / moved[:, 2:] * FOCAL
        seen = np.flatnonzero((moved[:, 2] > 0.5) & in_image(second))[:count]
        if len(seen) == count:
            return points[seen], first[seen], second[seen], turn, direction


def spoiled(random, pixels, noise, outliers):
    """The pixels with noise, the first of them replaced by random ones, and which are correct."""
    result = pixels + noise * random.normal(size=pixels.shape)
    wrong = int(round(outliers * len(pixels)))
    result[:wrong] = random_pixels(random, wrong)
    return result, np.arange(len(pixels)) >= wrong


def essential(turn, direction):
    x, y, z = direction
    matrix = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]) @ turn
    return matrix / np.linalg.norm(matrix)


# Minimal solvers

def solvers(folder):
    random = np.random.default_rng(1)
    count = 5000
    scenes = [two_views(random, 5) for _ in range(count)]
    rays = lambda pixels: np.hstack([pixels / FOCAL, np.ones((len(pixels), 1))])
    unit = lambda rows: rows / np.linalg.norm(rows, axis=1, keepdims=True)
    rows = np.array([np.hstack([s[1], s[2]]) / FOCAL for s in scenes])
    samples = [(unit(rays(s[1])), unit(rays(s[2]))) for s in scenes]
    truths = [essential(s[3], s[4]) for s in scenes]

    def essential_error(matrix, truth):
        matrix = np.asarray(matrix) / np.linalg.norm(matrix)
        return min(np.linalg.norm(matrix - truth), np.linalg.norm(matrix + truth))

    common.title(f"Minimal solvers, {count} problems without noise")
    header = ["solver", "by", "solutions", "median error", "99 % error", "missed (error > 1e-6)",
              "µs per call", "of which the binding"]
    table = []
    output, result = solved(folder, "five-point", rows, 9)
    errors = [least_error(essential_error, [m.reshape(3, 3) for m in matrices], truth)
              for matrices, truth in zip(output, truths)]
    table.append(["five-point", "this", *solver_figures(output, errors), *result])
    found = [poselib.essential_matrix_5pt(*sample) for sample in samples]
    errors = [least_error(essential_error, matrices, truth)
              for matrices, truth in zip(found, truths)]
    call = least_microseconds(
        poselib.relpose_upright_planar_2pt, [(a[:2], b[:2]) for a, b in samples])
    table.append(["five-point", "PoseLib", *solver_figures(found, errors),
                  f"{least_microseconds(poselib.essential_matrix_5pt, samples):.1f}",
                  f"< {call:.1f}"])

    # The second camera's rays and the points in the first one's frame.
    rows = np.array([np.hstack([rays(s[2][:3]), s[0][:3]]) for s in scenes])
    samples = [(unit(rays(s[2][:3])), s[0][:3]) for s in scenes]

    def pose_error(pose, truth):
        turn, translation = pose
        return max(np.linalg.norm(turn - truth[0]), np.linalg.norm(translation - truth[1]))

    output, result = solved(folder, "p3p", rows, 7)
    truths = [(s[3], s[4]) for s in scenes]
    errors = [least_error(pose_error, [(from_quaternion(*p[:4]), p[4:]) for p in poses], truth)
              for poses, truth in zip(output, truths)]
    table.append(["P3P", "this", *solver_figures(output, errors), *result])
    found = [poselib.p3p(*sample) for sample in samples]
    errors = [least_error(pose_error, [(pose.R, pose.t) for pose in poses], truth)
              for poses, truth in zip(found, truths)]
    table.append(["P3P", "PoseLib", *solver_figures(found, errors),
                  f"{least_microseconds(poselib.p3p, samples):.1f}", f"< {call:.1f}"])
    benchmarking.print_table(header, table)


def solved(folder, solver, rows, width):
    """Our solutions, and the microseconds of a call and of one that fails at once."""
    microseconds = []
    for problems in (rows, np.ones_like(rows) if solver == "p3p" else rows):
        write_problems(folder / "problems", problems)
        microseconds.append(common.ours(
            "solvers", solver, folder / "problems", folder / "solutions")["microseconds"])
        if len(microseconds) == 1:
            numbers = np.fromfile(folder / "solutions")
    solutions, at = [], 0
    for _ in range(len(rows)):
        count = int(numbers[at])
        solutions.append(numbers[at + 1:at + 1 + count * width].reshape(count, width))
        at += 1 + count * width
    call = f"{microseconds[1]:.1f}" if solver == "p3p" else "as P3P's"
    return solutions, [f"{microseconds[0]:.1f}", call]


def write_problems(path, problems):
    count, rows = problems.shape[:2]
    np.concatenate([[count, rows], problems.ravel()]).astype(float).tofile(path)


def least_error(error, solutions, truth):
    return min((error(solution, truth) for solution in solutions), default=np.inf)


def solver_figures(solutions, errors):
    errors = np.array(errors)
    return [f"{np.mean([len(s) for s in solutions]):.2f}", f"{np.median(errors):.1e}",
            f"{np.quantile(errors, 0.99):.1e}", f"{100 * np.mean(~(errors < 1e-6)):.2f} %"]


def least_microseconds(solve, samples, repetitions=5):
    best = np.inf
    for _ in range(repetitions):
        start = time.process_time()
        for sample in samples:
            solve(*sample)
        best = min(best, (time.process_time() - start) / len(samples))
    return 1e6 * best


# Robust estimation

HEADER = ["noise px", "outliers", "by", "rotation °, median", "95 %", "{}, median", "95 %", "wrong",
          "inliers found", "ms per call, median", "mean"]


def relative(folder, count):
    matches, limit = 500, 2.0
    common.title(f"Relative pose, {matches} matches, limit {limit} px, {count} scenes per row; "
                 "wrong: more than 2° in rotation or 10° in direction")
    rows = []
    for noise in NOISES:
        for outliers in (0.2, 0.5, 0.7):
            random = np.random.default_rng(7)
            scenes = []
            for _ in range(count):
                _, first, second, turn, direction = two_views(random, matches)
                first = first + noise * random.normal(size=first.shape)
                second, good = spoiled(random, second, noise, outliers)
                order = random.permutation(matches)
                scenes.append((first[order], second[order], good[order], turn, direction))
            problems = np.array([np.hstack([s[0], s[1]]) / FOCAL for s in scenes])
            found = our_poses(folder, "relative", problems, limit / FOCAL)
            rows.append([noise, percent(outliers), "this", *pose_figures(found, scenes, angle)])
            rows.append([noise, percent(outliers), "this, fitted to its inliers",
                         *pose_figures(refitted(found, scenes), scenes, angle)])
            for label, options in poselib_options("max_epipolar_error", limit):
                found = [library_pose(poselib.estimate_relative_pose, s[0], s[1], options, CAMERA)
                         for s in scenes]
                rows.append([noise, percent(outliers), label, *pose_figures(found, scenes, angle)])
    benchmarking.print_table([cell.format("direction °") for cell in HEADER], rows)


def absolute(folder, count):
    matches, limit = 200, 6.0
    common.title(f"Absolute pose, {matches} points, limit {limit} px, {count} scenes per row; center "
                 "in ‰ of the mean depth; wrong: more than 2° or 50 ‰")
    rows = []
    for noise in (0.5, 1.0, 2.0):
        for outliers in (0.3, 0.6, 0.8):
            random = np.random.default_rng(7)
            scenes = []
            for _ in range(count):
                points, _, pixels, turn, direction = two_views(random, matches)
                pixels, good = spoiled(random, pixels, noise, outliers)
                order = random.permutation(matches)
                scenes.append((pixels[order], points[order], good[order], turn, direction))
            problems = np.array([np.hstack([s[0], s[1]]) for s in scenes])
            found = our_poses(folder, "absolute", problems, limit)
            rows.append([noise, percent(outliers), "this",
                         *pose_figures(found, scenes, center_distance)])
            for label, options in poselib_options("max_reproj_error", limit):
                found = [library_pose(poselib.estimate_absolute_pose, s[0], s[1], options)
                         for s in scenes]
                rows.append([noise, percent(outliers), label,
                             *pose_figures(found, scenes, center_distance)])
    benchmarking.print_table([cell.format("center ‰") for cell in HEADER], rows)


def poselib_options(name, limit):
    ours = {name: limit, "min_iterations": 30, "max_iterations": 1000, "success_prob": 0.9999}
    return [("PoseLib, same bounds", ours), ("PoseLib, its defaults", {name: limit})]


def our_poses(folder, kind, problems, limit):
    """Seconds, rotation, translation (None without a pose) and inliers of each problem."""
    write_problems(folder / "problems", problems)
    common.ours("poses", kind, folder / "problems", folder / "poses", "--limit", limit)
    numbers, found, at = np.fromfile(folder / "poses"), [], 0
    for _ in range(len(problems)):
        seconds, count = numbers[at], int(numbers[at + 1])
        pose, at = numbers[at + 2:at + 9], at + 9
        inliers = numbers[at:at + max(count, 0)].astype(int)
        at += max(count, 0)
        turn = from_quaternion(*pose[:4]) if count >= 0 else None
        found.append((seconds, turn, pose[4:], inliers))
    return found


def refitted(found, scenes):
    """Least squares by PoseLib of our inliers, which lie in front of both cameras."""
    result = []
    for (seconds, turn, translation, inliers), scene in zip(found, scenes):
        if turn is not None:
            pose = poselib.CameraPose()
            pose.R, pose.t = turn, translation
            start = time.process_time()
            pose, _ = poselib.refine_relative_pose(
                scene[0][inliers], scene[1][inliers], pose, CAMERA, CAMERA,
                {"loss_type": "TRIVIAL"})
            seconds += time.process_time() - start
            turn, translation = pose.R, pose.t
        result.append((seconds, turn, translation, inliers))
    return result


def library_pose(estimate, first, second, options, *cameras):
    start = time.process_time()
    pose, details = estimate(first, second, CAMERA, *cameras, options)
    seconds = time.process_time() - start
    return seconds, pose.R, pose.t, np.flatnonzero(details["inliers"])


def angle(turn, translation, truth):
    cosine = translation @ truth[4] / max(np.linalg.norm(translation), 1e-12)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1))), 10


def center_distance(turn, translation, truth):
    distance = np.linalg.norm(turn.T @ translation - truth[3].T @ truth[4])
    return 1000 * distance / truth[1][:, 2].mean(), 50


def pose_figures(found, scenes, translation_error):
    turns, moves, wrong, recalls = [], [], 0, []
    for (_, turn, translation, inliers), scene in zip(found, scenes):
        good = scene[2]
        recalls.append(good[inliers].sum() / good.sum() if turn is not None else 0)
        if turn is None:
            turns.append(180.0)
            moves.append(np.inf)
            wrong += 1
            continue
        between = np.linalg.norm(turn - scene[3]) / np.sqrt(8)
        turns.append(np.degrees(2 * np.arcsin(min(1, between))))
        move, limit = translation_error(turn, translation, scene)
        moves.append(move)
        wrong += turns[-1] > 2 or move > limit
    seconds = [f[0] for f in found]
    return [f"{np.median(turns):.3f}", f"{np.quantile(turns, 0.95):.3f}", f"{np.median(moves):.2f}",
            f"{np.quantile(moves, 0.95):.2f}", wrong, percent(np.mean(recalls), 1),
            f"{1000 * np.median(seconds):.2f}", f"{1000 * np.mean(seconds):.2f}"]


def percent(value, digits=0):
    return f"{100 * value:.{digits}f} %"
