"""Replaces the extension module cgal_Segmentation_Module of neuron pipelines. Uses asdf_vk instead of CGAL.

    import cgal_Segmentation_Module
    code = cgal_Segmentation_Module.cgal_segmentation("neuron", 3, 0.20)
    # reads neuron.off, writes neuron-cgal_3_0.20.csv and neuron-cgal_3_0.20_sdf.csv

    labels, values = cgal_Segmentation_Module.cgal_segmentation_arrays(vertices, faces, 3, 0.20)

The functions print nothing. asdf_vk.compat.cgal describes the definitions, and the differences from CGAL.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import threading
from typing import TYPE_CHECKING, Any, Literal

import asdf_vk
from asdf_vk._errors import error_of
from asdf_vk.compat.cgal import values_and_segments

if TYPE_CHECKING:
    import numpy as np
    from asdf_vk._options import BackendOptions
    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Unpack

__all__ = ["cgal_segmentation", "cgal_segmentation_arrays"]

DONE, CANNOT_OPEN, CANNOT_PARSE, EMPTY, NOT_TRIANGLES = 1, 2, 3, 4, 6

_COUNTS_LIMIT = 1 << 16  # The counts of an OFF file must be within this number of bytes from its start.


def cgal_segmentation(
    path_without_extension: str | os.PathLike[str],
    clusters: int,
    smoothness: float,
    *,
    expansion: Literal["all", "first"] | None = "all",
    **options: Unpack[BackendOptions],
) -> int:
    """Computes values and segments of the mesh PATH.off, and writes them in the same folder.

    clusters: 2 to 100. smoothness: 0 to 1000.
    expansion, options: as in asdf_vk.compat.cgal.

    Both output files have a line per face, in the order of the mesh. PATH-cgal_{clusters}_{smoothness:.2f}.csv has the
    segment of each face, from 0 on. PATH-cgal_{clusters}_{smoothness:.2f}_sdf.csv has the value of each face from 0 to
    1, with 6 significant digits. When both files are complete, they are renamed from temporary names to these names.

    Returns a code. 1: done; 2: PATH.off cannot be opened; 3: PATH.off is not a valid OFF file; 4: the mesh has no
    faces; 6: a face is not a triangle. Raises OSError if a file cannot be written. Raises asdf_vk.Error for all other
    failures, for example fewer different values than clusters.

    If this process was forked after a use of asdf_vk, the function computes in a new process of the same interpreter.
    """
    path = os.fsdecode(path_without_extension)
    try:
        mesh = _read_triangles(path + ".off")
        if isinstance(mesh, int):
            return mesh
        labels, values = cgal_segmentation_arrays(
            mesh, None, clusters, smoothness, expansion=expansion, **options
        )
    except asdf_vk.DeviceError as error:
        if error.code != "forkedProcess" or options.get("session") is not None:
            raise
        return _in_new_process(path, clusters, smoothness, {"expansion": expansion, **options})
    name = f"{path}-cgal_{clusters}_{smoothness:.2f}"
    # ravel() is for the type checker: with NumPy 2, tolist() is a list of numbers only for an array of one dimension.
    segments = "".join([f"{label}\n" for label in labels.ravel().tolist()])
    numbers = "".join([f"{value:g}\n" for value in values.ravel().tolist()])
    _write_whole({f"{name}.csv": segments, f"{name}_sdf.csv": numbers})
    return DONE


def cgal_segmentation_arrays(
    vertices: Any,
    faces: ArrayLike | None,
    clusters: int,
    smoothness: float,
    *,
    expansion: Literal["all", "first"] | None = "all",
    **options: Unpack[BackendOptions],
) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Like cgal_segmentation(), but without files and return codes.

    vertices, faces: (n, 3) and (m, 3). Or `vertices` is an object with both attributes, and `faces` is None.
    Returns the segments, int32 (m,), and the values from 0 to 1, float64 (m,). Raises asdf_vk.Error.
    """
    for name, value in (("clusters", clusters), ("smoothness", smoothness)):
        if value is None:
            raise error_of("optionOutOfRange", f"{name}=None is not a number")
    segmentation = {"clusters": clusters, "smoothness": smoothness, "expansion": expansion}
    values, labels = values_and_segments(vertices, faces, segmentation, {**options})
    return labels, values


def _read_triangles(path: str) -> asdf_vk.Mesh | int:
    """Returns the mesh, or the code of the failure."""
    try:
        with open(path, "rb") as file:
            start = file.read(_COUNTS_LIMIT)
    except (OSError, ValueError):  # A ValueError means that the path is not a valid file name.
        return CANNOT_OPEN
    words = b"\n".join(line.split(b"#")[0] for line in start.splitlines()).split()
    if not words or not words[0].endswith(b"OFF"):
        return CANNOT_PARSE
    if len(words) > 2 and words[1].isdigit() and words[2].isdigit() and int(words[2]) == 0:
        return EMPTY
    try:
        mesh = asdf_vk.read_mesh(path)
    except asdf_vk.InputError as error:
        if error.code != "unreadableInput":
            raise
        return CANNOT_PARSE
    return mesh if mesh.face_of_triangle is None else NOT_TRIANGLES


def _write_whole(texts: dict[str, str]) -> None:
    """Writes temporary files in the folders of the files. Renames them when all are complete."""
    suffix = f".{os.getpid()}-{threading.get_ident()}.tmp"
    try:
        for path, text in texts.items():
            with open(path + suffix, "w", encoding="ascii", newline="\n") as file:
                file.write(text)
        for path in texts:
            os.replace(path + suffix, path)
    finally:
        for path in texts:
            if os.path.exists(path + suffix):
                os.remove(path + suffix)


_CHILD = """import pickle, sys
import cgal_Segmentation_Module as module
arguments, options = pickle.load(sys.stdin.buffer)
try:
    outcome = module.cgal_segmentation(*arguments, **options)
except Exception as error:
    outcome = error
pickle.dump(outcome, sys.stdout.buffer)
"""


def _in_new_process(path: str, clusters: int, smoothness: float, options: dict[str, Any]) -> int:
    """Computes in a new process, because a forked process lacks the threads and devices of its parent."""
    search_path = os.pathsep.join(entry or os.getcwd() for entry in sys.path)
    done = subprocess.run(
        [sys.executable, "-c", _CHILD],
        input=pickle.dumps(((path, clusters, smoothness), options)),
        env={**os.environ, "PYTHONPATH": search_path},
        capture_output=True,
    )
    if done.returncode != 0:
        lines = done.stderr.decode(errors="replace").strip().splitlines()
        reason = lines[-1] if lines else f"exit code {done.returncode}"
        raise RuntimeError(f"the process that computes {path}.off failed: {reason}")
    outcome: int | Exception = pickle.loads(done.stdout)
    if isinstance(outcome, Exception):
        raise outcome
    return outcome
