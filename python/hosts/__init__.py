"""Add-ons for other programs, one file each. `python3 -m asdf_vk.hosts` prints their paths."""

import numpy as np

VERDICTS = {"passed": "PASS", "failed": "FAIL", "notJudged": "NOT JUDGED"}
VIRIDIS = np.array(  # The colour map viridis as sRGB, at 0, 1/4, 1/2, 3/4 and 1.
    [(0.267, 0.005, 0.329), (0.229, 0.322, 0.546), (0.128, 0.567, 0.551), (0.369, 0.789, 0.383), (0.993, 0.906, 0.144)]
)


def digits_of(text_of, value, other) -> str:
    """Returns text_of(value, digits): four digits, or up to six to differ from the text of another number."""
    return text_of(value, next((n for n in (4, 5, 6) if text_of(value, n) != text_of(other, n)), 4))


def verdict_text(report, text_of) -> str:
    """Returns a text such as "FAIL, least wall 0.3 mm" or "PASS, next wall 1.2 mm". text_of(value): text of a length.

    The words wall, detail and edge have the meaning of docs/thickness.md.
    """
    verdict = VERDICTS[report.verdict]
    if np.isnan(report.min):
        return verdict
    place = f"least {report.regions[0].kind}" if report.verdict == "failed" else "next wall"
    return f"{verdict}, {place} {text_of(report.min)}"


def colours_of(values, low: float, high: float, thin, grey: float):
    """Returns (m, 3) sRGB colours: red if `thin`, grey without a value, else viridis from low to high."""
    colours = np.full((len(values), 3), grey)
    has_value = np.isfinite(values)
    shares = np.clip((values[has_value] - low) / max(high - low, 1e-30), 0, 1)
    stops = np.linspace(0, 1, len(VIRIDIS))
    colours[has_value] = np.stack([np.interp(shares, stops, channel) for channel in VIRIDIS.T], axis=1)
    colours[thin] = (0.85, 0.1, 0.1)
    return colours
