"""Batches on clusters; scripts/test-cluster describes the options."""

from __future__ import annotations

import argparse
import collections
import dataclasses
import pathlib
import shutil
import sys
import time
from collections.abc import Callable

from daemons import Failed, wait_until
from dask_cluster import DaskCluster
from engine import Engine, Surroundings
from meshes import (
    BROKEN,
    differences,
    generate,
    output_count,
    records,
    single_run,
    summary,
)
from parallel_hosts import ParallelHosts
from slurm import Slurm

ENGINES: dict[str, Callable[[Surroundings], Engine]] = {
    "slurm": Slurm, "parallel": ParallelHosts, "dask": DaskCluster}
RUN_LIMIT_SECONDS = 1800
MAX_SHOWN = 10


@dataclasses.dataclass
class Row:
    engine: str
    version: str
    events: str
    interrupted: str
    resumed: str

    def line(self) -> str:
        return f"| {' | '.join(dataclasses.astuple(self))} |"


def _say(text: str) -> None:
    print(f"test-cluster: {text}", file=sys.stderr, flush=True)


def _interrupt(engine: Engine, results: pathlib.Path, mesh_count: int) -> str:
    """Runs the recipe, and interrupts it by the events of the engine. Returns exit code, number of results and time."""
    start = time.monotonic()
    process = engine.submit(results)
    for event in engine.events(results):
        wait_until(lambda: output_count(results) >= event.share * mesh_count
                   or process.poll() is not None, event.what, RUN_LIMIT_SECONDS)
        if process.poll() is not None:
            raise Failed(f"the run ended with exit code {process.returncode} before this event: {event.what}")
        _say(f"{engine.name}: {output_count(results)} results; now {event.what}")
        event.happen()
    code = process.wait(RUN_LIMIT_SECONDS)
    count = output_count(results)
    ended = f"exit code {code}, {count} results, {time.monotonic() - start:.0f} s"
    _say(f"{engine.name}: {ended}")
    if code == 0 or count >= mesh_count:
        raise Failed(f"nothing was interrupted: {ended}")
    return ended


def _resume(engine: Engine, results: pathlib.Path, mesh_count: int) -> str:
    """Repeats the call, which must skip finished meshes. Returns exit code, counts and time as text."""
    before, output_count_before = _statuses(results), output_count(results)
    start = time.monotonic()
    code = engine.submit(results).wait(RUN_LIMIT_SECONDS)
    counts = _statuses(results) - before
    shown = ", ".join(f"{count} {name}" for name, count in sorted(counts.items()))
    ended = f"exit code {code}, {shown}, {time.monotonic() - start:.0f} s"
    _say(f"{engine.name}: {ended}")
    if not engine.only_meshes_failed(code):
        raise Failed(f"the resumed run failed: {ended}")
    # A result is computed again if its process was killed before the record was written.
    least = output_count_before - len(engine.events(results))
    if counts["skipped"] < least:
        raise Failed(f"fewer meshes were skipped than the {least} that were done before: {ended}")
    return ended


def _statuses(results: pathlib.Path) -> collections.Counter[str]:
    return collections.Counter(record["status"] for record in records(results))


def _check(engine: Engine, surroundings: Surroundings, expected: pathlib.Path) -> Row:
    results = surroundings.folder / f"results of {engine.folder.name}"
    shutil.rmtree(results, ignore_errors=True)
    engine.start()
    _say(f"{engine.name}: {engine.version()}")
    interrupted = _interrupt(engine, results, surroundings.tree.good_count)
    resumed = _resume(engine, results, surroundings.tree.good_count)
    different = differences(results, expected)
    if different:
        shown = "\n  ".join(different[:MAX_SHOWN])
        raise Failed(f"{len(different)} differences from the single run:\n  {shown}")
    counts = summary(str(surroundings.program), results)
    computed = counts["doneCount"] + counts["skippedCount"]
    if computed != surroundings.tree.good_count or counts["failedCount"] != len(BROKEN):
        raise Failed(f"asdf-vk summarize counts {counts}")
    skipped_count = single_run(str(surroundings.program), surroundings.tree, results)
    if skipped_count != surroundings.tree.good_count:
        raise Failed(f"a further single run skips only {skipped_count} of the results")
    events = ", ".join(event.what for event in engine.events(results))
    return Row(engine.name, engine.version(), events, interrupted, resumed)


def main() -> int:
    parser = argparse.ArgumentParser(prog="scripts/test-cluster", description=__doc__)
    parser.add_argument("--only", metavar="NAME,...", default=",".join(ENGINES),
                        help=f"of {', '.join(ENGINES)}")
    parser.add_argument("--meshes", metavar="N", type=int, default=200)
    parser.add_argument("--program", metavar="FILE", type=pathlib.Path,
                        default=pathlib.Path("build/release/src/asdf-vk"))
    arguments = parser.parse_args()
    names = arguments.only.split(",")
    if not set(names) <= set(ENGINES):
        parser.error(f"--only: one or more of {', '.join(ENGINES)}, separated by commas")
    folder = pathlib.Path("build/cluster").resolve()
    program = arguments.program.resolve()
    start = time.monotonic()
    tree = generate(f"{program}-generate", folder / f"{arguments.meshes} meshes", arguments.meshes)
    surroundings = Surroundings(program, folder, tree)
    expected = folder / "results of a single run"
    shutil.rmtree(expected, ignore_errors=True)
    failed = []
    rows = []
    try:
        single_start = time.monotonic()
        single_run(str(program), tree, expected)
        _say(f"single run: {tree.good_count} results, {time.monotonic() - single_start:.0f} s")
        for name in names:
            engine = ENGINES[name](surroundings)
            try:
                rows.append(_check(engine, surroundings, expected))
            except Failed as reason:
                _say(f"{engine.name}: FAILED: {reason}")
                _say(f"  logs: {engine.folder}")
                failed.append(name)
            finally:
                engine.stop()
    except Failed as reason:
        _say(f"FAILED: {reason}")
        return 1
    print("| software | version | simulated failures | interrupted run | repetition of the call |")
    print("|---|---|---|---|---|")
    for row in rows:
        print(row.line())
    print(f"{len(rows)} of {len(names)} passed, {time.monotonic() - start:.0f} s")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
