"""The tests of scripts/test-hosts: makes meshes, runs each host program on them, and prints a table.

Everything is made below FOLDER. A host that is not installed is skipped with a line. Exit code 1: a check failed.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Iterator

import numpy as np

import polygons

HERE = Path(__file__).resolve().parent
TIMEOUT = 120  # Seconds for one host.


def meshes(folder: Path, program: Path) -> None:
    """The inputs of the hosts, and the values of the command line."""

    def call(name: str, *arguments: str) -> None:
        subprocess.run([program.parent / name, *arguments], check=True, cwd=folder, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)  # fmt: skip

    call("asdf-vk-generate", "ligament-96", "-o", "part.ply")
    call("asdf-vk-generate", "figure", "--faces", "6000", "-o", "figure.ply")
    call("asdf-vk-generate", "animal", "--faces", "150000", "-o", "big.ply")
    vertices, faces = polygons.shape()
    polygons.write_ply(str(folder / "polygons.ply"), vertices, faces)
    np.save(folder / "polygons.corners.npy", np.concatenate(faces))
    np.save(folder / "polygons.sizes.npy", [len(face) for face in faces])
    for mesh, field, options in (
        ("part", "sdf", []), ("part", "thickness", ["--measure", "thickness"]), ("figure", "segment", ["--segment"]),
        ("part", "least_thickness", ["--measure", "thickness"]), ("polygons", "thickness", ["--measure", "thickness"]),
    ):  # fmt: skip
        call("asdf-vk", f"{mesh}.ply", *options, "--fields", field, "-o", f"{mesh}.{field}.npy")


@contextlib.contextmanager
def display() -> Iterator[dict[str, str] | None]:
    """The variables of a display in memory; None where there is no Xvfb."""
    if shutil.which("Xvfb") is None:
        yield None
        return
    read, write = os.pipe()
    # Without -noreset the server resets after the last client of a host, and refuses the first client of the next one.
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1000x24", "-nolisten", "tcp", "-noreset"]
    server = subprocess.Popen(command, pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as numbers:
        yield {"DISPLAY": f":{numbers.readline().strip()}"}
    server.terminate()
    server.wait()


def run(host: str, needed: str, command: list[str], folder: Path, environment: dict[str, str] | None
        ) -> tuple[str, str, str]:
    """A row of the table."""
    if shutil.which(needed) is None or environment is None:
        program = needed if shutil.which(needed) is None else "Xvfb"
        print(f"test-hosts: {host} is skipped: there is no program {program}", flush=True)
        return host, "0", "skipped"
    started = time.monotonic()
    log = folder / f"{host.lower()}.log"
    with log.open("w") as output:
        process = subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT, start_new_session=True)  # fmt: skip
        try:
            code = process.wait(TIMEOUT)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            code = process.wait()
            output.write(f"\n{host}: FAILED: no end after {TIMEOUT} s\n")
    text = log.read_text(errors="replace")
    found = re.search(r"^checks: .*?: (\d+) checks, (\d+) failed$", text, re.MULTILINE)
    seconds = time.monotonic() - started
    if found and found[2] == "0" and code == 0:
        return host, found[1], f"passed, {seconds:.0f} s"
    lines = [line for line in text.splitlines() if "FAILED" in line] or text.splitlines()[-15:]
    print("\n".join(lines), f"\ntest-hosts: {host} failed (exit code {code}); its output is {log}", flush=True)
    return host, found[1] if found else "?", f"FAILED, {seconds:.0f} s"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True, help="build folder with programs and module")
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    build = arguments.build.resolve()
    program = build / "src/asdf-vk"
    environment = {
        **os.environ,
        "PYTHONPATH": f"{build / 'python'}:{HERE}",
        "ASDF_VK_PROGRAM": str(program),
        "HOME": str(folder),  # Settings of the hosts stay there.
        "XDG_RUNTIME_DIR": str(folder / "runtime"),
        "LIBGL_ALWAYS_SOFTWARE": "1",
        "QT_QPA_PLATFORM": "xcb",
        "QTWEBENGINE_DISABLE_SANDBOX": "1",  # The start page of FreeCAD, as root.
    }
    (folder / "runtime").mkdir(mode=0o700)
    environment.pop("PYTHONHOME", None)
    environment.pop("XDG_CONFIG_HOME", None)
    meshes(folder, program)
    shots = folder / "pictures"
    shots.mkdir()
    paths = ["-P", str(build / "python"), "-P", str(HERE)]  # FreeCAD with a window ignores PYTHONPATH.
    rows = []
    blender = ["blender", "--python-use-system-env", "--factory-startup", "--python-exit-code", "3"]
    window = ["--enable-event-simulate", "--window-geometry", "0", "0", "920", "540"]
    with display() as shown:
        for host, needed, needs_display, command in (
            ("Blender", "blender", False, [*blender, "-b", "--python", HERE / "blender_test.py", "--", folder]),
            ("Blender window", "blender", True, [*blender, *window, "--python", HERE / "blender_window_test.py", "--",
                                                 folder, shots / "blender.png"]),
            ("FreeCAD", "freecadcmd", False, ["freecadcmd", *paths, HERE / "freecad_test.py"]),
            ("FreeCAD window", "freecad", True, ["freecad", *paths, HERE / "freecad_window_test.py"]),
            ("ParaView", "pvbatch", True, ["pvbatch", HERE / "paraview_test.py", folder, shots / "paraview.png"]),
            ("Exchange", sys.executable, False, [sys.executable, "-B", HERE / "exchange_test.py", folder]),
        ):  # fmt: skip
            if arguments.only and not any(name in host.lower() for name in arguments.only.lower().split(",")):
                continue
            variables = {**environment, "ASDF_VK_SHOTS": str(shots)}
            if needs_display:
                variables = None if shown is None else {**variables, **shown}
            rows.append(run(host, needed, [str(word) for word in command], folder, variables))
    if not rows:
        sys.exit(f"test-hosts: no host has the name '{arguments.only}'")
    print(f"\n{'host':16} {'checks':>6}  result")
    for host, checks, result in rows:
        print(f"{host:16} {checks:>6}  {result}")
    return 1 if any("FAILED" in result for _, _, result in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
