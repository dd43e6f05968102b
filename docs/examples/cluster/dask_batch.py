"""Computes the meshes of a list on a Dask cluster, a task per mesh:

python3 dask_batch.py SCHEDULER_FILE LIST RESULTS [OPTIONS...]

Workers append records to RESULTS/log/dask-HOST-THREAD.jsonl. The same call again computes what is missing. Exit code 7:
some meshes failed, the others are done.
"""

from __future__ import annotations

import datetime
import json
import os
import pathlib
import socket
import subprocess
import sys
import threading
from typing import Any

from distributed import Client, as_completed

INTERNAL_ERROR, CANCELLED = 70, 130  # exit codes of asdf-vk


def compute(mesh: str, folder: str, log_folder: str, options: list[str]) -> dict[str, Any]:
    """The record of one mesh. Never raises: a failure is a record too, so that no mesh stops the others."""
    log = pathlib.Path(log_folder, f"dask-{socket.gethostname()}-{threading.get_native_id()}.jsonl")
    # The program writes the log itself, so that a record outlives a worker and a client that are killed.
    command = ["asdf-vk", mesh, "-o", f"{folder}/", "--log", str(log), "--skip-existing", "--quiet"]
    try:
        begin = log.stat().st_size if log.exists() else 0
        ended = subprocess.run([*command, *options], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, errors="replace")
        lines = log.read_bytes()[begin:].splitlines() if log.exists() else []
        if not lines:
            return recorded_failure(log, mesh, ended.returncode, ended.stderr.strip())
        record: dict[str, Any] = json.loads(lines[-1])
        return record
    except Exception as error:
        return recorded_failure(log, mesh, INTERNAL_ERROR, f"{type(error).__name__}: {error}")


def recorded_failure(log: pathlib.Path, mesh: str, code: int, message: str) -> dict[str, Any]:
    """Writes and returns the record of a failure for which the program has written none."""
    # A negative code is that of a signal. Of other codes the message says more than a name would.
    error = "internal" if code == INTERNAL_ERROR else "crashed" if code < 0 else None
    name = os.fsencode(mesh)
    now = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="milliseconds").replace("+00:00", "Z")
    record: dict[str, Any] = {"input": name.decode(errors="replace"), "time": now, "status": "failed", "code": code,
                              "error": error, "message": message}
    if record["input"] != mesh:  # The name is not UTF-8.
        record["inputBytes"] = name.hex()
    try:
        written = log.read_bytes() if log.exists() else b""
        end_of_cut_line = "" if written.endswith(b"\n") or not written else "\n"
        with open(log, "a") as file:
            file.write(f"{end_of_cut_line}{json.dumps(record)}\n")
    except OSError as error:
        record["message"] = f"{message}; {error}"
    return record


def main() -> int:
    if len(sys.argv) < 4:
        print(__doc__, file=sys.stderr)
        return 1
    scheduler_file, list_file, results, *options = sys.argv[1:]
    if not any(option == "--threads" or option.startswith("--threads=") for option in options):
        options += ["--threads", "1"]
    names = pathlib.Path(list_file).read_text(errors="surrogateescape").split("\n")
    if any("\t" in name for name in names):
        print(f"{list_file}: this recipe takes no keys; remove the tabs, or use a recipe with shards", file=sys.stderr)
        return 2
    meshes = [os.path.abspath(name) for name in (name.removesuffix("\r") for name in names) if name]
    if not meshes:
        print(f"{list_file}: no mesh was found", file=sys.stderr)
        return 2
    # Results mirror the tree below the common folder, as with --files-from.
    common = os.path.commonpath([os.path.dirname(mesh) for mesh in meshes])
    results = os.path.abspath(results)
    folders = [os.path.normpath(f"{results}/{os.path.relpath(os.path.dirname(mesh), common)}") for mesh in meshes]
    log_folder = f"{results}/log"
    os.makedirs(log_folder, exist_ok=True)
    failed = 0
    with Client(scheduler_file=scheduler_file) as client:
        # pure=False: a task runs even if the scheduler holds the result of an earlier call.
        futures = client.map(compute, meshes, folders, log_folder=log_folder, options=options, pure=False)
        mesh_of = dict(zip((future.key for future in futures), meshes))
        for future in as_completed(futures):
            try:
                record = future.result()
            except Exception as error:  # Several workers were killed while they computed it.
                log = pathlib.Path(log_folder, "dask-client.jsonl")
                message = f"{type(error).__name__}: {error}"
                record = recorded_failure(log, mesh_of[future.key], INTERNAL_ERROR, message)
            failed += record["code"] not in (0, CANCELLED)  # A skipped mesh has the verdict of an earlier call.
    print(f"{len(meshes)} meshes, {failed} failed", file=sys.stderr)
    return 7 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
