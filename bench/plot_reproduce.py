#!/usr/bin/env python3
"""Draws the tables of bench/reproduce: plot_reproduce.py FOLDER"""

import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLOURS = {"grid": "#1b6ca8", "quadtree": "#c05621", "every 10": "#2f855a", "skin": "#6b46c1"}
INK = "#222222"


def rows(path):
    """The rows of a table; lines that describe the machine begin with #."""
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def style(axes, xlabel, ylabel, title):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(xlabel)
    axes.set_ylabel(ylabel)
    axes.set_title(title, loc="left", fontsize=11, color=INK)
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def save(figure, path):
    figure.savefig(path, dpi=150, bbox_inches="tight")
    plt.close(figure)


def legend_beside(figure, axes, published):
    """Schemes by colour, and what the report has by a grey cross, to the right of all panels."""
    axes.plot([], [], color="#888888", marker="x", linewidth=1, label=published)
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="center left", bbox_to_anchor=(0.91, 0.5), frameon=False,
                  fontsize=9)


def speedup(folder):
    """Milliseconds a frame over the bodies, ours beside the report's program."""
    table = [r for r in rows(folder / "speedup.csv") if r["scene"] == "balanced"]
    figure, panels = plt.subplots(1, 2, figsize=(11.5, 4.6), sharey=True)
    for axes, law in zip(panels, ("baseline", "impulse")):
        for scheme in dict.fromkeys(r["scheme"] for r in table):
            of_scheme = [r for r in table if r["scheme"] == scheme and r["law"] == law]
            measured = [r for r in of_scheme if r["mean_ms"] != "-"]
            kind, resolver = scheme.split(", ")
            bodies = [int(r["bodies"]) for r in of_scheme]
            axes.plot([int(r["bodies"]) for r in measured],
                      [float(r["mean_ms"]) for r in measured], color=COLOURS[kind],
                      linestyle="-" if resolver == "cuda" else "--", marker="o", markersize=3.5,
                      label=scheme)
            program = [(n, float(r["report_program_ms"])) for n, r in zip(bodies, of_scheme)
                       if r["report_program_ms"] != "-"]
            if program:
                axes.plot(*zip(*program), color=COLOURS[kind], alpha=0.45, linewidth=1,
                          linestyle="-" if resolver == "cuda" else "--", marker="x", markersize=4)
        style(axes, "bodies", "ms a frame" if law == "baseline" else "",
              f"balanced scene, law {law}")
    legend_beside(figure, panels[0], "the report's program")
    save(figure, folder / "speedup.png")


def figure5(folder):
    """Figure 5 as it is drawn in the report: how many times faster than the sequential grid."""
    table = [r for r in rows(folder / "speedup.csv") if r["scene"] == "balanced"]
    figure, panels = plt.subplots(1, 2, figsize=(11.5, 4.6), sharey=True)
    for axes, law in zip(panels, ("baseline", "impulse")):
        for scheme in dict.fromkeys(r["scheme"] for r in table):
            kind, resolver = scheme.split(", ")
            line = "-" if resolver == "cuda" else "--"
            for column, look in (("speedup_over_grid", {"marker": "o", "label": scheme}),
                                 ("report_speedup", {"marker": "x", "alpha": 0.45})):
                points = [(int(r["bodies"]), float(r[column])) for r in table
                          if r["scheme"] == scheme and r["law"] == law and r[column] != "-"]
                if points:
                    axes.plot(*zip(*points), color=COLOURS[kind], linestyle=line, linewidth=1.2,
                              markersize=4, **look)
        style(axes, "bodies", "times faster than the sequential grid" if law == "baseline" else "",
              f"balanced scene, law {law}")
    legend_beside(figure, panels[0], "the report's figure 5")
    save(figure, folder / "figure5.png")


def cells(folder):
    """Figures 6 and 7: milliseconds a frame over the number of cells."""
    table = rows(folder / "cells.csv")
    reported = rows(folder / "report_cells.csv")
    figure, panels = plt.subplots(1, 2, figsize=(11.5, 4.6))
    for axes, scene in zip(panels, ("imbalanced", "balanced")):
        for scheme in ("grid", "quadtree", "every 10"):
            for thread, line in (("cell", "--"), ("body", "-")):
                points = sorted((int(r["cells"]), float(r["mean_ms"])) for r in table
                                if r["scene"] == scene and r["scheme"] == scheme
                                and r["thread_per"] == thread)
                if points:
                    axes.plot(*zip(*points), color=COLOURS[scheme], linestyle=line, marker="o",
                              markersize=3.5, label=f"{scheme}, a thread a {thread}")
            points = sorted((float(r["cells"]), float(r["report_ms"])) for r in reported
                            if r["scene"] == scene and r["scheme"] == scheme)
            axes.plot(*zip(*points), color=COLOURS[scheme], alpha=0.45, linewidth=1, marker="x",
                      markersize=4, label=f"{scheme}, in the report")
        style(axes, "cells", "ms a frame" if scene == "imbalanced" else "",
              f"{scene}, 1,700 bodies")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="center left", bbox_to_anchor=(0.91, 0.5), frameon=False,
                  fontsize=9)
    save(figure, folder / "cells.png")


def profile(folder):
    """Table 2: where the time of a frame goes."""
    table = [r for r in rows(folder / "profile.csv") if r["bodies"] == "20000"]
    if not table:
        return
    phases = list(dict.fromkeys(r["phase"] for r in table))
    bars = {}
    for partitioner in dict.fromkeys(r["partitioner"] for r in table):
        bars[partitioner.split("/")[-1].replace("=", " ")] = {
            r["phase"]: float(r["ms"]) for r in table if r["partitioner"] == partitioner}
    bars["report's program"] = {r["phase"]: float(r["report_program_ms"]) for r in table
                                if r["report_program_ms"] != "-"}
    palette = ["#a0aec0", "#1b6ca8", "#ecc94b", "#ed8936", "#2f855a", "#c53030", "#6b46c1"]
    figure, axes = plt.subplots(figsize=(9, 2.6))
    for row, (name, values) in enumerate(bars.items()):
        total = sum(values.values())
        left = 0.0
        for phase, colour in zip(phases, palette):
            share = 100 * values.get(phase, 0) / total
            axes.barh(row, share, left=left, color=colour, edgecolor="white", linewidth=0.8,
                      label=phase.replace("_", " ") if row == 0 else None)
            left += share
        axes.text(101, row, f"{total:.2f} ms", va="center", fontsize=9, color=INK)
    axes.set_yticks(range(len(bars)), list(bars))
    axes.invert_yaxis()
    axes.set_xlim(0, 100)
    axes.set_xlabel("percent of the phases shown")
    axes.set_title("20,000 bodies, balanced, cuda", loc="left", fontsize=11, color=INK)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.28), ncol=len(phases), frameon=False,
                fontsize=8.5, columnspacing=1.0, handlelength=1.0)
    save(figure, folder / "profile.png")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    speedup(folder)
    figure5(folder)
    if (folder / "cells.csv").exists():
        cells(folder)
    if (folder / "profile.csv").exists():
        profile(folder)


if __name__ == "__main__":
    main()
