"""Tests the function of the Dask recipe with programs that do not start or fail in different ways."""

from __future__ import annotations

import importlib.util
import json
import os
import pathlib
import types
from typing import Any

from daemons import Failed
from engine import RECIPES
from meshes import summary

# For each name: a shell script that replaces asdf-vk, and the expected code and message of the record. $5 is the log.
_PROGRAMS = {
    "killed": ("kill -KILL $$", -9, ""),
    "ends without a record": ("echo a reason >&2; exit 3", 3, "a reason"),
    "cuts its record": ("""printf '{"input": ' >>"$5"; kill -KILL $$""", 70, "JSONDecodeError"),
    "does not run": (None, 70, "FileNotFoundError"),
}


def _recipe() -> types.ModuleType:
    spec = importlib.util.spec_from_file_location("dask_batch", RECIPES / "dask_batch.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _record(recipe: types.ModuleType, place: pathlib.Path, log_folder: pathlib.Path) -> Any:
    try:
        return recipe.compute("mesh.ply", str(place), str(log_folder), [])
    except Exception as error:
        raise Failed(f"the function of the recipe raises {error!r}") from error


def check(folder: pathlib.Path, asdf_vk: str) -> None:
    """Fails if the function raises or returns another record."""
    recipe = _recipe()
    path = os.environ["PATH"]
    for name, (script, code, message) in _PROGRAMS.items():
        place = folder / name
        (place / "log").mkdir(parents=True)
        program = place / "asdf-vk"
        if script is not None:
            program.write_text(f"#!/bin/sh\n{script}\n")
            program.chmod(0o755)
        os.environ["PATH"] = str(place)
        try:
            for log_folder in (place / "log", place / "missing"):
                record = _record(recipe, place, log_folder)
                if record["status"] != "failed" or record["input"] != "mesh.ply":
                    raise Failed(f"program {name}: {record}")
                if log_folder.exists() and (record["code"] != code or message not in record["message"]):
                    raise Failed(f"program {name}: {record}")
            lines = next((place / "log").glob("*.jsonl")).read_text().splitlines()
            if json.loads(lines[-1])["code"] != code:
                raise Failed(f"program {name}: its log has {lines}")
            if summary(asdf_vk, place)["failedCount"] != 1:
                raise Failed(f"asdf-vk summarize does not count the record of program {name}")
        finally:
            os.environ["PATH"] = path
