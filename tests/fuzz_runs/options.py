"""Every option of asdf-vk, with legal and illegal values at random."""

from __future__ import annotations

import dataclasses
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


def _choice(name: str, *legal: str) -> Option:
    return Option(name, legal, ("", "x", legal[0] + "x", legal[0].upper()))


def _flag(name: str) -> Option:
    return Option(name, (), ())


# Options of the computation, by which values may change.
COMPUTATION = (
    _choice("--recipe", "paper", "balanced", "quality"),
    _choice("--definition", "paper", "cgal"),
    Option(
        "--seeds",
        ("1", "7", "1000000", "0.5%", "2%", "33.3%", "100%", "all"),
        ("0", "0%", "101%", "%", *_ILLEGAL_NUMBERS),
    ),
    Option(
        "--max-error",
        ("1%", "20%", "5%rel", "0.01%"),
        ("0%", "100%", "5", "%rel", *_ILLEGAL_NUMBERS),
    ),
    _choice("--orient", "keep", "auto", "flip"),
    _choice("--sampler", "random", "blue-noise", "farthest-point", "normal-space", "adaptive"),
    Option("--rng-seed", ("0", "1", "12345", "18446744073709551615")),
    _flag("--no-estimate"),
    Option(
        "--rays",
        ("1", "2", "7", "30", "31", "64", "300", "1024"),
        ("0", "1025", *_ILLEGAL_NUMBERS),
    ),
    Option("--angle", ("0.001", "1", "60", "120", "179.9"), ("0", "180", *_ILLEGAL_NUMBERS)),
    Option("--false-hit-angle", ("0", "45", "90", "180"), ("180.1", *_ILLEGAL_NUMBERS)),
    Option("--outlier-deviations", ("0.01", "1", "3", "1e9"), ("0", *_ILLEGAL_NUMBERS)),
    _choice("--cone-rotation", "fixed", "hashed"),
    Option(
        "--smooth",
        ("off", "auto", "1x1", "2x3", "4x100"),
        ("0x1", "5x1", "1x101", "1x", *_ILLEGAL_NUMBERS),
    ),
    _choice("--weights", "distance", "feature"),
    _choice("--guidance", "none", "curvature", "prediction"),
    Option("--pooling", ("0", "0.5", "1"), ("1.01", *_ILLEGAL_NUMBERS)),
    _choice("--solver", "auto", "cg", "jacobi", "cpu", "eigen"),
    Option("--tolerance", ("1e-1", "1e-4", "1e-12", "0.99"), ("0", "1", *_ILLEGAL_NUMBERS)),
    Option(
        "--max-iterations",
        ("1", "10", "20000", "4294967295"),
        ("0", "4294967296", *_ILLEGAL_NUMBERS),
    ),
    _choice("--postprocess", "none", "cgal"),
    Option("--segment", ("none", "parts", "cgal"), ("", "x", "Parts")),
    Option("--parts", ("1", "2", "5", "100"), ("0", "101", *_ILLEGAL_NUMBERS)),
    Option("--detail", ("0.1", "1", "10"), ("0", "10.1", *_ILLEGAL_NUMBERS)),
    Option("--clusters", ("2", "5", "100"), ("1", "101", *_ILLEGAL_NUMBERS)),
    Option("--smoothness", ("0", "0.26", "1000"), ("1001", *_ILLEGAL_NUMBERS)),
    _choice("--cgal-expansion", "all", "first"),
    _choice("--measure", "sdf", "thickness", "both"),
    Option("--thinner-than", ("1e-30", "0.1", "1", "1e30"), ("0", *_ILLEGAL_NUMBERS)),
    Option("--fail-if-thinner", ("1e-30", "0.1", "1", "1e30"), ("0", *_ILLEGAL_NUMBERS)),
    _flag("--allow-sharp-edges"),
    Option("--wall-angle", ("90.1", "120", "180"), ("90", "181", *_ILLEGAL_NUMBERS)),
    _choice("--per", "face", "vertex"),
    Option(
        "--fields",
        (
            "sdf", "seed", "sdf,seed", "error", "centre,sdf", "segment", "normalized,sdf",
            "thickness", "least_thickness,sdf,centre",
        ),
        ("", "x", "sdf,sdf", "sdf,", ","),
    ),
    _choice("--kernel", "auto", "seed", "ray", "packet"),
    _choice("--bvh", "auto", "wide", "binary"),
    _choice("--fetch", "auto", "texel", "storage"),
    _choice("--backend", "auto", "vulkan", "cpu", "reference"),
)
# Options that change neither values nor fields.
NEUTRAL = (
    Option("--threads", ("1", "2", "3", "8"), ("0", "1025", *_ILLEGAL_NUMBERS)),
    Option("--jobs", ("1", "2", "5"), ("0", *_ILLEGAL_NUMBERS)),
    _flag("--quiet"),
    _flag("--verbose"),
    _flag("--json"),
    Option("--check", ("", "1", "10", "all"), ("0", "-1", "x", "1.5"), joined=True),
    _flag("--isolate"),
    Option("--log", ("log.jsonl", "absent/log.jsonl"), ("", ".")),
    _flag("--skip-existing"),
    Option("--timeout", ("0.01", "100"), ("0", *_ILLEGAL_NUMBERS)),
    Option("--memory-limit", ("10M", "4G"), ("0", "4X", *_ILLEGAL_NUMBERS)),
    Option("--shard", ("1/1", "1/2", "2/2"), ("0/1", "3/2", "1/0", "1", *_ILLEGAL_NUMBERS)),
    Option("--picture", ("picture.png", "-"), ("", "picture.jpg", "absent/picture.png")),
    _choice(
        "--picture-of",
        "sdf", "seed", "error", "normalized", "segment", "thickness", "least_thickness",
    ),
    Option(
        "--picture-view",
        ("0,0", "30,18", "-360,90"),
        ("361,0", "0,91", "1", *_ILLEGAL_NUMBERS),
    ),
    _choice("--picture-up", "auto", "x", "y", "z", "-x", "-y", "-z"),
    Option("--points", ("points.ply", "-"), ("", "absent/points.ply")),
    _flag("--ascii"),
    Option(
        "--against",
        ("--seeds all", "--recipe paper --seeds 3", "--seeds", "-o x.ply", ""),
        ("--x",),
    ),
    _choice("--format", "ply", "vtu", "npy", "npz", "csv", "html"),
    Option("--device", ("0", "llvmpipe", "7", "absent"), ("", "-1")),
    _flag("--require-gpu"),
    _flag("--list-devices"),
    Option("--files-from", ("list.txt", "absent.txt", "-"), ("",)),
    _flag("--null"),
    _flag("--recursive"),
    _flag("--version"),
    Option("--time-budget", ("0.001", "0.1"), ("0", *_ILLEGAL_NUMBERS)),
)
# --output is given by each case; --open starts a browser; --device-report takes long.
LEFT_OUT = frozenset({"--output", "--open", "--device-report", "--help"})
# What other options need, without which a call is mostly refused.
_NEEDS = {
    "--parts": "--segment=parts",
    "--detail": "--segment=parts",
    "--clusters": "--segment=cgal",
    "--smoothness": "--segment=cgal",
    "--cgal-expansion": "--segment=cgal",
    "--wall-angle": "--measure=thickness",
    "--allow-sharp-edges": "--thinner-than=1",
    "--picture-of": "--picture=picture.png",
    "--picture-view": "--picture=picture.png",
    "--picture-up": "--picture=picture.png",
    "--pooling": "--guidance=prediction",
    "--null": "--files-from=list.txt",
}
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
