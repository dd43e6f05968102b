#!/usr/bin/python3
"""Scores asdf-vk and two simple checks on parts of known truth, and prints the table of docs/thickness.md.

    bench/known_parts.py [--build build/develop] [--backend cpu] [--rows]

Makes the parts by asdf-vk-generate --corpus. --rows: lists the rows with wrong verdicts. Needs python3-numpy. The simple
checks (bench/simple_checks.py) are a ray per face, and shrinking balls between sampled points of the surface.
"""
from __future__ import annotations

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "tests/verify")]

import simple_checks  # noqa: E402
from mesh_files import read_mesh  # noqa: E402

EXIT_VERDICTS = {0: "pass", 5: "notJudged", 6: "fail"}
CATEGORIES = {
    "walls": "walls", "edges": "shapes near the thresholds of the rule", "gaps": "gaps and clearances",
    "voids": "sealed voids", "thick": "thick bodies", "sound": "solids that only look broken",
    "dangerous": "walls without thickness, surfaces of no solid"}


class Program:
    """asdf-vk, called once for each row."""

    def __init__(self, build: pathlib.Path, backend: str) -> None:
        self.path = os.environ.get("ASDF_VK_PROGRAM", build / "src/asdf-vk")
        self.generator = os.environ.get("ASDF_VK_GENERATE", build / "src/asdf-vk-generate")
        self.backend = backend

    def verdict(self, file: pathlib.Path, row: dict) -> str:
        limit = [] if row["limit"] is None else [repr(row["limit"])]
        done = subprocess.run([self.path, file, f"--fail-if-{row['check']}", *limit, "--backend", self.backend, "--quiet"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        return EXIT_VERDICTS.get(done.returncode, f"exit code {done.returncode}: {done.stderr.strip()}")


def kind_of(expected: str, got: str) -> str:
    """The column of a row: right, missed, false, or baseless (a verdict on a surface of no solid)."""
    if got == expected:
        return "right"
    if expected == "fail":
        return "missed"
    return "false" if expected == "pass" else "baseless"


class Score:
    def __init__(self) -> None:
        self.counts: dict[str, dict[str, int]] = {}
        self.wrong: list[str] = []

    def add(self, row: dict, got: str) -> None:
        kind = kind_of(row["verdict"], got)
        counts = self.counts.setdefault(row["category"], dict.fromkeys(("right", "missed", "false", "baseless"), 0))
        counts[kind] += 1
        if kind != "right":
            self.wrong.append(f"{row['file']}: {row['check']} {row['limit']}: expected {row['verdict']}, got {got}. "
                              f"{row['reason']}")

    def cell(self, category: str | None) -> str:
        counts = [self.counts[category]] if category else self.counts.values()
        right, *rest = (sum(count[kind] for count in counts) for kind in ("right", "missed", "false", "baseless"))
        return f"{right} ({', '.join(map(str, rest))})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/develop")
    parser.add_argument("--backend", default="cpu")
    parser.add_argument("--rows", action="store_true")
    arguments = parser.parse_args()
    program = Program(arguments.build, arguments.backend)
    scores = {"asdf-vk": Score(), "a ray per face": Score(), "sampled balls": Score()}
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "corpus"
        subprocess.run([program.generator, "--corpus", folder], check=True, stderr=subprocess.DEVNULL)
        rows = json.loads((folder / "truth.json").read_text())["cases"]
        simple: dict[str, simple_checks.SimpleChecks] = {}
        for row in rows:
            file = folder / row["file"]
            scores["asdf-vk"].add(row, program.verdict(file, row))
            if row["check"] != "voids":
                checks = simple.setdefault(row["file"], simple_checks.SimpleChecks(read_mesh(file)[0]))
                scores["a ray per face"].add(row, checks.by_rays(row["check"], row["limit"]))
                scores["sampled balls"].add(row, checks.by_balls(row["check"], row["limit"]))
    print(f"| parts | rows | {' | '.join(scores)} |\n|---|---|{'---|' * len(scores)}")
    for category, text in CATEGORIES.items():
        count = sum(row["category"] == category for row in rows)
        cells = [score.cell(category) if category in score.counts else "-" for score in scores.values()]
        print(f"| {text} | {count} | {' | '.join(cells)} |")
    print(f"| all | {len(rows)} | {' | '.join(score.cell(None) for score in scores.values())} |")
    if arguments.rows:
        for name, score in scores.items():
            print(f"\n{name}:", *score.wrong, sep="\n  ")


if __name__ == "__main__":
    main()
