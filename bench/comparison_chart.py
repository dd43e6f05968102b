#!/usr/bin/python3
"""Draws the chart of README.md: seconds and errors of CGAL, of a loop of Embree that only traces, and of asdf-vk.

    scripts/install-packages bench && cmake --preset develop && cmake --build --preset develop
    bench/comparison_chart.py [MESH] [-o CHART.png]

The mesh is a generated animal of 100,000 faces by default. Seconds are medians of asdfvk-bench-compare, which runs all
programs in turns. The times of CGAL's sdf_values and of Embree do not include reading the mesh. The time of asdf-vk is
the time of the whole process, including reading and writing. An error is the average difference from values with 300
rays per face (of the same definition), divided by the range of the values.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator, NullLocator

ROOT = pathlib.Path(__file__).resolve().parents[1]
SHARES = {"all": "all faces", "10%": "10 % of the faces", "1%": "1 % of the faces"}
OTHERS, OURS = "#8c8c8c", "#0072B2"  # Colours of Okabe and Ito 2008, Color Universal Design.


def values(program: pathlib.Path, mesh: str, *options: str) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "values.npy"
        subprocess.run([program, mesh, "--backend", "cpu", "--quiet", "--fields", "sdf", "-o", output, *options],
                       check=True)
        return np.load(output).astype(float)


def error(found: np.ndarray, truth: np.ndarray) -> float:
    return float(np.nanmean(np.abs(found - truth)) / (np.nanmax(truth) - np.nanmin(truth)))


def measure(build: pathlib.Path, mesh: str, run_count: int) -> dict:
    command = [build / "bench/asdfvk-bench-compare", mesh, "--json", "--runs", str(run_count), "--seeds",
               ",".join(SHARES)]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)


def rows(times: dict, program: pathlib.Path, mesh: str) -> list[tuple[str, float, float, str]]:
    """Returns name, seconds, error and colour of each bar."""
    by_share = {entry["seeds"]: entry for entry in times["seeds"]}
    if times["cgalSeconds"] is None or "Embree, fast" not in by_share["all"]["tracers"]:
        raise SystemExit("comparison_chart: the build has no CGAL or no Embree; scripts/install-packages bench")
    truth = values(program, mesh, "--seeds", "all", "--rays", "300", "--cone-rotation", "hashed")
    cgal = [values(program, mesh, "--definition", "cgal", "--rays", rays) for rays in ("30", "300")]
    full = error(values(program, mesh, "--seeds", "all"), truth)
    bars = [("CGAL, all faces", times["cgalSeconds"]["median"], error(*cgal), OTHERS),
            ("bare loop of Embree, all faces", by_share["all"]["tracers"]["Embree, fast"]["traceSeconds"]["median"],
             full, OTHERS)]
    for share, name in SHARES.items():
        [seconds] = [whole["seconds"]["median"] for whole in by_share[share]["whole"]
                     if whole["backend"] == "cpu" and whole["what"] == "process, file to file"]
        bars.append((f"asdf-vk, {name}", seconds, error(values(program, mesh, "--seeds", share), truth), OURS))
    return bars


def draw(bars: list[tuple[str, float, float, str]], title: str, output: pathlib.Path) -> None:
    plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 9})
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.2, 2.5), dpi=130, sharey=True,
                                         gridspec_kw={"width_ratios": (3, 2)})
    names, seconds, errors, colours = zip(*bars)
    left.barh(names, seconds, color=colours, height=0.66)
    left.invert_yaxis()
    left.set_xscale("log")
    left.set_xlim(min(seconds) / 2.5, max(seconds) * 4)
    left.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    left.xaxis.set_minor_locator(NullLocator())
    left.set_title("seconds, logarithmic", fontsize=9, loc="left")
    right.barh(names, [100 * value for value in errors], color=colours, height=0.66)
    right.set_xlim(0, 100 * max(errors) * 1.3)
    right.xaxis.set_major_locator(MaxNLocator(4))
    right.set_title("average error, % of the range", fontsize=9, loc="left")
    for row, (time, value) in enumerate(zip(seconds, errors)):
        left.text(time * 1.12, row, f"{time:.2g} s", va="center")
        right.text(100 * (value + 0.02 * max(errors)), row, f"{100 * value:.2g}", va="center")
    for axes in (left, right):
        axes.tick_params(axis="y", length=0)
        axes.tick_params(axis="x", labelsize=8)
        axes.spines[["top", "right", "left"]].set_visible(False)
    figure.suptitle(title, fontsize=9.5, x=0.01, ha="left", fontweight="bold")
    figure.tight_layout()
    figure.savefig(output)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="?")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "docs/pictures/comparison.png")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/develop")
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        mesh = arguments.mesh
        if mesh is None:
            mesh = f"{folder}/animal.ply"
            subprocess.run([arguments.build / "src/asdf-vk-generate", "animal", "--faces", "100000", "-o", mesh],
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        times = measure(arguments.build, mesh, arguments.runs)
        bars = rows(times, arguments.build / "src/asdf-vk", mesh)
    print(f"{times['processor']}, {times['threads']} threads, load average {times['loadAverage']}")
    for name, seconds, average, _ in bars:
        print(f"{name}: {seconds:.3g} s, error {average:.2%}; time of CGAL / this time: {bars[0][1] / seconds:.3g}")
    name = pathlib.Path(arguments.mesh).stem if arguments.mesh else "generated animal"
    busy = ", on a busy machine" if times["loadAverage"] > 2 * times["threads"] else ""
    draw(bars, f"{name}, {times['faceCount']:,} faces, {times['threads']} CPU threads{busy}", arguments.output)


if __name__ == "__main__":
    main()
