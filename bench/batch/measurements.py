"""The measurements of bench/batch. Each function prints its figures and checks."""
import collections
import os
import pathlib
import random
import shutil
import signal
import statistics
import subprocess
import time

from cost import measure as cost  # noqa: F401, one of the measurements
from generated_meshes import write_meshes
from runs import check, load, memory_of_tree, records, records_or_cut, results, run, same_results


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
    print(f"time with --threads 1 / time with the default: {ratio:.2f} (medians of {options.runs} runs)")


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
    print(f"CPU time of CGAL / asdf-vk, median of {options.runs} runs: {of_cgal / statistics.median(seconds):.1f}")


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
    check(failed == set(failing), f"{len(failed)} meshes failed, {len(failing)} should fail; "
          f"failed unexpectedly: {sorted(failed - set(failing))[:3]}, not failed: {sorted(set(failing) - failed)[:3]}")
    check(all(r["code"] and r["message"] for r in found.values() if r["status"] == "failed"), "each failure has a code and a message")
    check(len(results(out)) == options.count - len(failing), f"{len(results(out))} results")
    print("failures by code:", dict(collections.Counter(f'{r["code"]} {r["error"]}' for r in found.values() if r["code"])))
    print("different messages:", len({r["message"] for r in found.values() if r["code"]}))
    quarters = [[m for t, m in samples if q <= 4 * t / seconds < q + 1] for q in range(4)]
    medians = [statistics.median(q) / 1e6 if q else float("nan") for q in quarters]
    print("median memory in each quarter of the time, MB:", [f"{m:.0f}" for m in medians],
          "highest:", round(max(m for _, m in samples) / 1e6))
    check(medians[3] <= 1.1 * medians[1], f"memory in the last / in the second quarter: {medians[3] / medians[1]:.3f}")
    progress = [l for l in errors.splitlines() if " left" in l]
    check(bool(progress), f"last progress line: {progress[-1] if progress else ''}")
    print(errors.splitlines()[-1], f"({load()})")


def kill(options, work):
    program = options.build / "src/asdf-vk"
    write_meshes(work / "in", options.count)
    arguments = ["-r", work / "in", "--format", "npy", "--quiet", "--skip-existing", *options.more]
    seconds, _ = run(program, *arguments, "-o", work / "whole", may_fail=True)
    whole = results(work / "whole")
    rng = random.Random(1)
    bad, late, done_before = 0, 0, []
    for moment in range(options.moments):
        out, log = work / "out", work / "log.jsonl"
        shutil.rmtree(out, ignore_errors=True)
        log.unlink(missing_ok=True)
        command = [program, *arguments, "-o", out, "--log", log, *(["--isolate"] if moment % 2 else [])]
        process = subprocess.Popen([str(a) for a in command], stderr=subprocess.DEVNULL)
        time.sleep(rng.random() * seconds)
        late += process.poll() is not None
        process.send_signal(signal.SIGKILL)
        process.wait()
        done_before.append(len(results(out)) if out.exists() else 0)
        run(*command, may_fail=True)
        complete = {r["input"] for r in records_or_cut(log) if r["status"] != "dropped"}
        if not same_results(work / "whole", out) or len(complete) != options.count:
            bad += 1
            print(f"moment {moment}: {len(results(out))} results of {len(whole)}, {len(complete)} records", flush=True)
    check(bad == 0, f"{options.moments} kills, with {min(done_before)} to {max(done_before)} of {len(whole)} results "
          f"at the kill; {late} kills after the end. {bad} outputs differ from a run without a kill ({load()})")


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
    check(same_results(work / "whole", work / "parts"),
          f"the results of {options.shards} shards have the same bytes as those of one run")
    for name, cost in (("bytes", lambda r: os.path.getsize(r["input"])), ("faces", lambda r: r["faceCount"]),
                       ("seconds", lambda r: r["totalSeconds"])):
        shares = [sum(map(cost, records(log))) for log in logs]
        mean = statistics.mean(shares)
        print(f"{name}: {min(shares) / mean:.3f} to {max(shares) / mean:.3f} of the mean ({load()})")
        if name != "seconds":
            check(max(shares) <= 1.1 * mean and min(shares) >= 0.9 * mean, f"shares of {name} within 10 %")
