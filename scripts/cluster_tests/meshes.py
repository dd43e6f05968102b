"""The meshes of the test: a tree of folders, a list of its files, and the results of a single run."""

from __future__ import annotations

import dataclasses
import json
import pathlib
import random
import subprocess
from typing import Any

from daemons import Failed

SHAPES = ("animal", "hand", "figure", "sphere", "icosphere", "slab", "cylinder", "torus", "cube")
FACE_COUNTS = (100, 5000)  # approximate numbers
# Many rays per face, so that a mesh takes long enough to be interrupted.
OPTIONS = ("--format", "npy", "--seeds", "all", "--rays", "100")
# Files that cannot be read. Each engine must record their failures and compute all other meshes.
BROKEN = {
    "empty.ply": b"",
    "cut.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n",
    "no such vertex.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
}
SOME_FAILED = 7


@dataclasses.dataclass(frozen=True)
class Tree:
    folder: pathlib.Path
    list_file: pathlib.Path
    good_count: int


def generate(generator: str, folder: pathlib.Path, count: int) -> Tree:
    """Makes the tree of folders and meshes, which is the same for each call. Keeps existing files."""
    numbers = random.Random(15)
    paths = []
    for index in range(count):
        shape = SHAPES[index % len(SHAPES)]
        faces = int(round(FACE_COUNTS[0] * (FACE_COUNTS[1] / FACE_COUNTS[0]) ** numbers.random()))
        path = folder / f"set {index % 3}" / shape / f"{faces}-{index}.ply"
        path.parent.mkdir(parents=True, exist_ok=True)
        paths.append(path)
        if not path.exists():
            partial = path.with_suffix(".partial.ply")
            command = [generator, shape, "--faces", str(faces), "-o", str(partial)]
            subprocess.run(command, check=True, capture_output=True)
            partial.rename(path)
    for position, (name, content) in enumerate(BROKEN.items()):
        path = folder / name
        path.write_bytes(content)
        paths.insert((2 * position + 1) * count // (2 * len(BROKEN)), path)
    list_file = folder.parent / "meshes.txt"
    list_file.write_text("".join(f"{path}\n" for path in paths))
    return Tree(folder, list_file, count)


def outputs(results: pathlib.Path) -> dict[str, bytes]:
    """Returns the bytes of each result. Keys are paths relative to the folder."""
    files = results.rglob("*.npy")
    return {str(file.relative_to(results)): file.read_bytes() for file in files}


def output_count(results: pathlib.Path) -> int:
    return sum(1 for _ in results.rglob("*.npy"))


def records(results: pathlib.Path) -> list[dict[str, Any]]:
    """Returns the records of all logs. Ignores incomplete lines of killed processes."""
    found = []
    for log in sorted((results / "log").glob("*.jsonl")):
        for line in log.read_text().splitlines():
            try:
                found.append(json.loads(line))
            except json.JSONDecodeError:
                continue
    return found


def single_run(program: str, tree: Tree, results: pathlib.Path) -> int:
    """Computes all meshes in one call, and returns the number of skipped ones. Fails if a result is missing."""
    (results / "log").mkdir(parents=True, exist_ok=True)
    log = results / "log/single.jsonl"
    command = [program, "--files-from", str(tree.list_file), "-o", str(results), "--quiet"]
    command += ["--skip-existing", "--log", str(log), *OPTIONS]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if done.returncode != SOME_FAILED:
        raise Failed(f"the single run ended with {done.returncode}: {done.stderr.strip()}")
    if output_count(results) != tree.good_count:
        raise Failed(f"the single run wrote {output_count(results)} of {tree.good_count} results")
    records = map(json.loads, log.read_text().splitlines())
    return sum(record["status"] == "skipped" for record in records)


def summary(program: str, results: pathlib.Path) -> dict[str, int]:
    """Returns the numbers of meshes by status that `asdf-vk summarize` prints."""
    logs = [str(log) for log in (results / "log").glob("*.jsonl")]
    done = subprocess.run([program, "summarize", "--json", *logs], check=False,
                          capture_output=True, text=True)
    if done.returncode:
        raise Failed(f"asdf-vk summarize ended with {done.returncode}: {done.stderr.strip()}")
    found = json.loads(done.stdout)
    names = ("doneCount", "skippedCount", "failedCount", "droppedCount", "invalidLineCount")
    return {name: found[name] for name in names}


# Keys of a record that do not depend on the time and place of the computation.
_FIXED = ("inputHash", "optionsHash", "faceCount", "version", "commit", "device", "backend",
          "estimatedError", "segmentCount", "code", "message")


def differences(results: pathlib.Path, expected: pathlib.Path) -> list[str]:
    """Returns the differences between the results and between the records of two runs."""
    found = []
    ours, theirs = outputs(results), outputs(expected)
    for path in sorted(ours.keys() | theirs.keys()):
        if ours.get(path) != theirs.get(path):
            missing = path not in ours
            which = "missing" if missing else "other bytes" if path in theirs else "extra"
            found.append(f"{path}: {which}")
    recorded: dict[str, list[dict[str, Any]]] = {}
    for record in records(results):
        recorded.setdefault(record["input"], []).append(record)
    for record in records(expected):
        status = record["status"]
        # A process can be killed after it has written the record beside the result, but before it writes to the log.
        # The next run then logs a record with the status "skipped"; all other keys are equal.
        same = [one for one in recorded.get(record["input"], ())
                if one["status"] in (status, "skipped")]
        if not same:
            found.append(f"{record['input']}: no record of status {status}")
        for key in _FIXED:
            if any(one.get(key) != record.get(key) for one in same):
                found.append(f"{record['input']}: {key} of the record differs")
    return found
