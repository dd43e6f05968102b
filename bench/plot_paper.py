#!/usr/bin/python3
"""Makes plots (SVG and PNG) and a page, DIR/index.html, from the output of asdfvk-bench-paper.

    asdfvk-bench-paper horse.ply -o DIR && bench/plot_paper.py DIR

Needs python3-matplotlib. bench/paper/tables.h describes the CSV files.
"""
import argparse
import csv
import html
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

# Table 1 of the ASDF paper, for the paper's horse. Keys: percent of the faces. Values: average error and maximum error,
# divided by the range of the values.
PRINTED = {50: (.0099, .4022), 20: (.0198, .5054), 10: (.0272, .5292), 5: (.0374, .5538), 2: (.0575, .5374),
           1: (.0695, .5813)}
# Section 5 of the paper: the horse takes 60 s with all faces, and slightly more than 6 s with 10 % of the faces.
PRINTED_TIME_RATIO = 0.1

# Colours of Okabe and Ito 2008, Color Universal Design.
COLOURS = {"paper": "#D55E00", "balanced": "#0072B2", "quality": "#009E73"}
SEQUENCE = ["#0072B2", "#D55E00", "#009E73", "#B4548C", "#E69F00", "#56B4E9", "#222222"]
MARKERS = "osD^v"
# Colours of the bars in Figure 5 of the paper.
SHARE_COLOURS = {10: "#009E73", 20: "#D55E00", 50: "#0072B2"}

CAPTIONS = {
    1: "Seeds at 10 % of the faces (red) and the interpolated function, with recipe paper (random seeds) and balanced.",
    2: "|w SDF(p) - sum of w SDF(v)| over the neighbours v of each face p, w = 1 / distance of the barycentres.",
    3: "The function from 5 % of the faces and from all faces, on one colour scale. "
       f"The paper prints an average error of {PRINTED[5][0]} for its horse.",
    4: "The function from all faces and with 10 % seeds; the error that the balanced recipe expects without the full "
       "function; and the errors over the range of the full function. The colours end at the 98th percentile of the "
       f"errors of recipe paper. The paper prints an average error of {PRINTED[10][0]} and a maximum of "
       f"{PRINTED[10][1]} for its horse.",
    7: "Seeds of every sampler at 7 % of the faces, and the average error with the interpolation of each recipe.",
    8: "The balanced recipe at 10 % of the faces of every mesh; each mesh has its own colour scale, in its unit.",
}

STYLE = """
body { margin: 0 auto; padding: 2rem; max-width: 72rem; font: 16px/1.5 sans-serif; color: #222; }
h2 { margin-top: 2.5rem; border-top: 1px solid #ccc; padding-top: .7rem; }
table { border-collapse: collapse; font-size: .85rem; margin: 1rem 0; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .7rem; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child { text-align: left; }
.images { display: grid; grid-template-columns: repeat(3, 1fr); gap: 1rem; font-size: .85rem; text-align: center; }
.images.two { grid-template-columns: repeat(2, 1fr); }
img { width: 100%; }
"""


TEXT_COLUMNS = {"name", "value", "mesh", "recipe", "sampler", "file", "caption"}


def read(folder, name):
    """Returns the rows as dictionaries. An empty cell in a column of numbers becomes NaN."""
    with open(folder / name, newline="", encoding="utf-8") as file:
        return [{key: value if key in TEXT_COLUMNS else float(value or "nan") for key, value in row.items()}
                for row in csv.DictReader(file)]


def percentages(rows, column, below=101):
    """Returns points (percent, value). Leaves out rows whose share of seeds is `below` percent or more."""
    return [(row["percent"], row[column]) for row in rows if row["percent"] < below]


def recipe_series(rows, column, below=101):
    """Returns one series per recipe, in the form that save_plot() expects."""
    return [(recipe, percentages(select(rows, recipe=recipe), column, below), {"color": colour, "marker": marker})
            for (recipe, colour), marker in zip(COLOURS.items(), MARKERS)]


def select(rows, **wanted):
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def save_plot(folder, name, title, labels, series, scale="log", limits=None, categories=None):
    """Writes NAME.svg and NAME.png. series: (name, [(x, y)], options of Axes.plot). categories: labels of x."""
    figure, axes = plt.subplots(figsize=(5.6, 4), layout="constrained")
    for label, points, style in series:
        points = sorted(point for point in points if not math.isnan(point[1]))
        axes.plot([x for x, _ in points], [y for _, y in points], label=label, **style)
    axes.set(title=title, xlabel=labels[0], ylabel=labels[1])
    axes.set(xscale="linear" if categories else scale, yscale=scale)
    for axis in (axes.xaxis, axes.yaxis):
        if axis.get_scale() == "log":
            axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    if limits:
        axes.set_ylim(limits)
    if scale == "linear":
        axes.set_ylim(bottom=0)
    if categories:
        axes.set_xticks(range(len(categories)), categories, rotation=30, ha="right")
    axes.legend(frameon=False)
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None})
    figure.savefig(folder / f"{name}.png", dpi=150)
    plt.close(figure)
    return f"{name}.svg"


def table_plots(folder, rows, mesh, has_printed):
    """Plots Table 1 of a mesh as curves: errors against the full function, and errors against the truth."""
    labels = ("faces that cast rays, %", "average error / range")
    series = recipe_series(rows, "average_error", 100)
    if has_printed:
        series.append(("printed", [(percent, errors[0]) for percent, errors in PRINTED.items()],
                       {"color": "#222222", "linestyle": "--", "marker": "v"}))
    full = save_plot(folder, f"table1-{mesh}", f"{mesh}, against the full function", labels, series)
    series = recipe_series(rows, "truth_average_error")
    floor = select(rows, recipe="paper", percent=100)[0]["truth_average_error"]
    series.append(("full function", [(1, floor), (100, floor)], {"color": "#222222", "linestyle": "--"}))
    return [full, save_plot(folder, f"table1-{mesh}-truth", f"{mesh}, against the truth", labels, series)]


def error_plots(folder, rows, meshes):
    """Plots Figure 5: the average error by share of seeds, and by mesh as in the paper."""
    label = "average error / range"
    errors = [row["average_error"] for row in rows if row["percent"] < 100 and row["average_error"] > 0]
    limits = (min(errors) / 1.2, max(errors) * 1.2)
    images = []
    for recipe in ("paper", "balanced"):
        chosen = select(rows, recipe=recipe)
        series = [(mesh, percentages(select(chosen, mesh=mesh), "average_error", 100),
                   {"color": SEQUENCE[i % len(SEQUENCE)], "marker": MARKERS[i % len(MARKERS)]})
                  for i, mesh in enumerate(meshes)]
        images.append(save_plot(folder, f"figure5-{recipe}", recipe, ("faces that cast rays, %", label), series,
                                limits=limits))
    if len(meshes) == 1:
        return images
    for recipe in ("paper", "balanced"):
        series = [(f"{percent} %", [(i, select(rows, mesh=mesh, recipe=recipe, percent=percent)[0]["average_error"])
                                    for i, mesh in enumerate(meshes)], {"color": colour, "marker": "o", "linestyle": ""})
                  for percent, colour in SHARE_COLOURS.items()]
        images.append(save_plot(folder, f"figure5-{recipe}-by-mesh", recipe, ("", label), series, limits=limits,
                                categories=meshes))
    return images


def time_plots(folder, rows, mesh):
    """Plots Figure 6: seconds by number of seeds, and seconds divided by the seconds of the full trace."""
    stages = ("sample_seconds", "trace_seconds", "predict_seconds", "solve_seconds")
    series = [(recipe, [(row["seeds"], sum(row[stage] for stage in stages)) for row in select(rows, recipe=recipe)],
               {"color": colour, "marker": marker}) for (recipe, colour), marker in zip(COLOURS.items(), MARKERS)]
    seconds = save_plot(folder, f"figure6-{mesh}", f"{mesh}, sample + trace + predict + solve",
                        ("faces that cast rays", "seconds"), series, scale="linear")
    series = recipe_series(rows, "time_ratio")
    series.append(("proportional", [(1, .01), (100, 1)], {"color": "#222222", "linestyle": "--"}))
    return [seconds, save_plot(folder, f"figure6-{mesh}-ratio", f"{mesh}, time / time of the full trace",
                               ("faces that cast rays, %", "time ratio"), series)]


def error_table(rows, has_printed):
    """Returns the heads and the cells of Table 1 for a mesh."""
    heads, lines = ["faces"], []
    for error in ("average error", "maximum error", "average error against the truth"):
        heads += [f"{error}: {recipe}" for recipe in COLOURS]
    heads.append("estimated average error: balanced")
    if has_printed:
        heads += ["printed: average", "printed: maximum"]
    for percent in sorted({row["percent"] for row in rows}, reverse=True):
        recipes = [select(rows, percent=percent, recipe=recipe)[0] for recipe in COLOURS]
        columns = ("average_error", "maximum_error", "truth_average_error")
        cells = [recipe[column] for column in columns for recipe in recipes] + [recipes[1]["estimated_error"]]
        if has_printed:
            cells += PRINTED.get(percent, (math.nan, math.nan))
        lines.append([f"{percent:g} %"] + cells)
    return heads, lines


def summary_table(rows, meshes):
    """Returns a table with the average errors of every mesh with 10 % seeds, and the geometric means."""
    heads, lines, ratios = ["mesh"], [], []
    for against in ("full function", "truth"):
        heads += [f"against the {against}: {recipe}" for recipe in COLOURS]
    heads.append("against the full function: balanced / paper")
    for mesh in meshes:
        recipes = [select(rows, mesh=mesh, percent=10, recipe=recipe)[0] for recipe in COLOURS]
        ratios.append(recipes[1]["average_error"] / recipes[0]["average_error"])
        lines.append([mesh] + [recipe[column] for column in ("average_error", "truth_average_error")
                               for recipe in recipes] + [ratios[-1]])
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    return heads, lines + [["geometric mean"] + [math.nan] * (len(heads) - 2) + [mean]]


def table_html(heads, lines):
    def cell(value):
        if isinstance(value, float):
            value = "" if math.isnan(value) else f"{value:.4f}"
        return f"<td>{html.escape(value)}</td>"
    return ("<table><tr>" + "".join(f"<th>{html.escape(head)}</th>" for head in heads) + "</tr>\n" +
            "".join("<tr>" + "".join(map(cell, line)) + "</tr>\n" for line in lines) + "</table>\n")


def images_html(images, columns=""):
    """images: (file, caption)."""
    return (f'<div class="images {columns}">' + "".join(
        f'<div><a href="{file}"><img src="{file}" alt=""></a>{html.escape(caption)}</div>\n'
        for file, caption in images) + "</div>\n")


def page(folder):
    run, meshes = read(folder, "run.csv"), [row["mesh"] for row in read(folder, "meshes.csv")]
    errors, times = read(folder, "table1.csv"), read(folder, "figure6.csv")
    first = meshes[0]
    yield "<h1>The evaluation of the ASDF paper, repeated</h1>\n"
    yield table_html(["run", ""], [[row["name"], row["value"]] for row in run])
    yield "<h2>Table 1: errors by the share of the faces</h2>\n<p>Over the range of the full function (30 rays at " \
          "every face, fixed cones). The truth has many rays at every face and hashed cones; at 100 %, recipe paper " \
          "shows the error of the full function itself. The printed numbers are of the paper's horse.</p>\n"
    for mesh in meshes:
        rows, has_printed = select(errors, mesh=mesh), mesh == first
        yield f"<h3>{mesh}</h3>\n" + table_html(*error_table(rows, has_printed))
        yield images_html([(file, "") for file in table_plots(folder, rows, mesh, has_printed)], "two")
    yield "<h2>All meshes at 10 % of the faces: average errors</h2>\n" + table_html(*summary_table(errors, meshes))
    yield "<h2>Figure 5: error by the share of the faces</h2>\n"
    yield images_html([(file, "") for file in error_plots(folder, errors, meshes)], "two")
    yield "<h2>Figure 6: time by the share of the faces</h2>\n"
    yield images_html([(file, "") for file in time_plots(folder, select(times, mesh=first), first)], "two")
    yield f"<p>The paper prints a time ratio of about {PRINTED_TIME_RATIO:g} at 10 % of the faces.</p>\n"
    pictures = read(folder, "pictures.csv")
    for figure in sorted({int(row["figure"]) for row in pictures}):
        yield f"<h2>Figure {figure}</h2>\n<p>{CAPTIONS[figure]}</p>\n"
        images = [(row["file"], row["caption"]) for row in select(pictures, figure=figure)]
        yield images_html(images, "two" if len(images) in (1, 2, 4) else "")
        if (folder / f"figure{figure}.html").exists():
            yield f'<p><a href="figure{figure}.html">The meshes of figure {figure}, to turn and to pick values</a></p>\n'
        if figure == 7:
            samplers = read(folder, "figure7.csv")
            yield table_html(["sampler", "seeds", "average error: paper", "average error: balanced"],
                             [[row["sampler"], f"{row['seeds']:,.0f}", row["paper_average_error"],
                               row["balanced_average_error"]] for row in samplers])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", type=pathlib.Path, help="output folder of asdfvk-bench-paper")
    folder = parser.parse_args().folder
    plt.rcParams.update({"svg.hashsalt": "asdf-vk", "font.size": 9, "lines.markersize": 4, "axes.grid": True,
                         "grid.color": "#e4e4e4", "axes.spines.top": False, "axes.spines.right": False})
    body = "".join(page(folder))
    (folder / "index.html").write_text('<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>ASDF</title>\n'
                                       f"<style>{STYLE}</style>\n{body}</html>\n", encoding="utf-8")


if __name__ == "__main__":
    main()
