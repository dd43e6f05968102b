"""Texts about a result, for pages and for reports in a notebook."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._report import Report


def summary_of(report: Report) -> list[tuple[str, str]]:
    """Returns the title and the value of each row of a table."""
    counts = {"faces": report.face_count, "vertices": report.vertex_count, "components": report.component_count}
    rows = [("Mesh", ", ".join(f"{name}: {count:,}" for name, count in counts.items()))]
    for title, values in (("Diameter", report.sdf), ("Thickness", report.thickness)):
        if values is not None and values.median == values.median:
            rows.append((title, f"{values.min:.4g} to {values.max:.4g}, median {values.median:.4g}"))
    if report.thickness is not None and report.thickness.verdict is not None:
        rows.append(("Verdict", f"{report.thickness.verdict}, limit {report.thickness.thinner_than:g}"))
    if report.segment_count is not None:
        rows.append(("Parts" if report.parts is not None else "Segments", f"{report.segment_count:,}"))
    if report.seed_count:
        rows.append(("Seeds", f"{report.seed_count:,} of {report.triangle_count:,} triangles"))
    estimate = report.estimated_error
    if estimate is not None:
        median = f"{100 * estimate.relative_median:.2g} % of the value in the median"
        rows.append(("Error", f"about {100 * estimate.average:.2g} % of the range on average, {median}"))
    return rows


def table_of(report: Report) -> str:
    rows = "".join(f"<tr><th>{html.escape(title)}</th><td>{html.escape(value)}</td></tr>"
                   for title, value in summary_of(report))
    return f"<table>{rows}</table>"


def texts_of(report: Report | None, name: str, label: str, face_count: int) -> dict[str, object]:
    """Returns the texts of a layer of a page. report: None if the result has no report."""
    summary, sentence = [("Mesh", f"faces: {face_count:,}")], ""
    warnings: list[str] = []
    defects: list[str] = []
    if report is not None:
        summary = summary_of(report)
        for warning in report.warnings:
            (defects if warning.code == "meshDefect" else warnings).append(warning.message)
        if report.estimated_error is not None:
            sentence = (
                "The values between the seeds are interpolated. Compared with rays from every face they are expected to "
                f"differ by {100 * report.estimated_error.average:.2f} % of the range of all values on average.")
    return {"name": name, "label": label, "summary": summary, "error_sentence": sentence, "warnings": warnings,
            "defects": defects}
