"""A batch of the meshes of a folder in random orders, as scripts/fuzz-runs --batch describes."""

from __future__ import annotations

import pathlib
import random
import shutil

import oracles
from program import RESULT_CODES, Ended, Program, random_signals

_SUFFIXES = (".off", ".obj", ".ply", ".stl")
_MESHES = 40
_ORDERS = 10
_MOST_BYTES = 500_000  # Larger meshes are left out, because the batch is computed eleven times and more.


def _meshes_of(folder: pathlib.Path) -> list[pathlib.Path]:
    files = sorted(path for path in folder.rglob("*") if path.suffix in _SUFFIXES and path.is_file())
    small = [path.resolve() for path in files if path.stat().st_size <= _MOST_BYTES]
    return small[:: max(1, len(small) // _MESHES)][:_MESHES]


def _results(folder: pathlib.Path) -> dict[str, bytes]:
    files = folder.rglob("*.asdf.npz")
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def _run_order(
    program: Program, rng: random.Random, folder: pathlib.Path, number: int, seconds: float
) -> tuple[list[Ended], str]:
    """A run; every second one is stopped by signals until it has been resumed twice."""
    lines = (folder / "batch.txt").read_text().splitlines()
    rng.shuffle(lines)
    (folder / f"order{number}.txt").write_text("\n".join(lines) + "\n")
    jobs = ["--jobs", "1"] if number % 4 < 2 else []
    arguments = ["--files-from", f"order{number}.txt", "-o", f"out{number}/", "--format", "npz", *jobs]
    what = f"order {number}, {' '.join(jobs) or 'default jobs'}"
    if number % 2 == 0:
        return [program.run(arguments, folder)], what
    resumed = [*arguments, "--skip-existing", "--log", f"log{number}.jsonl"]
    ends = [program.run(resumed, folder, random_signals(rng, seconds / 2)) for _ in range(2)]
    return [*ends, program.run(resumed, folder)], what + ", stopped and resumed"


def run_orders(
    program: Program, source: pathlib.Path, seed: int, folder: pathlib.Path
) -> list[str]:
    """What is found; prints a line per order. The folder is kept where something is."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    rng = random.Random(seed)
    meshes = _meshes_of(source)
    (folder / "batch.txt").write_text("\n".join(map(str, meshes)) + "\n")
    first = program.run(
        ["--files-from", "batch.txt", "-o", "first/", "--format", "npz", "--jobs", "1"], folder
    )
    expected = _results(folder / "first")
    found = oracles.ended_well(first)
    if not expected:
        found.append(f"no result of {len(meshes)} meshes in {source}")
    print(f"{len(meshes)} meshes, {len(expected)} results, {first.seconds:.1f} s", flush=True)
    for number in range(_ORDERS):
        ends, what = _run_order(program, rng, folder, number, first.seconds)
        wrong = [w for ended in ends for w in oracles.ended_well(ended)]
        if (ends[-1].code in RESULT_CODES) != (first.code in RESULT_CODES):
            wrong.append(f"exit code {ends[-1].code}, not {first.code}")
        wrong += oracles.same_results(expected, _results(folder / f"out{number}"))
        stops = sum(bool(ended.sent) for ended in ends)
        print(f"{what}{f', {stops} signals' if stops else ''}: {len(wrong)} findings", flush=True)
        found += [f"{what}: {w}" for w in wrong]
    if not found:
        shutil.rmtree(folder)
    return found
