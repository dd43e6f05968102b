"""Tests of every Vulkan implementation of this machine; scripts/test-devices describes the options."""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import pathlib
import subprocess
import sys
import time

from checks import CONTROL, Checks, Mesh, Outcome, Status
from implementations import (
    QUICK_SUITES,
    SUITES,
    Drivers,
    Implementation,
    Surroundings,
    ValidationLayer,
    with_driver,
)

# Shapes of asdf-vk-generate with numbers of faces. The last mesh needs more texels than the least limit that Vulkan
# allows.
GENERATED = (("animal", 2000), ("torus", 1200), ("slab", 300), ("figure", 30000))
REAL = (
    "models/fandisk.off",
    "models/cow.off",
    "open/elephant-with-holes.off",
    "defects/blobby_3cc.off",
)


class Row:
    def __init__(self, implementation: Implementation, version: str) -> None:
        self.implementation = implementation
        self.version = version
        self.suites: list[Outcome] = []
        self.matrix: list[Outcome] = []
        self.validated: list[Outcome] = []

    def cells(self, layer: str) -> list[str]:
        return [
            self.implementation.title,
            self.version,
            self._suites(),
            _counts(self.matrix),
            self._validation(layer),
        ]

    def failures(self) -> list[Outcome]:
        outcomes = [*self.suites, *self.matrix, *self.validated]
        return [outcome for outcome in outcomes if outcome.status is Status.FAILED]

    def refusals(self) -> set[str]:
        return {outcome.detail for outcome in self.matrix if outcome.status is Status.REFUSED}

    def _suites(self) -> str:
        if not self.suites:
            return "by ctest" if self.implementation.wrapper else "not run"
        failed = [outcome.what for outcome in self.suites if outcome.status is Status.FAILED]
        passed = f"{len(self.suites) - len(failed)} of {len(self.suites)} passed"
        return f"{passed}; failed: {', '.join(failed)}" if failed else passed

    def _validation(self, layer: str) -> str:
        parts = [f"layer {layer}: {_counts(self.validated)}"]
        for outcome in self.suites:
            if outcome.what == "vk":
                parts.append("control failed" if CONTROL in outcome.detail else "control passed")
        return ", ".join(parts)


def _counts(outcomes: list[Outcome]) -> str:
    counts = {status: sum(outcome.status is status for outcome in outcomes) for status in Status}
    shown = {status: count for status, count in counts.items() if count or status is Status.PASSED}
    return ", ".join(f"{count} {status.value}" for status, count in shown.items())


def _say(text: str) -> None:
    print(f"test-devices: {text}", file=sys.stderr, flush=True)


def _meshes(surroundings: Surroundings, is_quick: bool) -> list[Mesh]:
    meshes = []
    folder = surroundings.folder / "meshes"
    folder.mkdir(exist_ok=True)
    for shape, face_count in GENERATED[:1] if is_quick else GENERATED:
        path = folder / f"{shape}{face_count}.ply"
        program = f"{surroundings.program}-generate"
        command = [program, shape, "--faces", str(face_count), "-o", str(path)]
        subprocess.run(command, check=True, capture_output=True)
        meshes.append(path)
    if "ASDF_VK_MESH_DIR" not in os.environ:
        _say("ASDF_VK_MESH_DIR is not set: generated meshes only")
    elif not is_quick:
        real = [pathlib.Path(os.environ["ASDF_VK_MESH_DIR"]) / name for name in REAL]
        meshes += [path for path in real if path.exists()]
    return [Mesh(path, _face_count(surroundings, path)) for path in meshes]


def _face_count(surroundings: Surroundings, path: pathlib.Path) -> int:
    command = [surroundings.program, str(path), "--backend", "reference", "--seeds", "1"]
    command += ["--rays", "1", "--no-estimate", "--json", "--quiet"]
    command += ["-o", str(surroundings.folder / "result.npy")]
    environment = surroundings.environment()
    done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)
    count: int = json.loads(done.stdout)["faceCount"]
    return count


def _version(surroundings: Surroundings, implementation: Implementation) -> str:
    if implementation.wrapper:
        return ""
    devices = surroundings.devices(implementation.environment)
    chosen = next((device for device in devices if device["reason"] == "chosen"), None)
    if chosen is None:
        return "no usable device"
    return f"{chosen['name']}, {str(chosen['driver']).strip()}"


def _check(
    surroundings: Surroundings,
    layer: ValidationLayer,
    implementation: Implementation,
    meshes: list[Mesh],
    suites: tuple[str, ...],
) -> Row:
    start = time.monotonic()
    row = Row(implementation, _version(surroundings, implementation))
    checks = Checks(surroundings, implementation, layer)
    _say(f"{implementation.name}: {len(meshes)} meshes")
    row.matrix = checks.matrix(meshes[: len(GENERATED)] if implementation.wrapper else meshes)
    row.validated = checks.validated(meshes[0])
    for suite in (name for name in implementation.suites if name in suites):
        _say(f"{implementation.name}: suite {suite}")
        row.suites.append(checks.suite(suite))
    for outcome in row.failures():
        _say(f"{implementation.name}: FAILED {outcome.what}: {outcome.detail}")
        _say(f"  repeat: {outcome.command}")
    _say(f"{implementation.name}: {time.monotonic() - start:.0f} s, {len(row.failures())} failed")
    return row


def _table(rows: list[Row], layer: str) -> str:
    lines = ["| implementation | version | suites | matrix | validation |", "|---|---|---|---|---|"]
    lines += [f"| {' | '.join(row.cells(layer))} |" for row in rows]
    reasons = sorted(set().union(*(row.refusals() for row in rows)))
    if reasons:
        lines += ["", "Reasons of the refusals:", "", *(f"- {reason}" for reason in reasons)]
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(prog="scripts/test-devices", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="three suites, one mesh, no fakes")
    parser.add_argument("--list", action="store_true", help="list the implementations")
    parser.add_argument("--only", metavar="NAME,...", help="these implementations")
    parser.add_argument("--fake-suites", action="store_true", help="suites on fake devices too")
    parser.add_argument("--driver", metavar="ICD.json", type=pathlib.Path, help="it only")
    parser.add_argument("--no-suites", action="store_true", help="matrix and validation only")
    arguments = parser.parse_args()
    build = pathlib.Path("build").resolve()
    surroundings = Surroundings(build / "test", build / "devices")
    surroundings.folder.mkdir(parents=True, exist_ok=True)
    drivers = Drivers(surroundings)
    implementations = drivers.all()
    if arguments.driver:
        name = arguments.driver.stem
        implementations = [Implementation(name, name, with_driver(arguments.driver.resolve()))]
    if arguments.quick:
        implementations = [one for one in implementations
                           if not one.wrapper and one.name not in ("lavapipe4", "lavapipe16")]
    if arguments.only:
        names = arguments.only.split(",")
        unknown = set(names) - {one.name for one in implementations}
        if unknown:
            parser.error(f"unknown implementation: {', '.join(sorted(unknown))}; --list names them")
        implementations = [one for one in implementations if one.name in names]
    for reason in drivers.missing:
        _say(f"not available: {reason}")
    if arguments.list:
        for one in implementations:
            print(f"{one.name}: {one.title} ({_version(surroundings, one)})")
        return 0
    if not implementations:
        _say("no Vulkan implementation is available")
        return 1
    meshes = _meshes(surroundings, arguments.quick)
    suites = () if arguments.no_suites else QUICK_SUITES if arguments.quick else SUITES
    if not arguments.fake_suites:  # By default without fake devices, because ctest runs most of these suites on them.
        implementations = [
            dataclasses.replace(one, suites=()) if one.wrapper else one for one in implementations
        ]
    rows: list[Row] = []
    for one in implementations:
        rows.append(_check(surroundings, drivers.layer, one, meshes, suites))
        table = _table(rows, drivers.layer.version)
        (surroundings.folder / "table.md").write_text(table + "\n")
    print(table)
    return 1 if any(row.failures() for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
