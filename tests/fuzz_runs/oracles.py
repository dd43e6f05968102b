"""What must hold for every run. Each oracle returns what is wrong, in sentences."""

from __future__ import annotations

import json
import math
import pathlib
import signal
from collections.abc import Sequence

from program import DOCUMENTED_CODES, Ended

RELATIVE_TOLERANCE = 1e-3
SHARE_OF_OTHERS = 0.002  # Share of the faces that may differ by more.
# Shares of the diagonal: what --check accepts between backends, and what is rounding.
CHECKED_DIFFERENCE = 1e-4
ROUNDING = 1e-7
# Rounding of the thickness at sharp edges: a multiple of its resolution (docs/thickness.md).
THICKNESS_ROUNDING = 1e-5


def rounding(field: str, diagonal: float) -> float:
    return diagonal * (THICKNESS_ROUNDING if "thickness" in field else ROUNDING)


def ended_well(ended: Ended) -> list[str]:
    if ended.code is None:
        return ["the run does not end"]
    if -ended.code in ended.sent:
        return []
    if ended.code < 0:
        return [f"signal {signal.Signals(-ended.code).name}"]
    if ended.code not in DOCUMENTED_CODES:
        return [f"exit code {ended.code}: {last_line(ended.error)}"]
    if ended.code == 130 and not ended.sent:
        return ["exit code 130 without a signal"]
    has_message = any(line.startswith("asdf-vk: error: ") for line in ended.error.splitlines())
    if ended.code not in (0, 5, 6, 130) and not has_message:
        return [f"exit code {ended.code} without a message: {last_line(ended.error)}"]
    return []


def same_values(first: Sequence[float], second: Sequence[float], least: float) -> list[str]:
    """Nearly all faces agree; no value (NaN) agrees with no value. Differences up to least do not
    count."""
    if len(first) != len(second):
        return [f"different numbers of values: {len(first)} and {len(second)}"]
    wrong = [i for i, (a, b) in enumerate(zip(first, second)) if not _agree(a, b, least)]
    if len(wrong) <= max(1, SHARE_OF_OTHERS * len(first)):
        return []
    i = max(wrong, key=lambda f: _distance(first[f], second[f]))
    most = f"most at face {i}: {first[i]:.6g} and {second[i]:.6g}"
    return [f"values differ: at {len(wrong)} of {len(first)} faces, {most}"]


def equal_values(first: Sequence[float], second: Sequence[float]) -> list[str]:
    """Every bit agrees."""
    if len(first) != len(second):
        return [f"different numbers of values: {len(first)} and {len(second)}"]
    for i, (a, b) in enumerate(zip(first, second)):
        if a != b and not (math.isnan(a) and math.isnan(b)):
            return [f"values not equal: at face {i}: {a!r} and {b!r}"]
    return []


def same_labels(first: Sequence[float], second: Sequence[float]) -> list[str]:
    wrong = sum(a != b for a, b in zip(first, second))
    if len(first) == len(second) and wrong == 0:
        return []
    counts = f"{len(set(first))} and {len(set(second))} segments"
    return [f"segments differ: {counts}, {wrong} of {len(first)} faces"]


def possible_values(values: Sequence[float]) -> list[str]:
    if any(value < 0 for value in values):
        return [f"a negative value: {min(v for v in values if v < 0):.6g}"]
    if any(math.isinf(value) for value in values):
        return ["an infinite value"]
    return []


def same_bytes(first: bytes, second: bytes) -> list[str]:
    if first == second:
        return []
    shorter = min(len(first), len(second))
    at = next((i for i in range(shorter) if first[i] != second[i]), shorter)
    return [f"bytes differ: {len(first)} and {len(second)} bytes, first at {at}"]


def same_results(first: dict[str, bytes], second: dict[str, bytes]) -> list[str]:
    """Files by name."""
    wrong = []
    if first.keys() != second.keys():
        wrong.append(f"other results: {sorted(first.keys() ^ second.keys())}")
    for name in first.keys() & second.keys():
        wrong += [f"{w}: {name}" for w in same_bytes(first[name], second[name])]
    return wrong


def old_or_new(result: bytes | None, old: bytes | None, new: bytes) -> list[str]:
    if result in (old, new):
        return []
    size = "no file" if result is None else f"{len(result)} bytes"
    before = "no file" if old is None else f"{len(old)}"
    return [f"neither the old nor the new result: {size}, not {before} or {len(new)}"]


def no_partial_files(folder: pathlib.Path, ended: Ended) -> list[str]:
    """After SIGKILL there may be some."""
    if signal.SIGKILL in ended.sent:
        return []
    names = [path.name for path in folder.rglob("*")]
    left = [n for n in names if n.endswith(".part") or n.startswith(".asdf-vk-")]
    return [f"a partial file is left: {left[0]}"] if left else []


def report_agrees(report: dict, fields: dict[str, list[float]]) -> list[str]:
    """The numbers of the JSON report, with the fields of a result per face."""
    wrong: list[str] = []

    def expect(name: str, stated: float | None, computed: float) -> None:
        if stated is None or not math.isclose(stated, computed, rel_tol=1e-6, abs_tol=1e-44):
            wrong.append(f"the report has another {name}: {stated} and {computed}")

    values = fields.get("sdf")
    if values is not None:
        expect("faceCount", report["faceCount"], len(values))
        present = [value for value in values if not math.isnan(value)]
        expect("noValueCount", report["noValueCount"], len(values) - len(present))
        if present:
            expect("sdf.min", report["sdf"]["min"], min(present))
            expect("sdf.max", report["sdf"]["max"], max(present))
    if "seed" in fields:
        expect("seedCount", report["seedCount"], sum(fields["seed"]))
    if "segment" in fields and report["segmentCount"] is not None:
        labels = {label for label in fields["segment"] if label != 4294967295}
        expect("segmentCount", report["segmentCount"], len(labels))
    for field in report["fields"]:
        form = (field["components"], field["per"], field["type"])
        column = fields.get(field["name"])
        if column is None or form != (1, "face", "float64"):
            continue
        present = [value for value in column if not math.isnan(value)]
        missing = len(column) - len(present)
        expect(f"missingCount of {field['name']}", field["missingCount"], missing)
        if present:
            expect(f"min of {field['name']}", field["min"], min(present))
            expect(f"max of {field['name']}", field["max"], max(present))
    return wrong


def reports_of(output: bytes) -> tuple[list[dict], list[str]]:
    """The lines of --json."""
    try:
        return [json.loads(line, parse_constant=_refuse) for line in output.splitlines()], []
    except ValueError as error:
        return [], [f"no JSON: {error}"]


def _refuse(constant: str) -> float:
    raise ValueError(f"{constant} is no JSON")


def _agree(a: float, b: float, least: float) -> bool:
    if math.isnan(a) or math.isnan(b):
        return math.isnan(a) and math.isnan(b)
    return a == b or abs(a - b) <= max(least, RELATIVE_TOLERANCE * max(abs(a), abs(b)))


def _distance(a: float, b: float) -> float:
    return math.inf if math.isnan(a) != math.isnan(b) else abs(a - b)


def last_line(text: str) -> str:
    lines = text.strip().splitlines()
    return lines[-1] if lines else "no message"
