"""A case: its folder, its random numbers, its runs and what is found."""

from __future__ import annotations

import pathlib
import random

import oracles
import results
import shapes
from program import RESULT_CODES, Ended, Program

BACKENDS = ("vulkan", "cpu", "reference")
VALUE_FORMATS = ("npy", "npz", "csv", "ply")


class Case:
    def __init__(self, program: Program, rng: random.Random, folder: pathlib.Path) -> None:
        self.program = program
        self.rng = rng
        self.folder = folder
        self.findings: list[str] = []
        self.topic = ""  # What sets this case apart from others of its kind.

    def run(self, *arguments: str) -> Ended:
        """An undisturbed run, which must end well."""
        ended = self.program.run(list(arguments), self.folder)
        self.note(oracles.ended_well(ended), ended)
        self.note(oracles.no_partial_files(self.folder, ended), ended)
        return ended

    def note(self, wrong: list[str], ended: Ended | None = None) -> None:
        self.findings += [f"{w}  [{ended.command}]" if ended else w for w in wrong]

    def write(self, mesh: shapes.Mesh, name: str) -> str:
        shapes.write(mesh, self.folder / name)
        if shapes.has_contacts(mesh):
            self.topic = "with contacts"
        with (self.folder / "shapes.txt").open("a", encoding="utf-8") as notes:
            notes.write(f"{name}: {mesh.what}\n")
        return name

    def values(self, mesh: str, output: str, *arguments: str) -> dict[str, list[float]] | None:
        """The fields of a run that must have a result; None where it has none, which is noted."""
        ended = self.run(mesh, "-o", output, *arguments)
        if ended.code in RESULT_CODES:
            return results.fields_of(self.folder / output)
        reason = oracles.last_line(ended.error)
        self.note([f"no result where one is due, exit code {ended.code}: {reason}"], ended)
        return None
