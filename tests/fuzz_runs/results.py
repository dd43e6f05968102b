"""Values of result files, by the formats of docs/formats.md."""

from __future__ import annotations

import array
import ast
import csv
import io
import math
import pathlib
import struct
import zipfile

# What readers of a broken file may raise.
_UNREADABLE = (ValueError, KeyError, SyntaxError, OverflowError, struct.error, zipfile.BadZipFile)
_CODES = {"<f4": "f", "|u1": "B", "<u4": "I"}
_PLY_CODES = {"float": "f", "double": "d", "uchar": "B", "int": "i", "uint": "I"}


def of_npy(data: bytes) -> list[float]:
    if data[:6] != b"\x93NUMPY":
        raise ValueError("no npy file")
    (length,) = struct.unpack_from("<H", data, 8)
    header = ast.literal_eval(data[10 : 10 + length].decode())
    values = array.array(_CODES[header["descr"]])
    values.frombytes(data[10 + length :])
    if len(values) != math.prod(header["shape"]):
        raise ValueError(f"{len(values)} values in a shape {header['shape']}")
    return list(values)


def of_npz(data: bytes) -> dict[str, list[float]]:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        if archive.testzip() is not None:
            raise ValueError("a wrong checksum")
        return {n.removesuffix(".npy"): of_npy(archive.read(n)) for n in archive.namelist()}


def of_csv(data: bytes) -> dict[str, list[float]]:
    names, *rows = csv.reader(io.StringIO(data.decode()))
    if any(len(row) != len(names) for row in rows):
        raise ValueError("rows of different lengths")
    return {name: [_as_float32(row[i]) for row in rows] for i, name in enumerate(names)}


def _as_float32(text: str) -> float:
    """Numbers are the shortest ones that read back the same float."""
    return struct.unpack("f", struct.pack("f", float(text)))[0]


def of_ply(data: bytes) -> dict[str, list[float]]:
    """Properties of the faces; those without a value are 0. Binary files of triangles only."""
    header, body = data.split(b"end_header\n", 1)
    elements: dict[str, list[tuple[str, str]]] = {}
    counts: dict[str, int] = {}
    for line in header.decode().split("\n"):
        words = line.split()
        if words[:1] == ["element"]:
            counts[words[1]] = int(words[2])
            elements[words[1]] = properties = []
        elif words[:1] == ["property"]:
            properties.append((words[-1], words[1]))
    vertex = struct.Struct("<" + "".join(_PLY_CODES[kind] for _, kind in elements["vertex"]))
    faces = elements["face"]
    codes = ("B3i" if kind == "list" else _PLY_CODES[kind] for _, kind in faces)
    face = struct.Struct("<" + "".join(codes))
    start = vertex.size * counts["vertex"]
    if len(body) != start + face.size * counts["face"]:
        raise ValueError("the size does not fit the header")
    names = [n for name, kind in faces for n in ([""] * 4 if kind == "list" else [name])]
    columns = list(zip(*face.iter_unpack(body[start:])))
    return {name: list(columns[i]) for i, name in enumerate(names) if name}


def fields_of(path: pathlib.Path) -> dict[str, list[float]]:
    """Fields of the faces in the file. The field of an .npy is `sdf` here."""
    data = path.read_bytes()
    if path.suffix == ".npy":
        return {"sdf": of_npy(data)}
    return {".npz": of_npz, ".csv": of_csv, ".ply": of_ply}[path.suffix](data)


def sound(path: pathlib.Path) -> str:
    """What is wrong with the form of a complete file; empty: nothing."""
    data = path.read_bytes()
    try:
        if path.suffix in (".npy", ".npz", ".csv"):
            fields_of(path)
        elif path.suffix == ".ply":
            if not data.startswith(b"ply\n"):
                return "no ply header"
        elif path.suffix == ".vtu" and not data.rstrip().endswith(b"</VTKFile>"):
            return "no end of the vtu"
        elif path.suffix == ".html" and not data.rstrip().endswith(b"</html>"):
            return "no end of the page"
        elif path.suffix == ".png" and not data.endswith(b"IEND\xaeB`\x82"):
            return "no end of the picture"
    except _UNREADABLE as error:
        return f"{path.suffix} not readable: {error}"
    return ""
