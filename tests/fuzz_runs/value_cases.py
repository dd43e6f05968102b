"""Cases about values. Each makes its inputs in a folder, runs asdf-vk and judges the values."""

from __future__ import annotations

import math
import pathlib
from collections.abc import Callable, Iterable

import options
import oracles
import results
import shapes
from case import BACKENDS, VALUE_FORMATS, Case
from program import RESULT_CODES, Ended

FORMATS = (*VALUE_FORMATS, "vtu", "html")
UNITS = (0.001, 25.4, 1000.0)
FLOAT_ROUNDING = 6e-8  # Rounding of coordinates, in diagonals.
# Options with which the backends are compared.
_COMPARABLE = options.only(
    options.COMPUTATION,
    *("--angle", "--cone-rotation", "--definition", "--orient", "--outlier-deviations"),
)
_OF_VALUES = tuple(o for o in options.COMPUTATION if o.name not in ("--fields", "--per"))
_NEUTRAL = options.only(options.NEUTRAL, "--threads", "--quiet", "--json", "--jobs", "--isolate")


def any_options(case: Case) -> None:
    """Any options with any values: codes, complete files, a report that agrees with the result."""
    rng = case.rng
    name = case.write(shapes.odd(case.program, rng, case.folder, 1500), "mesh.off")
    listed = rng.choice(("", "mesh.off\n", "absent.off\n", "mesh.off\0"))
    (case.folder / "list.txt").write_text(listed)
    output = "out." + rng.choice(FORMATS)
    illegal_share = rng.choice((0.0, 0.0, 0.2))
    chosen = options.random_options(rng, options.COMPUTATION, 6, illegal_share)
    chosen += options.random_options(rng, options.NEUTRAL, 3, illegal_share)
    ended = case.run(name, "-o", output, *chosen)
    path = case.folder / output
    has_result = path.is_file()
    if ended.code in RESULT_CODES and not has_result and not _needs_no_result(chosen):
        case.note([f"exit code {ended.code} without a result"], ended)
    if ended.code not in RESULT_CODES and has_result:
        case.note([f"exit code {ended.code} with a result"], ended)
    for file in case.folder.glob("*.*"):
        case.note([w for w in [results.sound(file)] if w and file.name != name], ended)
    _check_report(case, ended, path, chosen)


def _needs_no_result(chosen: list[str]) -> bool:
    skips = any(word.startswith(("--shard", "--skip-existing")) for word in chosen)
    return skips or bool(options.ANSWERS & set(chosen))


def _check_report(case: Case, ended: Ended, path: pathlib.Path, chosen: list[str]) -> None:
    text = " ".join(chosen)
    # Something else is on standard output, too.
    mixed = any(word in f" {text} " for word in ("=- ", " - ", *options.ANSWERS))
    reads_values = path.suffix in (".npz", ".csv") and path.is_file() and "vertex" not in text
    if ended.code not in RESULT_CODES or not reads_values:
        return
    fields = results.fields_of(path)
    for name in ("sdf", "thickness", "least_thickness", "error"):
        case.note([f"{name}: {w}" for w in oracles.possible_values(fields.get(name, []))], ended)
    if "--json" not in chosen or mixed:
        return
    reports, wrong = oracles.reports_of(ended.output)
    case.note(wrong, ended)
    if len(reports) == 1 and "fields" in reports[0]:
        case.note(oracles.report_agrees(reports[0], fields), ended)


def backends(case: Case) -> None:
    """The backends agree on every face, also where the mesh has defects."""
    rng = case.rng
    mesh = shapes.generated(case.program, rng, case.folder, 800)
    mesh = shapes.in_general_position(mesh, rng)
    if rng.random() < 0.4:
        changes = (shapes.opened, shapes.turned_over, shapes.repeated, shapes.reordered)
        mesh = rng.choice(changes)(mesh, rng)
    if rng.random() < 0.4:
        mesh = shapes.scaled(mesh, 10 ** rng.uniform(-12, 12))
    name = case.write(mesh, "mesh.off")
    chosen = options.random_options(rng, _COMPARABLE, 2)
    common = ("--seeds", "all", "--no-estimate", *chosen)
    arguments = [name, "-o", "reference.npy", "--backend", "reference", *common]
    reference = case.program.run(arguments, case.folder)
    case.note(oracles.ended_well(reference), reference)
    if reference.code != 0:  # The options exclude one another, or nothing can be computed.
        return
    expected = results.fields_of(case.folder / "reference.npy")["sdf"]
    for backend in ("cpu", "vulkan"):
        values = case.values(name, f"{backend}.npy", "--backend", backend, *common)
        if values:
            least = oracles.CHECKED_DIFFERENCE * mesh.diagonal()
            wrong = oracles.same_values(expected, values["sdf"], least)
            # Faces of open meshes without a value of their own are interpolated.
            near_meshes = (shapes.moved(mesh, rng, FLOAT_ROUNDING) for _ in range(5))
            if wrong and _hangs_on_rounding(
                case,
                near_meshes,
                ["--backend", "reference", *common],
                lambda near: oracles.same_values(expected, near["sdf"], least),
            ):
                continue
            case.note([f"reference and {backend}: {w}" for w in wrong])


def assembly(case: Case) -> None:
    """Parts that touch have the diameters of the same parts apart; copies of parts change no least thickness."""
    rng = case.rng
    crosses = rng.random() < 0.2
    arguments = ["assembly", "--rng-seed", str(rng.randrange(10**6))]
    arguments += ["--interpenetrate"] if crosses else []
    together = shapes.by_generator(case.program, arguments, case.folder)
    factor = 10 ** rng.uniform(-6, 6) if rng.random() < 0.3 else 1
    together = shapes.scaled(together, factor)
    names = [case.write(together, "together.off")]
    field = "least_thickness" if crosses else rng.choice(("sdf", "least_thickness"))
    if field == "sdf":
        arguments += ["--apart", str(round(rng.uniform(0.5, 5), 2))]
        apart = shapes.by_generator(case.program, arguments, case.folder)
        names.append(case.write(shapes.scaled(apart, factor), "apart.off"))
    else:  # The material is the union of the parts, so that it is the same with a second copy of each.
        names.append(case.write(shapes.doubled(together, rng), "doubled.off"))
    backend = rng.choice(BACKENDS)
    chosen = ["--backend", backend]
    chosen += ["--seeds", "all", "--no-estimate"] if field == "sdf" else ["--measure", "thickness"]
    both = [case.values(name, name.replace(".off", ".npz"), *chosen) for name in names]
    if both[0] is None or both[1] is None:
        return
    expected, actual = (values[field] for values in both)
    if field != "sdf":
        expected = [*expected, *expected]
    least = oracles.rounding(field, together.diagonal())
    wrong = oracles.same_values(expected, actual, least)
    case.note([f"{' and '.join(names)}, {field}, {backend}: {w}" for w in wrong])


def _hangs_on_rounding(
    case: Case,
    near_meshes: Iterable[shapes.Mesh],
    chosen: list[str],
    compare: Callable[[dict], list[str]],
) -> bool:
    """Whether the results of meshes that differ from the mesh in the last digits only differ, too."""
    for k, mesh in enumerate(near_meshes):
        near = case.values(case.write(mesh, f"near{k}.off"), f"near{k}.npz", *chosen)
        if near is not None and compare(near):
            return True
    return False


def units(case: Case) -> None:
    """Another unit: the same values times the unit, the same labels."""
    rng = case.rng
    mesh = shapes.generated(case.program, rng, case.folder, 1500)
    mesh = shapes.in_general_position(mesh, rng)
    factor = rng.choice(UNITS)
    names = (case.write(mesh, "unit.off"), case.write(shapes.scaled(mesh, factor), "other.off"))
    backend = rng.choice(BACKENDS if len(mesh.faces) < 500 else BACKENDS[:2])
    further = rng.choice(([], ["--measure", "thickness"], ["--seeds", "all"]))
    chosen = ["--backend", backend, "--segment", *further]
    first, second = (case.values(name, name.replace(".off", ".npz"), *chosen) for name in names)
    if first is None or second is None:
        return
    if first["seed"] != second["seed"]:
        case.note([f"seeds differ between units, {backend}"])
    near_units = [shapes.scaled(mesh, 1 + k * 1e-13) for k in range(1, 6)]
    agrees = True
    for field in ("sdf", "thickness", "least_thickness"):
        if field not in first:
            continue
        back = [value / factor for value in second[field]]
        least = oracles.rounding(field, mesh.diagonal())
        wrong = oracles.same_values(first[field], back, least)
        agrees = agrees and not wrong
        if field == "sdf" and wrong:  # Rounding may decide which hits predict a value.
            seeds = [i for i, seed in enumerate(first["seed"]) if seed]
            traced = [[values[i] for i in seeds] for values in (first[field], back)]
            if _hangs_on_rounding(
                case,
                near_units,
                chosen,
                lambda near: oracles.same_values(first["sdf"], near["sdf"], least),
            ):
                wrong = oracles.same_values(*traced, least)
        case.note([f"unit {factor:g}, {field}, {backend}: {w}" for w in wrong])
    wrong = oracles.same_labels(first["segment"], second["segment"]) if agrees else []
    if wrong and _hangs_on_rounding(
        case, near_units, chosen, lambda near: oracles.same_labels(first["segment"], near["segment"])
    ):
        return  # Equal costs, as of equal parts.
    case.note([f"unit {factor:g}, {backend}: {w}" for w in wrong])


def neutral_options(case: Case) -> None:
    """Threads, jobs, formats and reports change no value."""
    rng = case.rng
    name = case.write(shapes.odd(case.program, rng, case.folder, 1500), "mesh.off")
    chosen = options.random_options(rng, _OF_VALUES, 4)
    first = case.run(name, "-o", "first.npz", "--json", *chosen)
    _check_report(case, first, case.folder / "first.npz", ["--json", *chosen])
    expected = results.fields_of(case.folder / "first.npz") if first.code in RESULT_CODES else None
    for number in range(2):
        output = f"other{number}." + rng.choice(VALUE_FORMATS)
        neutral = options.random_options(rng, _NEUTRAL, 3)
        other = case.run(name, "-o", output, *chosen, *neutral)
        if other.code != first.code:
            case.note([f"exit code {other.code}, not {first.code}, by neutral options"], other)
        if expected is None or other.code not in RESULT_CODES:
            continue
        fields = results.fields_of(case.folder / output)
        if output.endswith("npy"):
            fields = {next(iter(expected)): fields["sdf"]}
        for field in expected.keys() & fields.keys():
            values = expected[field]
            if output.endswith("ply"):  # No value is 0 there.
                values = [0.0 if math.isnan(value) else value for value in values]
            case.note([f"{field}: {w}" for w in oracles.equal_values(values, fields[field])], other)
