"""The cases of tests/describe/option_cases.json. Python must give the same messages as the command line."""

from __future__ import annotations

import json
import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import asdf_vk
from asdf_vk import _core
from asdf_vk._keywords import SessionOptions
from shapes import cube

_CASES = json.loads((Path(__file__).resolve().parents[2] / "tests/describe/option_cases.json").read_text())
_KEYWORDS = {"rng-seed": "random_seed", "angle": "cone_angle", "cgal-expansion": "expansion"}


def keyword(name: str) -> str:
    return _KEYWORDS.get(name, name.replace("-", "_"))


def without_spelling(text: str) -> str:
    """Removes the differences of spelling: "--wall-angle 90" and "wall_angle='90'" become "wallangle 90"."""
    text = text.replace("--no-estimate", "estimate off").replace("estimate=False", "estimate off")
    for name, other in _KEYWORDS.items():
        text = re.sub(rf"--{name}\b(?!-)", other, text)
    return re.sub(r"[-_']", "", text.replace("=", " "))


@pytest.mark.parametrize("case", _CASES, ids=lambda case: json.dumps(case["options"]))
def test_sentences_are_those_of_the_command_line(case: dict[str, Any], reference: asdf_vk.Session) -> None:
    options = {keyword(name): value for name, value in case["options"].items()}
    if any(name.startswith("fail_if_") for name in options):
        pytest.skip("an option of the program")
    with pytest.raises(asdf_vk.UsageError) as error:
        if options.keys() <= SessionOptions.__annotations__.keys():
            asdf_vk.Session(**options)
        else:
            asdf_vk.compute(*cube(), session=reference, **options)
    assert without_spelling(str(error.value)) == without_spelling(case["refusal"])
    assert error.value.details["option"] in options or len(options) == 2


def test_every_option_has_a_case() -> None:
    cased = {keyword(name) for case in _CASES for name in case["options"]}
    named = {*_core.option_names(), *SessionOptions.__annotations__}
    assert named - cased == {"centres", "max_relative_error"}


def test_what_options_imply(reference: asdf_vk.Session) -> None:
    assert asdf_vk.compute(*cube(), session=reference, thinner_than=0.5).thickness is not None
    assert asdf_vk.shape_diameter(*cube(), session=reference, thinner_than=0.5).shape == (12,)
    segmented = asdf_vk.compute(*cube(), session=reference, segment="cgal", seeds="all", clusters=2)
    assert "normalized" in segmented.fields


def test_an_unknown_option_has_a_hint() -> None:
    hints = {
        "seed": "; did you mean seeds or random_seed?",
        "rng_seed": "; did you mean random_seed?",
        "cgal_expansion": "; did you mean expansion?",
        "bogus": "",
    }
    for name, hint in hints.items():
        with pytest.raises(asdf_vk.UsageError) as error:
            asdf_vk.shape_diameter(*cube(), **{name: 3})  # type: ignore[arg-type]
        assert str(error.value) == f"there is no option '{name}'{hint}"
    for name, hint in (("thread", "; did you mean threads?"), ("rng_seed", "")):
        with pytest.raises(asdf_vk.UsageError) as error:
            asdf_vk.Session(**{name: 3})  # type: ignore[arg-type]
        assert str(error.value) == f"there is no option '{name}'{hint}"


def test_a_removed_option_has_its_reason() -> None:
    with pytest.raises(asdf_vk.UsageError) as error:
        asdf_vk.compute(*cube(), thinner_than=0.5, allow_sharp_edges=True)  # type: ignore[call-arg]
    assert str(error.value) == (
        "allow_sharp_edges was removed: thin edges do not count any more; count_edges counts them"
    )


def test_a_number_of_parts_in_the_wrong_place_has_a_hint(reference: asdf_vk.Session) -> None:
    with pytest.raises(asdf_vk.UsageError) as error:
        asdf_vk.segment(*cube(), session=reference, segment=5)  # type: ignore[arg-type]
    assert str(error.value) == "segment=5 contradicts this function: parts=N sets the number of parts"
    with pytest.raises(asdf_vk.UsageError) as error:
        asdf_vk.segment(*cube(), session=reference, segment="cgal")
    assert str(error.value) == "segment='cgal' contradicts this function: method= selects the method"
    counts: list[Any] = [5, np.int32(5)]
    for count in counts:
        with pytest.raises(asdf_vk.ArrayTypeError) as wrong:
            asdf_vk.segment(SimpleNamespace(vertices=cube()[0], faces=cube()[1]), count)
        assert str(wrong.value) == "faces=5 is a number, not an array; parts=5 sets the number of parts"
