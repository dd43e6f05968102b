"""Validates what the program prints as JSON by its own schema, with a validator that is not of this project.

report_schema_test.py PROGRAM GENERATOR
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import jsonschema

BOX = """OFF
8 6 0
0 0 0
9 0 0
9 9 0
0 9 0
0 0 {z}
9 0 {z}
9 9 {z}
0 9 {z}
4 3 2 1 0
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
4 4 5 6 7
"""


def closed(schema: dict[str, Any]) -> dict[str, Any]:
    """The schema without room for keys that it does not name: every key of the program must be in it."""
    for name, definition in schema["$defs"].items():
        if "properties" in definition and name != "Report":
            definition["unevaluatedProperties"] = False
    schema["$defs"]["Result"]["unevaluatedProperties"] = False
    return schema


def main(program: str, generator: str) -> None:
    def output(*arguments: str, code: int | None = None) -> str:
        ended = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
        assert code is None or ended.returncode == code, (arguments, ended.returncode, ended.stderr)
        return ended.stdout

    text = output("--print-schema", code=0)
    schema = closed(json.loads(text))
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    kinds: dict[str, int] = {}

    def check(*arguments: str, code: int | None = None) -> None:
        lines = output(*arguments, "--json", "--quiet", code=code).splitlines()
        assert lines, arguments
        for line in lines:
            document = json.loads(line)
            errors = [f"{list(error.absolute_path)}: {error.message[:300]}" for error in validator.iter_errors(document)]
            context = [
                f"{list(each.absolute_path)}: {each.message[:300]}"
                for error in validator.iter_errors(document)
                for each in error.context or ()
            ]
            assert not errors, (arguments, errors, context[:10])
            kind = "failure" if "error" in document else document.get("status", "result")
            kinds[kind] = kinds.get(kind, 0) + 1

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        thin, thick, other, animal = (str(folder / f) for f in ("thin.off", "thick.off", "other.off", "animal.ply"))
        Path(thin).write_text(BOX.format(z=0.5))
        Path(thick).write_text(BOX.format(z=2))
        Path(other).write_text("\n".join(BOX.format(z=2).splitlines()[:-1]).replace("8 6 0", "8 5 0"))  # Open.
        subprocess.run([generator, "animal", "--faces", "4000", "-o", animal], check=True, capture_output=True)
        none = ("-o", str(folder / "out.npy"))
        for backend in ("cpu", "vulkan"):
            check(animal, *none, "--backend", backend, "--seeds", "300", "--check", "--segment", code=0)
        check(animal, *none, "--seeds", "all", "--recipe", "paper", "--per", "vertex", code=0)
        check(animal, *none, "--definition", "cgal", "--segment", "cgal", code=0)
        check(thin, "--fail-if-thinner", "0.8", "--count-edges", code=6)
        check(thick, "--fail-if-thinner", "0.8", "--fail-if-closer", "0.3", "--fail-if-thicker", "1", code=6)
        check(other, "--fail-if-thinner", "0.8", code=5)
        check(thick, "--fail-if-closer", "1", "--with", thin, "--fail-if-contact")
        check(thin, "--compare", thick, "--fail-if-thinner", "0.8", code=6)
        check(thin, thick, "/nowhere.off", "--fail-if-thinner", "0.8", code=6)
        batch = (thin, thick, "-o", str(folder / "out") + "/", "--measure", "thickness", "--skip-existing")
        check(*batch, code=0)
        check(*batch, code=0)
        check(thin, "--bogus", code=1)
        check("--fail-if-thinner", "0.8", code=1)
    assert kinds == {"result": 13, "failure": 3, "skipped": 2}, kinds
    # Documents that break the schema are found.
    for broken in ({}, {"formatVersion": 1, "mesh": None, "error": "x"}, {"formatVersion": 2}):
        assert not validator.is_valid(broken), broken


if __name__ == "__main__":
    main(*sys.argv[1:])
