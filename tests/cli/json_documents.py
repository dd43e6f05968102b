"""The JSON documents of the program and their schema, for a validator that is not of this project."""

from __future__ import annotations

import json
import subprocess
from typing import Any

import jsonschema

KINDS = {
    "meshCount": "summary",
    "tracers": "device-report",
    "devices": "devices",
    "known": "baseline",
    "limits": "limits",
    "found": "answer",
    "report": "answer",
    "inputHash": "record",
    "mesh": "report",
}


def kind_of(document: dict[str, Any]) -> str | None:
    """The document of --print-schema by keys that only this one has; None: it is no document of the program."""
    if {"jsonrpc", "runs", "$defs", "asset"} & document.keys():
        return None
    if "id" in document and "error" in document:
        return "answer"
    return next((kind for key, kind in KINDS.items() if key in document), "report")


class Schemas:
    """Validators of all documents. Keys that the schema does not name are errors."""

    def __init__(self, program: str) -> None:
        printed = subprocess.run([program, "--print-schema=all"], capture_output=True, text=True, check=True).stdout
        self.parts: dict[str, Any] = json.loads(printed)["$defs"]
        for part in self.parts.values():
            if "properties" in part:
                part["additionalProperties"] = False
        self._validators: dict[str, Any] = {}

    def check_all(self) -> None:
        jsonschema.Draft202012Validator.check_schema(self._schema("report"))

    def _schema(self, name: str) -> dict[str, Any]:
        return {"$schema": "https://json-schema.org/draft/2020-12/schema", "$defs": self.parts, "$ref": f"#/$defs/{name}"}

    def errors(self, kind: str, document: Any) -> list[str]:
        if kind not in self._validators:
            self._validators[kind] = jsonschema.Draft202012Validator(self._schema(kind))
        messages = []
        for error in self._validators[kind].iter_errors(document):
            for each in [error, *(error.context or ())]:
                messages.append(f"{kind} {list(each.absolute_path)}: {each.message[:300]}")
        return messages


def documents_in(text: str) -> list[Any]:
    """The JSON documents at the begins of lines; other lines are skipped."""
    decoder, documents, at = json.JSONDecoder(), [], 0
    while at < len(text):
        if text[at] != "{":
            at = text.find("\n", at) + 1 or len(text)
            continue
        document, at = decoder.raw_decode(text, at)
        documents.append(document)
        at = text.find("\n", at) + 1 or len(text)
    return documents
