"""Validates the JSON that the program has printed, written and read in the other tests (tests/support/kept_json.h).

kept_json_test.py PROGRAM FOLDER

ASDF_VK_SARIF_SCHEMA may have the path of sarif-schema-2.1.0.json, which is not part of this project.
"""

from __future__ import annotations

import collections
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema

from json_documents import Schemas, documents_in, kind_of


def shape_of(value: Any) -> Any:
    """Equal for documents that differ only in numbers, long texts and the lengths of lists."""
    if isinstance(value, dict):
        return tuple(sorted((key, shape_of(each)) for key, each in value.items()))
    if isinstance(value, list):
        return frozenset(shape_of(each) for each in value)
    if isinstance(value, str):
        return value if value.isidentifier() else str
    return (type(value), value < 0) if isinstance(value, (int, float)) else value


def main(program: str, folder: str) -> None:
    schemas = Schemas(program)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    sarif = os.environ.get("ASDF_VK_SARIF_SCHEMA")
    sarif_schema = json.loads(Path(sarif).read_text()) if sarif else None
    sarif_validator = jsonschema.validators.validator_for(sarif_schema)(sarif_schema) if sarif else None
    counts: collections.Counter[str] = collections.Counter()
    failures: list[str] = []
    seen = set()

    def check(kind: str, document: Any) -> None:
        counts[kind] += 1
        shape = (kind, shape_of(document))
        if shape in seen:
            return
        seen.add(shape)
        if errors := schemas.errors(kind, document):
            failures.append("\n  ".join([json.dumps(document)[:300], *errors[:8]]))

    def check_request(line: str, answers: dict[str, Any]) -> None:
        try:
            request = json.loads(line)
        except ValueError:
            return
        answer = answers.get(json.dumps(request.get("id"))) if isinstance(request, dict) else None
        if answer is not None and "report" in answer:
            check("request", request)

    for path in sorted(Path(folder).glob("*.jsonl")):
        for line in path.read_text().splitlines():
            run = json.loads(line)
            try:
                documents = documents_in(run["output"])
            except ValueError as error:
                if not run["file"]:  # Tests write incomplete files, but the program prints none.
                    failures.append(f"{run['output'][:300]}\n  {error}")
                continue
            for document in documents:
                kind = kind_of(document)
                # Tests write files, too; those of the program have its version.
                if run["file"] and not (kind == "record" and document.get("version") == version):
                    kind = None
                if kind:
                    check(kind, document)
                if "runs" in document and sarif_validator:
                    counts["SARIF"] += 1
                    failures.extend(error.message[:300] for error in sarif_validator.iter_errors(document))
                structured = document.get("result", {}).get("structuredContent") if "jsonrpc" in document else None
                if structured and "error" not in structured:
                    check("report", structured)
            if run["input"]:
                answers = {json.dumps(each.get("id")): each for each in documents}
                for request in run["input"].splitlines():
                    check_request(request, answers)
    print(f"{sum(counts.values())} documents, {len(seen)} shapes: {dict(counts)}")
    assert not failures, f"{len(failures)} invalid documents:\n" + "\n".join(failures[:10])
    assert counts or not list(Path(folder).iterdir())


if __name__ == "__main__":
    main(*sys.argv[1:])
