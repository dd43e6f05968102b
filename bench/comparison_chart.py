#!/usr/bin/python3
"""Draws a chart of seconds and errors: CGAL, a bare loop of Embree, and asdf-vk with all, 10 % and 1 % of the faces.

    bench/comparison_chart.py BUILD MESH -o chart.png     # BUILD: a folder such as build/develop

Seconds are medians of asdfvk-bench-compare: of CGAL and asdf-vk from file to file or from mesh to values, of Embree the
loop of rays alone. An error is the average over the faces, over the range, against the function of 300 rays per face by
the same definition. Needs python3-matplotlib and a build with CGAL and Embree.
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

SHARES = {"all": "all faces", "10%": "10 % of the faces", "1%": "1 % of the faces"}
OTHERS, OURS = "#9a9a9a", "#0072B2"  # Okabe and Ito 2008, Color Universal Design.


def values(program: pathlib.Path, mesh: str, *options: str) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "values.npy"
        subprocess.run([program, mesh, "--backend", "cpu", "--quiet", "--fields", "sdf", "-o", output, *options],
                       check=True)
        return np.load(output).astype(float)


def error(found: np.ndarray, truth: np.ndarray) -> float:
    return float(np.nanmean(np.abs(found - truth)) / (np.nanmax(truth) - np.nanmin(truth)))


def rows(build: pathlib.Path, mesh: str, run_count: int) -> list[tuple[str, float, float, str]]:
    """Name, seconds, error and colour of each bar."""
    line = subprocess.run([build / "bench/asdfvk-bench-compare", mesh, "--json", "--runs", str(run_count), "--seeds",
                           *SHARES], check=True, stdout=subprocess.PIPE, text=True).stdout
    times = json.loads(line)
    by_share = {entry["seeds"]: entry for entry in times["seeds"]}
    if times["cgalSeconds"] is None or "Embree, fast" not in by_share["all"]["tracers"]:
        raise SystemExit("comparison_chart: the build has no CGAL or no Embree; scripts/install-packages bench")
    program = build / "src/asdf-vk"
    truth = values(program, mesh, "--seeds", "all", "--rays", "300", "--cone-rotation", "hashed")
    cgal = [values(program, mesh, "--definition", "cgal", "--rays", rays) for rays in ("25", "300")]
    full = error(values(program, mesh, "--seeds", "all"), truth)
    bars = [("CGAL sdf_values, all faces", times["cgalSeconds"]["median"], error(*cgal), OTHERS),
            ("Embree, a bare loop of rays, all faces",
             by_share["all"]["tracers"]["Embree, fast"]["traceSeconds"]["median"], full, OTHERS)]
    for share, name in SHARES.items():
        [seconds] = [whole["seconds"]["median"] for whole in by_share[share]["whole"]
                     if whole["backend"] == "cpu" and whole["what"] == "process, file to file"]
        bars.append((f"asdf-vk, file to file, {name}", seconds, error(values(program, mesh, "--seeds", share), truth),
                     OURS))
    return bars


def draw(bars: list[tuple[str, float, float, str]], title: str, output: str) -> None:
    figure, axes = plt.subplots(figsize=(8, 2.6), dpi=110)
    names, seconds, errors, colours = zip(*bars)
    axes.barh(names, seconds, color=colours, height=0.7)
    axes.invert_yaxis()
    axes.set_xscale("log")
    axes.set_xlim(min(seconds) / 2, max(seconds) * 12)
    for row, (time, average) in enumerate(zip(seconds, errors)):
        axes.text(time * 1.1, row, f"{time:.2g} s, error {average:.1%}", va="center", fontsize=9)
    axes.set_title(title, fontsize=10, loc="left")
    axes.set_xlabel("seconds, logarithmic", fontsize=9)
    axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    figure.savefig(output)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("mesh")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    bars = rows(arguments.build, arguments.mesh, arguments.runs)
    for name, seconds, average, _ in bars:
        print(f"{name}: {seconds:.3g} s, error {average:.2%}")
    draw(bars, f"{pathlib.Path(arguments.mesh).stem}: seconds on a CPU, and average error over the range",
         arguments.output)


if __name__ == "__main__":
    main()
