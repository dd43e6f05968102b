"""One case after another, and what they found."""

from __future__ import annotations

import collections
import contextlib
import pathlib
import random
import re
import shutil
import time
import traceback
from collections.abc import Callable

from case import Case
from file_cases import killed, limited_files, order_of_batch, resumed_batch
from program import Program
from value_cases import any_options, assembly, backends, neutral_options, units

KINDS: dict[str, Callable[[Case], None]] = {
    kind.__name__.replace("_", "-"): kind
    for kind in (
        *(any_options, backends, assembly, units, neutral_options),
        *(order_of_batch, killed, limited_files, resumed_batch),
    )
}

# Folders that are kept per finding; further cases with the same one are counted only.
KEPT_CASES = 3
_DETAILS = r"(values differ|not equal|bytes differ|other results|segments differ|is left).*"


class Summary:
    def __init__(self) -> None:
        self.cases: collections.Counter[str] = collections.Counter()
        self.seconds: dict[str, float] = collections.defaultdict(float)
        self.failed: collections.Counter[str] = collections.Counter()
        # The calls that repeat it, by what is found.
        self.findings: dict[str, list[str]] = collections.defaultdict(list)

    def print(self) -> None:
        rows = [("kind", "cases", "seconds", "with findings")]
        for kind, count in self.cases.items():
            rows.append((kind, str(count), f"{self.seconds[kind]:.0f}", str(self.failed[kind])))
        widths = [max(map(len, column)) for column in zip(*rows)]
        print()
        for row in rows:
            print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
        for finding, repetitions in sorted(self.findings.items()):
            print(f"\n{len(repetitions)} times: {finding}\n  first: {repetitions[0]}")


def class_of(kind: str, topic: str, finding: str) -> str:
    """A finding without the numbers of its case."""
    text = re.sub(r"  \[.*\]$", "", finding, flags=re.DOTALL)
    text = re.sub(_DETAILS, r"\1", text, flags=re.DOTALL)
    text = re.sub(r"/\S+|\b[mM]\d\.\S+", "PATH", text)
    return f"{kind} {topic}".strip() + ": " + re.sub(r"[-+]?\b\d+(\.\d+)?(e[-+]?\d+)?\b", "N", text)


def run_case(program: Program, kind: str, seed: int, folder: pathlib.Path) -> Case:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    case = Case(program, random.Random(f"{kind} {seed}"), folder)
    try:
        KINDS[kind](case)
    except Exception:  # A fault of the fuzzer, or a file in a form that no oracle foresaw.
        case.findings.append("no oracle foresaw this: " + traceback.format_exc(limit=-2))
    return case


def run_until(
    end: float, program: Program, kinds: list[str], seed: int, folder: pathlib.Path
) -> Summary:
    """Cases from this seed on until the end by time.monotonic(), at least one. Prints findings."""
    summary = Summary()
    with contextlib.suppress(KeyboardInterrupt):  # The table comes then, too.
        while not summary.cases or time.monotonic() < end:
            kind = kinds[seed % len(kinds)]
            began = time.monotonic()
            case_folder = folder / f"{kind}-{seed}"
            case = run_case(program, kind, seed, case_folder)
            summary.cases[kind] += 1
            summary.seconds[kind] += time.monotonic() - began
            summary.failed[kind] += bool(case.findings)
            keeps = False
            for finding in case.findings:
                repetitions = summary.findings[class_of(kind, case.topic, finding)]
                repetition = f"scripts/fuzz-runs --case {kind}:{seed}"
                if len(repetitions) < KEPT_CASES:
                    keeps = True
                    print(f"{repetition}\n  {finding}\n  files: {case_folder}", flush=True)
                repetitions.append(repetition)
            if not keeps:
                shutil.rmtree(case_folder)
            seed += 1
    return summary
