#!/usr/bin/env python3
"""Measures and checks batches of asdf-vk (docs/batches.md).

  bench/batch.py threads MESHES         time of --threads 1 over that of the default, files in and .npy out
  bench/batch.py cgal MESHES            CPU time of CGAL's sdf_values, 25 rays, over the time of one call on the same meshes
  bench/batch.py many [--count 10000]   generated meshes, every hundredth broken, one that hangs, one that takes 10 GB
  bench/batch.py kill [--moments 50]    kill -9 at random moments, then the same call: the bytes of a run without it
  bench/batch.py shards MESHES          --shard 1/7 to 7/7: their union, and their shares of the work

Programs are taken from --build (build/release). All files are written to a temporary folder. The exit code is 1 where
a check fails.
"""
import argparse
import collections
import filecmp
import json
import os
import pathlib
import random
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

# --- Generated meshes ---------------------------------------------------------------------------------------------


def bumpy_sphere(face_count, rng):
    """Closed mesh of about that many faces: vertices (n, 3), faces (m, 3)."""
    rings = max(4, round((face_count / 4) ** 0.5))
    columns = 2 * rings
    theta = np.linspace(0, np.pi, rings + 1)[1:-1]
    phi = np.arange(columns) * 2 * np.pi / columns
    t, p = np.meshgrid(theta, phi, indexing="ij")
    radius = 1 + 0.3 * np.sin(rng.integers(1, 5) * p) * np.sin(rng.integers(1, 4) * t) ** 2
    grid = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], -1) * radius[..., None]
    vertices = np.concatenate([grid.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]]) * rng.uniform(0.1, 10, 3)
    top, bottom = len(vertices) - 2, len(vertices) - 1
    faces = []
    for c in range(columns):
        n = (c + 1) % columns
        faces.append((top, c, n))
        last = (rings - 2) * columns
        faces.append((bottom, last + n, last + c))
        for r in range(rings - 2):
            a, b = r * columns + c, r * columns + n
            faces.append((a, a + columns, b + columns))
            faces.append((a, b + columns, b))
    return vertices, np.array(faces)


def ply(vertices, faces):
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.zeros(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    return header.encode() + vertices.astype("<f4").tobytes() + rows.tobytes()


def off(vertices, faces):
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [f"{x:.6g} {y:.6g} {z:.6g}" for x, y, z in vertices]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    return ("\n".join(lines) + "\n").encode()


def broken(kind, vertices, faces):
    """The kind-th way to break a mesh: bytes and extension. Every one is an input that cannot be read."""
    good_ply, good_off = ply(vertices, faces), off(vertices, faces)
    share = 0.02 + 0.96 * (kind // 10) / 10
    lines = good_off.split(b"\n")
    at = 2 + int(share * (len(lines) - 4))
    ways = [
        lambda: (good_ply[: int(share * len(good_ply))], "ply"),
        lambda: (b"\n".join(lines[:at]), "off"),
        lambda: (good_off.replace(b"3 ", b"3 9999999 ", 1) if kind < 10 else good_off + b"3 0 1 7777777\n", "off"),
        lambda: (b"\n".join(lines[:at] + [b"what is this"] + lines[at:]), "off"),
        lambda: (good_ply.replace(b"element vertex ", b"element vertex 9%d" % kind, 1), "ply"),
        lambda: (bytes((i * 37 + kind) % 251 for i in range(100 + kind)), "stl"),
        lambda: (good_ply + bytes(kind + 1), "ply"),
        lambda: (b"" if kind < 10 else b"\n" * kind, "obj"),
        lambda: (good_ply.replace(b"uchar int", b"uchar quaternion" if kind % 20 < 10 else b"float int", 1), "ply"),
        lambda: (f"OFF\n{kind} 0 0\n".encode() + b"0 0 0\n" * kind, "off"),
    ]
    return ways[kind % 10]()


def write_meshes(folder, count, hangs=False, grows=False):
    """`count` meshes in folders of 100; returns the paths that must fail."""
    rng = np.random.default_rng(1)
    failing = []
    for i in range(count):
        vertices, faces = bumpy_sphere(100 * 50 ** rng.random(), rng)
        path = folder / f"{i // 100:03d}" / f"m{i:05d}"
        path.parent.mkdir(parents=True, exist_ok=True)
        if i % 100 == 99:
            data, extension = broken(i // 100, vertices, faces)
            failing.append(f"{path}.{extension}")
        else:
            data, extension = (ply(vertices, faces), "ply") if i % 2 else (off(vertices, faces), "off")
            if (hangs and i == count // 3) or (grows and i == count // 2):
                path = path.with_name(path.name + ("-hang" if i == count // 3 else "-grow"))
                failing.append(f"{path}.{extension}")
        pathlib.Path(f"{path}.{extension}").write_bytes(data)
    return failing


# --- Runs ---------------------------------------------------------------------------------------------------------


def load():
    return f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"


def run(program, *arguments, may_fail=False):
    start = time.monotonic()
    process = subprocess.run([program, *map(str, arguments)], stderr=subprocess.PIPE, text=True)
    if process.returncode not in ((0, 7) if may_fail else (0,)):
        sys.exit(f"{program} {arguments}: exit code {process.returncode}\n{process.stderr[-2000:]}")
    return time.monotonic() - start, process.stderr


def results(folder):
    return {p.relative_to(folder) for p in folder.rglob("*") if p.is_file() and not p.name.endswith(".json")}


def same_results(a, b):
    return results(a) == results(b) and all(filecmp.cmp(a / p, b / p, shallow=False) for p in results(a))


def records(log):
    return [json.loads(line) for line in log.read_text().splitlines()]


def check(holds, text):
    print(("ok      " if holds else "FAILED  ") + text, flush=True)
    if not holds:
        check.failed = True


check.failed = False


def threads(options, work):
    program = options.build / "src/asdf-vk"
    seconds = collections.defaultdict(list)
    for i in range(options.runs):
        for name, more in (("default", []), ("--threads 1", ["--threads", 1])):
            out = work / f"{name}{i}"
            taken, _ = run(program, "-r", options.meshes, "-o", out, "--format", "npy", "--quiet", *more, *options.more)
            seconds[name].append(taken)
            check(same_results(work / "default0", out), f"{name}: {taken:.2f} s, {len(results(out))} results, {load()}")
    ratio = statistics.median(seconds["--threads 1"]) / statistics.median(seconds["default"])
    print(f"--threads 1 over the default: {ratio:.2f} (medians of {options.runs} runs)")


def cgal(options, work):
    meshes = sorted(p for p in pathlib.Path(options.meshes).rglob("*") if p.suffix in (".off", ".ply", ".obj", ".stl"))
    program = options.build / "src/asdf-vk"
    seconds = []
    for i in range(options.runs):
        taken, _ = run(program, "-r", options.meshes, "-o", work / str(i), "--format", "npy", "--quiet", *options.more)
        seconds.append(taken)
        print(f"asdf-vk: {taken:.2f} s, {len(results(work / str(i)))} results, {load()}", flush=True)
    table = subprocess.run([options.build / "bench/asdfvk-bench-cgal-values", "--backends", "cpu", *meshes],
                           stdout=subprocess.PIPE, text=True, check=True).stdout
    rows = [line.split("|") for line in table.splitlines() if "%" in line]
    of_cgal = sum(float(row[-2].split(",")[0]) for row in rows)
    print(f"CGAL: {of_cgal:.1f} s of CPU time for {len(rows)} meshes, {load()}")
    check(len(rows) == len(meshes), f"{len(meshes)} meshes")
    print(f"CGAL over asdf-vk, median of {options.runs} runs: {of_cgal / statistics.median(seconds):.1f}")


def memory_of_tree(process):
    """Resident bytes of a process and of its children."""
    total = 0
    try:
        children = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()
        pages = int(pathlib.Path(f"/proc/{process}/statm").read_text().split()[1])
        total = pages * os.sysconf("SC_PAGE_SIZE") + sum(memory_of_tree(c) for c in children)
    except (FileNotFoundError, ProcessLookupError):
        pass
    return total


def many(options, work):
    program = options.build / "tests/asdfvk-test-faulty-program"
    failing = write_meshes(work / "in", options.count, hangs=True, grows=True)
    log, out = work / "log.jsonl", work / "out"
    command = [program, "-r", work / "in", "-o", out, "--format", "npy", "--log", log, "--isolate",
               "--timeout", options.timeout, "--memory-limit", "2G", *options.more]
    start = time.monotonic()
    with open(work / "errors", "w") as stream:
        process = subprocess.Popen([str(a) for a in command], stderr=stream)
    samples = []
    while process.poll() is None:
        samples.append((time.monotonic() - start, memory_of_tree(process.pid)))
        time.sleep(0.2)
    errors = (work / "errors").read_text()
    seconds = time.monotonic() - start
    found = {r["input"]: r for r in records(log)}
    failed = {r["input"] for r in found.values() if r["status"] == "failed"}
    check(process.returncode == 7, f"exit code {process.returncode}")
    check(len(found) == options.count, f"{len(found)} records of {options.count} meshes")
    check(failed == set(failing), f"{len(failed)} failed, {len(failing)} are broken; "
          f"not expected: {sorted(failed - set(failing))[:3]}, missing: {sorted(set(failing) - failed)[:3]}")
    check(all(r["code"] and r["message"] for r in found.values() if r["status"] == "failed"), "each failure has a code and a message")
    check(len(results(out)) == options.count - len(failing), f"{len(results(out))} results")
    print("failures by code:", dict(collections.Counter(f'{r["code"]} {r["error"]}' for r in found.values() if r["code"])))
    print("different messages:", len({r["message"] for r in found.values() if r["code"]}))
    quarters = [[m for t, m in samples if q <= 4 * t / seconds < q + 1] for q in range(4)]
    print("median memory by quarter of the time, MB:", [round(statistics.median(q) / 1e6) for q in quarters if q],
          "highest:", round(max(m for _, m in samples) / 1e6))
    progress = [l for l in errors.splitlines() if " left" in l]
    check(bool(progress), f"rate printed: {progress[-1] if progress else ''}")
    print(errors.splitlines()[-1], f"({load()})")


def kill(options, work):
    program = options.build / "src/asdf-vk"
    write_meshes(work / "in", options.count)
    arguments = ["-r", work / "in", "--format", "npy", "--quiet", "--skip-existing", *options.more]
    seconds, _ = run(program, *arguments, "-o", work / "whole", may_fail=True)
    whole = results(work / "whole")
    rng = random.Random(1)
    bad, done_before = 0, []
    for moment in range(options.moments):
        out, log = work / "out", work / "log.jsonl"
        shutil.rmtree(out, ignore_errors=True)
        log.unlink(missing_ok=True)
        command = [program, *arguments, "-o", out, "--log", log, *(["--isolate"] if moment % 2 else [])]
        process = subprocess.Popen([str(a) for a in command], stderr=subprocess.DEVNULL)
        time.sleep(rng.random() * 1.1 * seconds)
        process.send_signal(signal.SIGKILL)
        process.wait()
        done_before.append(len(results(out)) if out.exists() else 0)
        run(*command, may_fail=True)
        complete = {r["input"] for r in records_or_cut(log) if r["status"] != "dropped"}
        if not same_results(work / "whole", out) or len(complete) != options.count:
            bad += 1
            print(f"moment {moment}: {len(results(out))} results of {len(whole)}, {len(complete)} records", flush=True)
    check(bad == 0, f"{options.moments} kills, with {min(done_before)} to {max(done_before)} of {len(whole)} results "
          f"before them: {bad} differ from the run without a kill ({load()})")


def records_or_cut(log):
    found = []
    for line in log.read_text().splitlines():
        try:
            found.append(json.loads(line))
        except json.JSONDecodeError:
            pass
    return found


def shards(options, work):
    program = options.build / "src/asdf-vk"
    common = ["-r", options.meshes, "--format", "npy", "--quiet", *options.more]
    run(program, *common, "-o", work / "whole")
    logs = []
    for i in range(1, options.shards + 1):
        logs.append(work / f"log{i}")
        run(program, *common, "-o", work / "parts", "--log", logs[-1], "--shard", f"{i}/{options.shards}")
    inputs = [r["input"] for log in logs for r in records(log)]
    check(len(inputs) == len(set(inputs)), f"{len(inputs)} records, each mesh once")
    check(same_results(work / "whole", work / "parts"), f"the union of {options.shards} shards has the bytes of the whole")
    for name, cost in (("bytes", lambda r: os.path.getsize(r["input"])), ("faces", lambda r: r["faceCount"]),
                       ("seconds", lambda r: r["totalSeconds"])):
        shares = [sum(map(cost, records(log))) for log in logs]
        mean = statistics.mean(shares)
        print(f"{name}: {min(shares) / mean:.3f} to {max(shares) / mean:.3f} of the mean ({load()})")
        if name == "bytes":
            check(max(shares) <= 1.1 * mean and min(shares) >= 0.9 * mean, "shares of bytes within 10 %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["threads", "cgal", "many", "kill", "shards"])
    parser.add_argument("meshes", nargs="?", help="folder of meshes, for threads, cgal and shards")
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path(__file__).parent.parent / "build/release")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--count", type=int, help="generated meshes; default 10000 for many, 60 for kill")
    parser.add_argument("--moments", type=int, default=50)
    parser.add_argument("--shards", type=int, default=7)
    parser.add_argument("--timeout", type=float, default=30)
    parser.add_argument("--more", default="", help="further options of asdf-vk, for example '--backend cpu'")
    options = parser.parse_args()
    options.more = options.more.split()
    options.count = options.count or (10000 if options.what == "many" else 60)
    if options.what in ("threads", "cgal", "shards") and not options.meshes:
        parser.error(f"{options.what} needs a folder of meshes")
    with tempfile.TemporaryDirectory(prefix="asdf-vk-batch-") as work:
        globals()[options.what](options, pathlib.Path(work))
    return 1 if check.failed else 0


if __name__ == "__main__":
    sys.exit(main())
