from __future__ import annotations

import html
import math
from dataclasses import dataclass, field, is_dataclass
from dataclasses import fields as dataclass_fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._report import Report


def _plain(value: Any) -> Any:
    if is_dataclass(value):
        return {member.name: _plain(getattr(value, member.name)) for member in dataclass_fields(value)}
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, tuple):
        return [_plain(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


@dataclass(frozen=True, eq=False)
class Info(Report):
    """Report and fields of a computation."""

    fields: dict[str, NDArray[Any]] = field(repr=False)
    """Fields per face: "sdf" float32, "seed" uint8 (1 if rays started at the face), "error" float32, and others."""
    vertex_fields: dict[str, NDArray[Any]] = field(repr=False)
    """Fields per vertex; empty without per="vertex"."""
    reversed_faces: NDArray[np.int64] = field(repr=False)
    """Ascending indices of the faces whose orientation was reversed."""
    _shown: _core.ShownReport = field(repr=False)

    def to_dict(self) -> dict[str, Any]:
        """Returns the report, without fields, in types that JSON has. Numbers that are not finite become None."""
        return {member.name: _plain(getattr(self, member.name)) for member in dataclass_fields(Report)}

    def _repr_html_(self) -> str:
        """Returns a table as HTML, which notebooks show."""
        rows = (f"<tr><th>{title}</th><td>{html.escape(text)}</td></tr>" for title, text in self._shown.summary)
        return f"<table>{''.join(rows)}</table>"

    @property
    def seed(self) -> NDArray[np.uint8]:
        """(m,): 1 if rays started at the face, else 0."""
        return self.fields["seed"]

    @property
    def error(self) -> NDArray[np.float32] | None:
        """(m,): expected error in the unit of the mesh. None without an error estimate."""
        return self.fields.get("error")

    @property
    def thin(self) -> NDArray[np.bool_]:
        """(m,): whether a point of the face is below 0.999 of the limit. All false without a limit."""
        report = self.thickness
        if report is None or report.thinner_than is None or not report.regions:
            # If the report has no thin region, values are below the limit only because of rounding.
            return np.zeros(self.face_count, bool)
        return self.fields["least_thickness"] < np.float32(0.999 * report.thinner_than)


def info_of(computed: _core.ComputedFields) -> Info:
    """Returns the report with the arrays of all fields."""

    def arrays(per_vertex: bool) -> dict[str, NDArray[Any]]:
        return {name: computed.array(name, per_vertex) for name in computed.names(per_vertex)}

    return Info(
        **vars(computed.report()),
        fields=arrays(False),
        vertex_fields=arrays(True),
        reversed_faces=computed.reversed_faces(),
        _shown=_core.ShownReport(computed),
    )
