"""Every option of asdf-vk, with legal and illegal values at random."""

from __future__ import annotations

import dataclasses
import pathlib
import random
import re

Values = tuple[str, ...]
_ILLEGAL_NUMBERS = (
    *("-1", "nan", "inf", "1e999", "", "x", "0x10", "1e-400"),
    *("18446744073709551616", "1,5", " 1"),
)


@dataclasses.dataclass(frozen=True)
class Option:
    name: str
    legal: Values  # Empty: a flag.
    illegal: Values = _ILLEGAL_NUMBERS
    joined: bool = False  # The value only after an equals sign.


# --output is given by each case; --open starts a browser; --device-report takes long; --tar reads no meshes.
LEFT_OUT = frozenset({"--output", "--open", "--device-report", "--print-schema", "--help", "--tar", "--keep-members"})
# Values of options whose kind the tables do not tell, and those that keep runs short.
_VALUES: dict[str, tuple[Values, Values]] = {
    "--seeds": (
        ("1", "7", "1000000", "0.5%", "2%", "33.3%", "100%", "all"),
        ("0", "0%", "101%", "%", *_ILLEGAL_NUMBERS),
    ),
    "--max-error": (("1%", "20%", "5%rel", "0.01%"), ("0%", "100%", "5", "%rel", *_ILLEGAL_NUMBERS)),
    "--smooth": (("off", "auto", "1x1", "2x3", "4x100"), ("0x1", "5x1", "1x101", "1x", *_ILLEGAL_NUMBERS)),
    "--fields": (
        (
            "sdf", "seed", "sdf,seed", "error", "centre,sdf", "segment", "normalized,sdf",
            "thickness", "least_thickness,sdf,centre",
        ),
        ("", "x", "sdf,sdf", "sdf,", ","),
    ),
    "--threads": (("0", "1", "2", "8"), ("1025", *_ILLEGAL_NUMBERS)),
    "--jobs": (("1", "2", "5"), ("0", *_ILLEGAL_NUMBERS)),
    "--check": (("", "1", "10", "all"), ("0", "-1", "x", "1.5")),
    "--log": (("log.jsonl", "absent/log.jsonl"), ("", ".")),
    "--timeout": (("0.01", "100"), ("0", *_ILLEGAL_NUMBERS)),
    "--max-faces": (("0", "10", "100000"), _ILLEGAL_NUMBERS),
    "--memory-limit": (("10M", "4G"), ("0", "4X", *_ILLEGAL_NUMBERS)),
    "--shard": (("1/1", "1/2", "2/2"), ("0/1", "3/2", "1/0", "1", "auto", "auto/0", *_ILLEGAL_NUMBERS)),
    "--picture": (("picture.png", "-", "pictures/"), ("", "picture.jpg", "absent/picture.png")),
    "--picture-view": (("0,0", "30,18", "-360,90"), ("361,0", "0,91", "1", *_ILLEGAL_NUMBERS)),
    "--limits": (("limits.json", "absent.json"), ("", "mesh.off")),
    "--baseline": (("baseline.json", "absent/baseline.json"), ("",)),
    "--report": (("report.xml", "-"), ("", "absent/report.xml")),
    "--points": (("points.ply", "-"), ("", "absent/points.ply")),
    "--device": (("0", "llvmpipe", "7", "absent"), ("", "-1")),
    "--with": (("mesh.off", "absent.off"), ("", "-")),
    "--compare": (("mesh.off", "absent.off"), ("", "-")),
    "--files-from": (("list.txt", "absent.txt", "-"), ("",)),
}
_ROW = re.compile(
    r"^\| `(?:-\w`, `)?(--[a-z-]+)(.*?)` \| .*? \| (-|from .*?|above .*?) \| (.*) \|$"
)


def _values_in(range_text: str, is_whole: bool) -> tuple[Values, Values]:
    """Values at the bounds and far inside; values beyond them."""
    least = re.search(r"(from|above) ([\d.]+)", range_text)
    most = re.search(r"(to|at most|below) ([\d.]+)", range_text)
    assert least
    if not most and not is_whole:
        return ("1e-3", "0.1", "1", "1e9"), (least[2], *_ILLEGAL_NUMBERS)
    low, high = float(least[2]), float(most[2]) if most else 1e9
    step = 1.0 if is_whole else (high - low) * 1e-3
    legal = [low if least[1] == "from" else low + step, low + 2 * step, (low + high) / 2]
    illegal = [low if least[1] == "above" else low - step]
    if most:
        legal.append(high - step if most[1] == "below" else high)
        illegal.append(high if most[1] == "below" else high + step)
    form = (lambda x: str(int(x))) if is_whole else (lambda x: f"{x:.12g}")
    return tuple(map(form, legal)), (*map(form, illegal), *_ILLEGAL_NUMBERS)


def _option(name: str, placeholder: str, range_text: str) -> Option:
    alternatives = tuple(placeholder.strip().replace("\\", "").split("|"))
    if name in _VALUES:
        return Option(name, *_VALUES[name], joined=placeholder.startswith("["))
    if not placeholder:
        return Option(name, (), ())
    if range_text != "-":
        return Option(name, *_values_in(range_text, placeholder.strip() in ("N", "K")))
    assert len(alternatives) > 1, name
    return Option(name, alternatives, ("", "x", alternatives[0] + "x", alternatives[0].upper()))


def _options_by_section() -> dict[str, list[tuple[Option, str]]]:
    """The rows of docs/options.md, which a test compares with the program: options, and what they need."""
    sections: dict[str, list[tuple[Option, str]]] = {}
    section = ""
    for line in (pathlib.Path(__file__).parents[2] / "docs/options.md").read_text().splitlines():
        if line.startswith("<!-- options of "):
            section = line.removeprefix("<!-- options of ").removesuffix(" -->")
        elif line.startswith("<!-- end"):
            section = ""
        elif section and (row := _ROW.match(line)) and row[1] not in LEFT_OUT:
            needs = re.search(r"Needs `(.*?)`", row[4])
            sections.setdefault(section, []).append((_option(row[1], row[2], row[3]), needs[1] if needs else ""))
    return sections


_ROWS = _options_by_section()
_SECTIONS_OF_VALUES = ("Seeds and rays", "Segments", "Thickness", "Experiments")
_OF_VALUES = {"--per", "--fields", "--orient", "--backend"}
_WHOLE = {"--thinner-than": "--thinner-than=1", "--picture": "--picture=picture.png", "--files-from": "--files-from=list.txt"}
# What other options need, without which a call is mostly refused.
_NEEDS = {
    option.name: _WHOLE.get(needs, needs.replace(" ", "=")) for rows in _ROWS.values() for option, needs in rows if needs
} | {"--pooling": "--guidance=prediction"}
# Options of the computation, by which values may change.
COMPUTATION = tuple(
    option
    for section, rows in _ROWS.items()
    for option, _ in rows
    if (section in _SECTIONS_OF_VALUES or option.name in _OF_VALUES)
)
# Options that change neither values nor fields.
NEUTRAL = (
    *(option for rows in _ROWS.values() for option, _ in rows if option not in COMPUTATION),
    Option("--version", (), ()),
)
_NEEDS_SHARE = 0.9
# They end the program before the computation.
ANSWERS = frozenset({"--version", "--list-devices"})


def names_in_help(text: str) -> set[str]:
    """Long names of the options in --help=all."""
    return set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", text, re.MULTILINE))


def missing_in_tables(text: str) -> set[str]:
    """Options that only one of --help=all and this file has."""
    return names_in_help(text) ^ ({o.name for o in COMPUTATION + NEUTRAL} | LEFT_OUT)


def arguments(option: Option, rng: random.Random, illegal_share: float) -> list[str]:
    if not option.legal:
        return [option.name]
    is_illegal = option.illegal and rng.random() < illegal_share
    value = rng.choice(option.illegal if is_illegal else option.legal)
    if option.joined:
        return [option.name + ("=" + value if value else "")]
    return [f"{option.name}={value}"] if rng.random() < 0.3 else [option.name, value]


def random_options(
    rng: random.Random, table: tuple[Option, ...], most: int, illegal_share: float = 0.0
) -> list[str]:
    chosen = rng.sample(table, rng.randrange(most + 1))
    needs = {_NEEDS[o.name] for o in chosen if o.name in _NEEDS and rng.random() < _NEEDS_SHARE}
    names = {option.name for option in chosen}
    words = [word for option in chosen for word in arguments(option, rng, illegal_share)]
    return words + [need for need in sorted(needs) if need.split("=")[0] not in names]


def only(table: tuple[Option, ...], *names: str) -> tuple[Option, ...]:
    return tuple(option for option in table if option.name in names)
