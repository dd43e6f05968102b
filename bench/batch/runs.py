"""Runs of asdf-vk, their outputs, and checks."""
import filecmp
import json
import os
import pathlib
import subprocess
import sys
import time


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


def memory_of_tree(process):
    """Returns the resident memory of a process and its children, in bytes."""
    total = 0
    try:
        children = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()
        pages = int(pathlib.Path(f"/proc/{process}/statm").read_text().split()[1])
        total = pages * os.sysconf("SC_PAGE_SIZE") + sum(memory_of_tree(c) for c in children)
    except (FileNotFoundError, ProcessLookupError):
        pass
    return total


def records_or_cut(log):
    found = []
    for line in log.read_text().splitlines():
        try:
            found.append(json.loads(line))
        except json.JSONDecodeError:
            pass
    return found
