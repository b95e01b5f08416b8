#!/usr/bin/env python3
"""Draws the figures of the report on speed and error from its tables, and writes report.md."""

import argparse
import csv
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)
from matplotlib.lines import Line2D  # noqa: E402

# Okabe and Ito's colours, which colour-blind readers can tell apart; markers differ as well.
LAWS = {
    "baseline": ("#D55E00", "s"),
    "impulse": ("#0072B2", "o"),
    "continuous": ("#009E73", "D"),
}
SCENE_STYLES = [
    ("#0072B2", "o"),
    ("#E69F00", "s"),
    ("#009E73", "D"),
    ("#CC79A7", "^"),
    ("#555555", "v"),
]
ERRORS = [
    ("missed", "missed collisions (1 - recall)"),
    ("wrong", "wrong bodies (fraction)"),
    ("bias", "|collision rate bias|"),
]
COST = "ns per body and simulated second"


def read(folder, part):
    """The rows of a table, and the lines that describe the machine."""
    with open(folder / f"{part}.csv", encoding="utf-8") as file:
        lines = file.read().splitlines()
    about = [line[2:] for line in lines if line.startswith("# ")]
    return list(csv.DictReader(line for line in lines if not line.startswith("# "))), about


def points_of(errors, speeds):
    """A point for each scene, law, precision and dt: errors, and the cost on the fastest complete
    partitioner (for `baseline`, whose answer depends on it: on the quadtree)."""
    cost = {}
    for row in speeds:
        if row["law"] == "baseline" and not row["partitioner"].startswith("quadtree"):
            continue
        key = (row["scene"], row["law"], row["precision"], row["dt"])
        found = (float(row["ns_per_body_second"]), row["partitioner"])
        cost[key] = min(cost.get(key, found), found)
    points = []
    for row in errors:
        key = (row["scene"], row["law"], row["precision"], row["dt"])
        bias = math.inf if row["rate_bias"] == "-" else abs(float(row["rate_bias"]))
        points.append(
            {
                "scene": row["scene"],
                "law": row["law"],
                "precision": row["precision"],
                "dt": row["dt"],
                "rate": int(row["dt"].split("/")[1]),
                "cost": cost[key][0],
                "partitioner": cost[key][1],
                # From the counts: a rounded recall of 1 would hide the last misses.
                "missed": 1 - int(row["matched_collisions"]) / max(int(row["exact_collisions"]), 1),
                "wrong": float(row["wrong_body_fraction"]),
                "bias": bias,
            }
        )
    return points


def mark_pareto(points, error):
    """Those that no other point beats in cost and error; of equals, one is enough."""
    front = set()
    best = math.inf
    for index in sorted(range(len(points)), key=lambda i: (points[i]["cost"], points[i][error])):
        if points[index][error] < best:
            best = points[index][error]
            front.add(index)
    return front


def zero_strip(axis, values):
    """A logarithmic y axis with a strip for exact zeros below it; returns where zero is drawn."""
    positive = [v for v in values if v > 0 and math.isfinite(v)]
    top = max(positive, default=1.0)
    low = 10.0 ** math.floor(math.log10(min(positive, default=0.1)))
    high = 10.0 ** math.ceil(math.log10(top) + 0.05)
    decades = max(round(math.log10(high / low)), 1)
    zero = low / 10 ** (0.13 * decades)
    edge = low / 10 ** (0.06 * decades)
    axis.set_yscale("log")
    axis.set_ylim(zero / 10 ** (0.1 * decades), high * 10 ** (0.04 * decades))
    ticks = [low * 10**k for k in range(decades + 1)]
    axis.set_yticks([zero] + ticks)
    axis.set_yticklabels(["0"] + [f"$10^{{{round(math.log10(t))}}}$" for t in ticks])
    axis.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    axis.axhspan(axis.get_ylim()[0], edge, color="#eeeeee", zorder=0)
    axis.axhline(edge, color="#999999", linewidth=0.8)
    return zero


def finish(axis):
    axis.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axis.set_axisbelow(True)
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)


def label_steps(axis, points, error, zero):
    """Names the longest and the shortest dt of a law. Each law has its labels on another side of its
    points, those of both precisions, so that labels and points of neighbours stay apart."""
    points = [p for p in points if math.isfinite(p[error])]
    rates = sorted({p["rate"] for p in points})
    ends = []
    for rate in dict.fromkeys((rates[0], rates[-1])) if rates else ():
        pair = [p for p in points if p["rate"] == rate]
        ends.append((min(p["cost"] for p in pair), max(p["cost"] for p in pair), pair[0]))
    ends.sort(key=lambda end: end[0] * end[1])
    for place, (left, right, point) in enumerate(ends):
        law = point["law"]
        if law == "baseline":
            x, style = right, {"xytext": (9, 3), "ha": "left", "va": "center"}
        elif law == "impulse":
            x, style = left, {"xytext": (-9, -4), "ha": "right", "va": "center"}
        else:
            x = math.sqrt(left * right)
            style = {"xytext": (0, -8), "ha": "left" if place else "right", "va": "top"}
        axis.annotate(
            point["dt"], (x, point[error] if point[error] > 0 else zero), fontsize=8,
            textcoords="offset points", color=LAWS[law][0], zorder=5, **style,
        )


def draw_scene(points, scene, horizon, path):
    fig, axes = plt.subplots(1, len(ERRORS), figsize=(12, 4.6), sharex=True)
    for axis, (error, label) in zip(axes, ERRORS):
        zero = zero_strip(axis, [p[error] for p in points])
        front = mark_pareto(points, error)
        for law, (colour, marker) in LAWS.items():
            for precision, face in (("double", colour), ("float", "white")):
                series = sorted(
                    (i for i, p in enumerate(points) if p["law"] == law and p["precision"] == precision),
                    key=lambda i: points[i]["rate"],
                )
                series = [i for i in series if math.isfinite(points[i][error])]
                if not series:
                    continue
                x = [points[i]["cost"] for i in series]
                y = [points[i][error] if points[i][error] > 0 else zero for i in series]
                axis.plot(
                    x, y, color=colour, marker=marker, markersize=6, markerfacecolor=face,
                    linewidth=1, linestyle="-" if precision == "double" else ":", zorder=3,
                )
        for law in LAWS:
            label_steps(axis, [p for p in points if p["law"] == law], error, zero)
        for i in front:
            p = points[i]
            axis.plot(
                p["cost"], p[error] if p[error] > 0 else zero, marker="o", markersize=13,
                markerfacecolor="none", markeredgecolor="black", markeredgewidth=1.2,
                linestyle="none", zorder=4,
            )
        axis.set_xscale("log")
        axis.margins(x=0.2)
        axis.set_xlabel(COST)
        axis.set_ylabel(label)
        finish(axis)
    handles = [
        Line2D([], [], color=c, marker=m, linewidth=1, label=law) for law, (c, m) in LAWS.items()
    ]
    handles += [
        Line2D([], [], color="#444444", marker="o", linewidth=1, label="double"),
        Line2D([], [], color="#444444", marker="o", markerfacecolor="white", linestyle=":", label="float"),
        Line2D([], [], color="black", marker="o", markersize=11, markerfacecolor="none",
               linestyle="none", label="Pareto front"),
    ]
    fig.suptitle(f"{scene}: cost against error over {float(horizon):.3g} s; labels are dt in s", fontsize=12)
    fig.legend(handles=handles, loc="lower center", ncol=len(handles), frameon=False)
    fig.tight_layout(rect=(0, 0.07, 1, 1))
    save(fig, path)


def draw_policies(rows, path):
    policies = list(dict.fromkeys(row["rebuild"] for row in rows))
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    fig, (missed, cost) = plt.subplots(1, 2, figsize=(11, 4.4))
    zero = zero_strip(missed, [float(row["missed_fraction"]) for row in rows])
    for scene, (colour, marker) in zip(scenes, SCENE_STYLES):
        series = {row["rebuild"]: row for row in rows if row["scene"] == scene}
        fractions = [float(series[p]["missed_fraction"]) for p in policies]
        style = {"color": colour, "marker": marker, "markersize": 6, "linewidth": 1}
        x = range(len(policies))
        missed.plot(x, [f if f > 0 else zero for f in fractions], label=scene, clip_on=False, **style)
        cost.plot(x, [float(series[p]["ns_per_body_step"]) for p in policies], **style)
    cost.set_yscale("log")
    cost.yaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    cost.yaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: f"{v:g}"))
    cost.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    missed.set_ylabel("missed pairs (fraction of overlapping pairs)")
    cost.set_ylabel("ns per body and step")
    for axis in (missed, cost):
        axis.set_xticks(range(len(policies)))
        axis.set_xticklabels([p.replace("every=", "") for p in policies])
        axis.set_xlabel("semi-static tree: with a skin, or rebuilt every K steps without one")
        finish(axis)
    fig.suptitle("The report's rebuild policy beside the skin (law impulse, dt 1/60 s)", fontsize=12)
    fig.legend(loc="lower center", ncol=len(scenes), frameon=False)
    fig.tight_layout(rect=(0, 0.07, 1, 1))
    save(fig, path)


def save(fig, path):
    for suffix in (".svg", ".png"):
        fig.savefig(path.with_suffix(suffix), dpi=110, metadata={"Date": None} if suffix == ".svg" else None)
    plt.close(fig)


def number(value):
    return "0" if value == 0 else f"{value:.3g}"


def write_report(folder, points, speeds, policies, features, about, horizons):
    out = ["# Speed against error", ""]
    out += [f"- {line}" for line in about if ": " in line and not line.startswith("load")]
    out += ["", "Cost is that of the fastest complete partitioner (`baseline`: of the quadtree). "
            "A `*` stands on the Pareto front: nothing is both cheaper and better.", ""]
    for scene, horizon in horizons.items():
        mine = [p for p in points if p["scene"] == scene]
        fronts = {error: mark_pareto(mine, error) for error, _ in ERRORS}
        out += [f"## {scene}", "", f"Over {float(horizon):.3g} s. ![cost against error]({scene}.svg)", "",
                "| law | precision | dt, s | partitioner | " + COST +
                " | missed | wrong bodies | rate bias (size) |", "|---|---|---|---|---|---|---|---|"]
        for i, p in enumerate(mine):
            cells = [number(p[e]) + (" *" if i in fronts[e] else "") for e, _ in ERRORS]
            out.append(f"| {p['law']} | {p['precision']} | {p['dt']} | {p['partitioner']} | "
                       f"{p['cost']:.0f} | " + " | ".join(cells) + " |")
        out.append("")
    out += ["## Partitioners", "", "ns per body and step at 1/60 s, double.", ""]
    specs = list(dict.fromkeys(row["partitioner"] for row in speeds))
    out += ["| scene | law | " + " | ".join(specs) + " |", "|---|---|" + "---|" * len(specs)]
    for scene in dict.fromkeys(row["scene"] for row in speeds):
        for law in LAWS:
            cells = [next((r["ns_per_body_step"] for r in speeds
                           if (r["scene"], r["law"], r["precision"], r["dt"], r["partitioner"])
                           == (scene, law, "double", "1/60", spec)), "-") for spec in specs]
            out.append(f"| {scene} | {law} | " + " | ".join(cells) + " |")
    out += ["", "## Rebuild policies", "", "![missed pairs and cost](policies.svg)", "",
            "| scene | rebuild | ns per body and step | missed pairs | of overlapping |",
            "|---|---|---|---|---|"]
    for row in policies:
        out.append(f"| {row['scene']} | {row['rebuild']} | {row['ns_per_body_step']} | "
                   f"{row['missed_pairs']} | {row['overlapping_pairs']} |")
    out += ["", "## What features cost", "", "| scene | law | bodies | bytes per body | ns per body "
            "and step | over equal squares | contacts per body and step |", "|---|---|---|---|---|---|---|"]
    for row in features:
        out.append("| " + " | ".join(row[k] for k in ("scene", "law", "bodies", "bytes_per_body",
                   "ns_per_body_step", "over_base", "contacts_per_body_step")) + " |")
    (folder / "report.md").write_text("\n".join(out) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="where quadrille_bench_report wrote")
    folder = parser.parse_args().folder
    try:
        errors, about = read(folder, "errors")
        speeds, _ = read(folder, "speeds")
        policies, _ = read(folder, "policies")
        features, _ = read(folder, "features")
    except OSError as error:
        sys.exit(f"report_figures: {error}")
    plt.rcParams.update({"font.size": 10, "svg.fonttype": "none", "svg.hashsalt": "quadrille"})
    points = points_of(errors, speeds)
    horizons = {row["scene"]: row["horizon_s"] for row in errors if row["dt"] == "1/60"}
    for scene, horizon in horizons.items():
        draw_scene([p for p in points if p["scene"] == scene], scene, horizon, folder / scene)
    draw_policies(policies, folder / "policies")
    write_report(folder, points, speeds, policies, features, about, horizons)


if __name__ == "__main__":
    main()
