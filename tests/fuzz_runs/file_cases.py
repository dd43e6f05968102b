"""Cases about files: batches, signals, limits."""

from __future__ import annotations

import options
import oracles
import shapes
from case import BACKENDS, VALUE_FORMATS, Case
from program import RESULT_CODES, random_signals

_OF_BATCHES = options.only(
    options.COMPUTATION, "--recipe", "--seeds", "--backend", "--segment", "--measure"
)


def _batch(case: Case, count: int) -> list[str]:
    meshes = [shapes.odd(case.program, case.rng, case.folder, 800) for _ in range(count)]
    return [case.write(mesh, f"m{i}.off") for i, mesh in enumerate(meshes)]


def _results(case: Case, folder: str, suffix: str) -> dict[str, bytes]:
    return {p.name: p.read_bytes() for p in (case.folder / folder).glob("*.asdf." + suffix)}


def _compare(case: Case, expected: dict[str, bytes], found: dict[str, bytes], what: str) -> None:
    case.note([f"{what}: {w}" for w in oracles.same_results(expected, found)])


def order_of_batch(case: Case) -> None:
    """Another order, other jobs and worker processes give the same bytes."""
    rng = case.rng
    meshes = _batch(case, rng.randrange(2, 6))
    suffix = rng.choice(VALUE_FORMATS)
    chosen = ["--format", suffix, "--log", "log.jsonl"]
    chosen += options.random_options(rng, _OF_BATCHES, 2)
    first = case.run(*meshes, "-o", "first/", "--jobs", "1", *chosen)
    rng.shuffle(meshes)
    neutral = ["--jobs", rng.choice("123"), *rng.choice(([], ["--threads", "3"], ["--isolate"]))]
    second = case.run(*meshes, "-o", "second/", *neutral, *chosen)
    # The code of failed meshes is that of the first failure.
    if (first.code in RESULT_CODES) != (second.code in RESULT_CODES):
        case.note([f"exit code {second.code}, not {first.code}, in another order"], second)
    expected = _results(case, "first", suffix)
    _compare(case, expected, _results(case, "second", suffix), "batch in another order")


def killed(case: Case) -> None:
    """A signal at any moment: the old or the new result, and no partial file."""
    rng = case.rng
    name = case.write(shapes.odd(case.program, rng, case.folder, 1500), "mesh.off")
    output = "out." + rng.choice((*VALUE_FORMATS, "vtu"))
    path = case.folder / output
    chosen = ["--backend", rng.choice(BACKENDS[:2])]
    chosen += rng.choice(([], ["--segment"], ["--measure", "thickness"], ["--recipe", "quality"]))
    whole = case.run(name, "-o", output, *chosen)
    if whole.code not in RESULT_CODES:
        return
    new = path.read_bytes()
    old = b"an older result\n" if rng.random() < 0.7 else None
    for _ in range(3):
        if old is None:
            path.unlink(missing_ok=True)
        else:
            path.write_bytes(old)
        signals = random_signals(rng, whole.seconds)
        ended = case.program.run([name, "-o", output, *chosen], case.folder, signals)
        case.note(oracles.ended_well(ended), ended)
        case.note(oracles.no_partial_files(case.folder, ended), ended)
        result = path.read_bytes() if path.exists() else None
        case.note(oracles.old_or_new(result, old, new), ended)
        for part in case.folder.glob(".asdf-vk-*"):  # SIGKILL leaves such files.
            part.unlink()


def limited_files(case: Case) -> None:
    """A limit on the size of files, as a full disk: code 4, the old result, no partial file."""
    rng = case.rng
    name = case.write(shapes.odd(case.program, rng, case.folder, 1500), "mesh.off")
    output = "out." + rng.choice((*VALUE_FORMATS, "vtu"))
    arguments = [name, "-o", output, "--backend", "cpu", *rng.choice(([], ["--log", "log.jsonl"]))]
    whole = case.run(*arguments)
    if whole.code not in RESULT_CODES:
        return
    path = case.folder / output
    new, old = path.read_bytes(), b"old"
    path.write_bytes(old)
    limit = rng.randrange(len(old), len(new))
    ended = case.program.run(arguments, case.folder, file_limit=limit)
    case.note(oracles.ended_well(ended), ended)
    case.note(oracles.no_partial_files(case.folder, ended), ended)
    if ended.code != 4 or path.read_bytes() != old:
        case.note([f"exit code {ended.code}, result of {path.stat().st_size} bytes"], ended)


def resumed_batch(case: Case) -> None:
    """--skip-existing continues an interrupted batch to the results of an undisturbed one."""
    rng = case.rng
    meshes = _batch(case, rng.randrange(3, 7))
    suffix = rng.choice(VALUE_FORMATS)
    chosen = ["--format", suffix, "--backend", rng.choice(BACKENDS[:2]), "--jobs", rng.choice("12")]
    chosen += rng.choice(([], ["--isolate"]))
    whole = case.run(*meshes, "-o", "whole/", *chosen)
    resumed = [*meshes, "-o", "resumed/", *chosen, "--skip-existing", "--log", "log.jsonl"]
    for _ in range(rng.randrange(1, 3)):
        ended = case.program.run(resumed, case.folder, random_signals(rng, whole.seconds))
        case.note(oracles.ended_well(ended), ended)
        case.note(oracles.no_partial_files(case.folder / "resumed", ended), ended)
    last = case.run(*resumed)
    if (whole.code in RESULT_CODES) != (last.code in RESULT_CODES):
        case.note([f"exit code {last.code}, not {whole.code}, after a resume"], last)
    expected = _results(case, "whole", suffix)
    _compare(case, expected, _results(case, "resumed", suffix), "resumed batch")
