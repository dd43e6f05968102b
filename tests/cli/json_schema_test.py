"""Validates the JSON documents of the program by its own schema, with a validator that is not of this project.

json_schema_test.py PROGRAM GENERATOR
"""

from __future__ import annotations

import base64
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import jsonschema

from json_documents import Schemas

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


def main(program: str, generator: str) -> None:
    def output(*arguments: str, code: int | None = None, text: str = "") -> str:
        ended = subprocess.run([program, *arguments], capture_output=True, text=True, check=False, input=text)
        assert code is None or ended.returncode == code, (arguments, ended.returncode, ended.stderr)
        return ended.stdout

    schemas = Schemas(program)
    schemas.check_all()
    kinds: dict[str, int] = {}

    def check_document(kind: str, document: Any) -> None:
        errors = schemas.errors(kind, document)
        assert not errors, (kind, errors[:10], json.dumps(document)[:300])
        kinds[kind] = kinds.get(kind, 0) + 1

    def check(*arguments: str, code: int | None = None) -> None:
        lines = output(*arguments, "--json", "--quiet", code=code).splitlines()
        assert lines, arguments
        for line in lines:
            check_document("report", json.loads(line))

    def check_schemas() -> None:
        """Each document has a schema that needs no other file."""
        names = [name for name in schemas.parts if name.islower()]
        assert len(names) == 9, names
        assert output("--print-schema") == output("--print-schema=report")
        for name in names:
            schema = json.loads(output(f"--print-schema={name}", code=0))
            assert not jsonschema.Draft202012Validator(schema).is_valid({"formatVersion": 2}), name
        output("--print-schema=bogus", code=1)

    def check_server(mesh: str) -> None:
        requests = [
            {"id": 1, "mesh": mesh, "options": {"failIfThinner": 0.8, "seeds": None}, "timeout": 60},
            {"id": "2", "format": "off", "data": base64.b64encode(Path(mesh).read_bytes()).decode()},
            {"id": None, "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
             "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], "picture": {"inline": True, "view": "30,18"},
             "output": {"inline": True, "format": "npy", "fields": ["sdf"]}, "options": {"measure": "both"}},
            {"cancel": 7},
        ]
        wrong: list[Any] = [{"id": 5}, {"id": 6, "mesh": mesh, "options": {"bogus": 1}}, {"id": 7, "mesh": 3},
                            {"id": 8, "mesh": mesh, "bogus": 1}, {"id": 9, "mesh": mesh, "timeout": -1},
                            {"id": 10, "mesh": mesh, "options": {"rays": 0}}]
        lines = "\n".join(json.dumps(request) for request in [*requests, *wrong]) + "\nno JSON\n"
        answers = [json.loads(line) for line in output("serve", "--jobs", "1", text=lines, code=0).splitlines()]
        assert len(answers) == 11 and sum("report" in answer for answer in answers) == 3, answers
        for answer in answers:
            check_document("answer", answer)
        for request in requests:
            check_document("request", request)
        for request in wrong:
            assert schemas.errors("request", request), request

    def check_tools(mesh: str) -> None:
        """Structured content has the form that its tool states."""
        calls: list[tuple[str, dict[str, Any]]] = [("check_walls", {"thinnerThan": 0.8}), ("measure", {}),
                                                   ("find_parts", {}), ("picture", {}), ("measure", {"seeds": 0})]
        messages: list[dict[str, Any]] = [
            {"method": "initialize", "params": {"protocolVersion": "2025-06-18", "capabilities": {}}},
            {"method": "tools/list"},
            *({"method": "tools/call", "params": {"name": name, "arguments": {"mesh": mesh, **more}}} for name, more in calls),
        ]
        lines = [json.dumps({"jsonrpc": "2.0", "id": i, **message}) for i, message in enumerate(messages)]
        printed = output("mcp", "--root", "/", "--jobs", "1", text="\n".join(lines) + "\n", code=0).splitlines()
        results = {answer["id"]: answer["result"] for answer in map(json.loads, printed)}
        tools = {tool["name"]: tool["outputSchema"] for tool in results[1]["tools"]}
        assert len(printed[1]) < 20000, len(printed[1])  # Clients send the list to a model.
        for i, (name, _) in enumerate(calls, start=2):
            jsonschema.Draft202012Validator.check_schema(tools[name])
            content = results[i]["structuredContent"]
            assert results[i]["isError"] == ("error" in content) == (i == 6), results[i]
            jsonschema.Draft202012Validator(tools[name]).validate(content)
            assert not jsonschema.Draft202012Validator(tools[name]).is_valid({}), name
            if "error" not in content:
                check_document("report", content)

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
        check_schemas()
        check_server(thin)
        check_tools(thin)
        log, limits, baseline = (folder / f for f in ("log.jsonl", "limits.json", "baseline.json"))
        limits.write_text('{"$schema": "x", "limits": [{"files": "*", "fail-if-thinner": 0.8, "count-edges": true}]}')
        files = ("--limits", str(limits), "--log", str(log), "--baseline", str(baseline))
        output(thin, thick, "/nowhere.off", *files, "--update-baseline", "--quiet")
        check_document("limits", json.loads(limits.read_text()))
        check_document("baseline", json.loads(baseline.read_text()))
        for line in log.read_text().splitlines():
            check_document("record", json.loads(line))
        check_document("summary", json.loads(output("summarize", str(log), "--format", "json", code=0)))
        check_document("devices", json.loads(output("--list-devices", "--json")))
        check_document("device-report", json.loads(output("--device-report", "--backend", "reference")))
        batch = (thin, thick, "-o", str(folder / "out") + "/", "--measure", "thickness", "--skip-existing")
        check(*batch, code=0)
        check(*batch, code=0)
        check(thin, "--bogus", code=1)
        check("--fail-if-thinner", "0.8", code=1)
    assert kinds == {"report": 22, "record": 3, "summary": 1, "request": 4, "answer": 11, "devices": 1,
                     "device-report": 1, "limits": 1, "baseline": 1}, kinds
    # Documents that break the schema are found.
    for broken in ({}, {"formatVersion": 1, "mesh": None, "error": "x"}, {"formatVersion": 2}):
        for kind in kinds:
            assert schemas.errors(kind, broken), (kind, broken)


if __name__ == "__main__":
    main(*sys.argv[1:])
