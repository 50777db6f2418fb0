#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Rewrites the marked parts of component/PERFORMANCE.md, and its picture, from benchmark lines.

    /usr/bin/python3 page.py [RESULTS] [--page PAGE] [--no-picture]

RESULTS: what delos_benchmark printed; tests/benchmark/results.jsonl when left out. The picture
needs matplotlib (Debian's python3-matplotlib); it goes to performance/times.png beside the page.
"""
import argparse
import json
import math
import pathlib
import re
import sys
from dataclasses import dataclass

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "component" / "PERFORMANCE.md"

PHASES = ["read", "spacing", "refine", "relax", "polish", "quality", "dual", "digest", "write"]
BESIDE = ["limit", "delaunay", "cgal"]  # measured beside the run
ALL_PHASES = PHASES + BESIDE
ALONE = ["sizing", "remesh", "remap"]  # by options of their own, without a grid's phases
MESH = ["refine", "relax", "polish"]  # what makes a triangulation of a spacing
THREADED = ["refine", "relax", "polish", "limit", "dual"]


@dataclass(frozen=True)
class Column:
    """A measure of quality: key of the lines, heading, sense, digits behind the point."""
    key: str
    title: str
    more_is_better: bool
    digits: int

    def text(self, value):
        shown = f"{value:.{self.digits}f}"
        return shown[1:] if shown.startswith("0.") else shown

    def is_better(self, value, other):
        """Strictly, to the digits shown."""
        a, b = round(value, self.digits), round(other, self.digits)
        return a > b if self.more_is_better else a < b


QUALITY = [
    Column("area_length_min", "a_f min", True, 4),
    Column("area_length_p01", "p01", True, 4),
    Column("area_length_mean", "mean", True, 5),
    Column("angle_min_deg", "angle min", True, 1),
    Column("angle_max_deg", "max", False, 1),
    Column("angle_mad_deg", "mad", False, 3),
    Column("degree_6", "degree 6", True, 4),
    Column("relative_edge_std", "h_r std", False, 3),
    Column("relative_edge_min", "min", True, 2),
    Column("relative_edge_max", "max", False, 2),
    Column("dual_ratio_min", "dual ratio", True, 3),
    Column("stagger_mean", "stagger mean", False, 4),
    Column("stagger_max", "max", False, 3),
    Column("obtuse", "obtuse", False, 0),
]


@dataclass(frozen=True)
class Jigsaw:
    """JIGSAW 1.1.0 (default options but where said), measured by us on one core of the same kind
    of machine; quality in the order of QUALITY, None where it was not measured."""
    case: str
    name: str
    refine_s: float
    total_s: float
    bytes_per_vertex: float
    quality: tuple


JIGSAW = [
    Jigsaw("U120", "JIGSAW", 0.6, 8.1, 1230, (.9167, .9461, .99619, 41.9, 82.6, 1.746, .9617,
           .036, .79, 1.31, .149, .0056, .102, 0)),
    Jigsaw("U60", "JIGSAW", 2.4, 35.7, 950, (.9167, .9567, .99767, 42.0, 82.5, 1.213, .9771,
           .028, .77, 1.28, .146, .0036, .102, 0)),
    Jigsaw("U30", "JIGSAW", 10.6, 151, 864, (.9133, .9675, .99861, 41.9, 82.7, 0.813, .9867,
           .022, .76, 1.37, .138, .0022, .114, 0)),
    Jigsaw("U15", "JIGSAW", 54, 604, 819, (.9140, .9771, .99917, 41.5, 82.8, 0.536, .9922,
           .017, .71, 1.47, .134, .0013, .140, 0)),
    Jigsaw("E60", "JIGSAW", 2.7, 36.3, 934, (.9168, .9585, .99784, 41.9, 82.7, 1.151, .9794,
           .027, .78, 1.35, .146, .0033, .103, 0)),
    Jigsaw("T60", "JIGSAW", 4.3, 51.3, 927, (.9167, .9414, .99499, 41.9, 82.7, 2.298, .9518,
           .042, .75, 1.40, .142, .0072, .120, 0)),
    Jigsaw("V1", "JIGSAW", 0.5, 6.5, 1334, (.9171, .9409, .99509, 41.7, 82.5, 2.151, .9519,
           .041, .77, 1.36, .157, .0079, .114, 0)),
]
# Its best by any settings; time of the whole run.
JIGSAW_BEST = [
    Jigsaw("U60", "JIGSAW, tightest settings", None, 52, None, (.9293, .9602, .99776, 44.1, 80.1,
           1.224, .9770, .029, .78, 1.38, None, None, None, 0)),
    Jigsaw("U60", "JIGSAW, multilevel", None, 65, None, (.9206, .9706, .99650, 42.1, 79.9, 2.045,
           .9976, .036, .75, 1.33, None, None, None, 0)),
]

# Goals, and the sizes from which a case counts for them: below, fixed costs and noise are all.
REFINE_GOAL_PER_S, REFINE_GOAL_ELLIPSOID_PER_S, DUAL_GOAL_PER_S = 1.5e6, 1.0e6, 0.7e6
TIME_GOAL = 50  # JIGSAW's total over refine + relax + polish
SPEEDUP_GOALS = {2: 1.8, 16: 10.0}
GROWTH_GOAL = 0.15
BYTES_GOAL = 200
RATE_FROM, SPEEDUP_FROM, BYTES_FROM, GROWTH_FROM = 10_000, 100_000, 500_000, 90_000
SPEEDUP_FROM_S = 5e-3  # starting the threads takes about a thousandth
SERIES = {"graded": ["G100k", "G300k", "G1M", "G3M", "G10M"],
          "uniform": ["U60", "U30", "U15", "U7.5"]}


# ------------------------------------------------------------------ the lines


def read_objects(path):
    with open(path, encoding="utf-8") as lines:
        return [json.loads(line) for line in lines if line.strip()]


def read_lines(path, kind="case"):
    """The lines of one kind: on cases that make grids, or what the benchmark measures alone: kernels
    of the sizing layer, remeshes, weights between grids."""
    return [line for line in read_objects(path) if kind in line]


class Results:
    def __init__(self, path):
        self.machines = [line["machine"] for line in read_objects(path) if "machine" in line]
        self.lines = {(line["case"], line["threads"]): line for line in read_lines(path)}
        self.alone = {kind: {(line[kind], line["threads"]): line
                             for line in read_lines(path, kind)} for kind in ALONE}
        if not self.lines:
            sys.exit(f"{path}: no line on a case")

    def one_core(self):
        return [line for (_, threads), line in self.lines.items() if threads == 1]

    def find(self, case, threads=1):
        return self.lines.get((case, threads))

    def thread_counts(self):
        return sorted({threads for _, threads in self.lines})


def user_s(line, phases):
    """The program's own processor seconds of the phases together, None when one was not measured."""
    times = [line[f"{phase}_user_s"] for phase in phases]
    return None if None in times else sum(times)


def system_s(line, phases):
    """The kernel's processor seconds of the phases that were measured."""
    return sum((line[f"{phase}_cpu_s"] or 0) - (line[f"{phase}_user_s"] or 0) for phase in phases)


def speedup(results, case, phase, threads):
    """Processor seconds on one thread, the kernel's too (the wall time of an idle machine), over
    wall seconds on several; None for a phase that was not measured or is too short to tell."""
    one, many = results.find(case), results.find(case, threads)
    if not one or not many or (one[f"{phase}_cpu_s"] or 0) < SPEEDUP_FROM_S:
        return None
    return one[f"{phase}_cpu_s"] / many[f"{phase}_s"]


def mean_speedup(results, phase, threads):
    """Geometric mean over the cases that are large enough, None when there is none."""
    ratios = [speedup(results, line["case"], phase, threads) for line in results.one_core()
              if line["vertices"] >= SPEEDUP_FROM]
    ratios = [ratio for ratio in ratios if ratio]
    return math.exp(sum(map(math.log, ratios)) / len(ratios)) if ratios else None


def growth(results, series, phase):
    """[(vertices, the program's own microseconds a vertex)] of one series of cases."""
    points = []
    for case in SERIES[series]:
        line = results.find(case)
        seconds = user_s(line, MESH if phase == "mesh" else [phase]) if line else None
        if seconds and line["vertices"] >= GROWTH_FROM:
            points.append((line["vertices"], 1e6 * seconds / line["vertices"]))
    return points


def spread(points):
    """Largest distance from the middle, as a part of it: 0.15 is +-15 %."""
    values = [value for _, value in points]
    return (max(values) - min(values)) / (max(values) + min(values))


# ------------------------------------------------------------------ markdown


def table(head, rows):
    """First column to the left, the others to the right; nothing measured is a dash."""
    lines = [head, ["---"] + ["--:"] * (len(head) - 1)] + rows
    return "\n".join("| " + " | ".join("–" if x is None else str(x) for x in row) + " |"
                     for row in lines)


def digits(value, n=3):
    """n digits, as a plain number."""
    if value is None:
        return None
    if value == 0:
        return "0"
    places = max(n - 1 - math.floor(math.log10(abs(value))), 0)
    return f"{value:.{places}f}"


def seconds(value):
    """Nothing shorter than a millisecond is worth a figure."""
    if value is None:
        return None
    return "<.001" if value < 1e-3 else f"{value:.3f}" if value < 1 else digits(value)


def count(n):
    return f"{n:,}".replace(",", " ")


def machine_part(results):
    seen = {json.dumps(machine): machine for machine in results.machines}
    texts = [f"{m['processor']}, {m['cores']} cores, {m['memory_gib']:g} GiB, {m['compiler']}, "
             f"build type {m['build']}, delos {m['delos']}"
             + (f" at {m['label']}" if m.get("label") else "") for m in seen.values()]
    return "Measured on: " + "; ".join(texts or ["unknown"]) + "."


def times_part(results):
    rows = []
    for line in results.one_core():
        mesh = user_s(line, MESH)
        rows.append([line["case"], count(line["vertices"])]
                    + [seconds(line[f"{phase}_user_s"]) for phase in PHASES]
                    + [seconds(system_s(line, MESH)), seconds(system_s(line, ["dual"])),
                       digits(line["refine_vertices_per_s"] / 1e6),
                       digits(line["vertices"] / mesh / 1e6),
                       digits(line["dual_cells_per_s"] / 1e6)])
    return table(["case", "vertices"] + PHASES
                 + ["system: mesh", "system: dual", "refine M/s", "refine + relax + polish M/s", "dual M/s"], rows)


def jigsaw_part(results):
    rows = []
    for peer in JIGSAW:
        line = results.find(peer.case)
        if not line:
            continue
        refine, mesh = user_s(line, ["refine"]), user_s(line, MESH)
        rows.append([peer.case, digits(peer.refine_s, 2), seconds(refine),
                     digits(peer.refine_s / refine), digits(peer.total_s), seconds(mesh),
                     digits(peer.total_s / mesh), peer.bytes_per_vertex,
                     digits(line["mesh_bytes_per_vertex"])])
    if not rows:
        return "Not measured."
    return table(["case", "refine s, JIGSAW", "delos", "ratio", "whole s, JIGSAW",
                  "refine + relax + polish s, delos", "ratio", "B a vertex, JIGSAW", "delos"], rows)


def quality_part(results):
    rows = []
    for line in results.one_core():
        rows.append([f"**{line['case']}**"] + [column.text(line[column.key]) for column in QUALITY])
        for peer in JIGSAW + JIGSAW_BEST:
            if peer.case != line["case"]:
                continue
            row = [peer.name]
            for column, value in zip(QUALITY, peer.quality):
                if value is None:
                    row.append(None)
                elif column.is_better(value, line[column.key]):
                    row.append(f"**{column.text(value)}**")
                else:
                    row.append(column.text(value))
            rows.append(row)
    return table(["case"] + [column.title for column in QUALITY], rows)


def memory_part(results):
    rows = []
    for line in results.one_core():
        rows.append([line["case"], count(line["vertices"]), digits(line["start_mib"])]
                    + [digits(line[f"{phase}_peak_mib"]) for phase in MESH + ["dual"]]
                    + [digits(line["peak_mib"]), digits(line["mesh_bytes_per_vertex"]),
                       digits(line["bytes_per_vertex"])])
    return table(["case", "vertices", "start MiB", "refine", "relax", "polish", "dual", "whole",
                  "B a vertex to the triangulation", "B a vertex"], rows)


def threads_part(results):
    rows = []
    for threads in results.thread_counts():
        if threads == 1:
            continue
        for line in results.one_core():
            ratios = [speedup(results, line["case"], phase, threads) for phase in THREADED]
            if any(ratios):
                rows.append([line["case"], count(line["vertices"]), threads]
                            + [r and f"{r:.2f}" for r in ratios])
        means = [mean_speedup(results, phase, threads) for phase in THREADED]
        if any(means):
            rows.append([f"geometric mean from {count(SPEEDUP_FROM)} vertices", None, threads]
                        + [r and f"{r:.2f}" for r in means])
    return table(["case", "vertices", "threads"] + THREADED, rows) if rows else "Not measured."


def growth_part(results):
    phases = MESH + ["mesh", "dual"]
    rows = []
    for series, cases in SERIES.items():
        for case in cases:
            line = results.find(case)
            if not line:
                continue
            times = [user_s(line, MESH if phase == "mesh" else [phase]) for phase in phases]
            rows.append([case, count(line["vertices"])]
                        + [digits(t and 1e6 * t / line["vertices"]) for t in times])
        points = [growth(results, series, phase) for phase in phases]
        if all(len(p) > 1 for p in points):
            rows.append([f"{series}: ± %", None] + [f"{100 * spread(p):.0f}" for p in points])
    return table(["case", "vertices", "refine µs a vertex", "relax", "polish", "all three",
                  "dual"], rows) if rows else "Not measured."


def building_part(results):
    rows = []
    for line in results.one_core():
        ours, theirs = line["delaunay_user_s"], line["cgal_user_s"]
        if ours:
            n = line["vertices"]
            rows.append([line["case"], count(n), digits(n / ours / 1e6),
                         theirs and digits(n / theirs / 1e6), theirs and digits(theirs / ours)])
    return table(["case", "points", "delos M/s", "CGAL M/s", "ratio"], rows) if rows else \
        "Not measured."


def sizing_part(results):
    rows = [[line["case"], count(line["limit_nodes"]), seconds(line["spacing_user_s"]),
             seconds(line["limit_user_s"]), digits((line["limit_nodes_per_s"] or 0) / 1e6)]
            for line in results.one_core() if line["limit_nodes"]]
    return table(["case", "nodes of the table", "spacing s", "of it the gradient limit",
                  "limit M nodes/s"], rows) if rows else "Not measured."


def kernels_part(results):
    rows = []
    kernels = results.alone["sizing"]
    for (name, threads), line in kernels.items():
        one = kernels.get((name, 1))
        gain = one and threads > 1 and one["seconds"] / line["seconds"]
        rows.append([name, threads, seconds(line["seconds"]), digits(line["nodes_per_s"] / 1e6),
                     f"{gain:.2f}" if gain else None])
    return table(["kernel", "threads", "wall s", "M nodes/s", "times as fast"], rows) if rows \
        else "Not measured."


def remesh_part(results):
    rows = [[name, count(line["before"]), count(line["after"]),
             f"{100 * max(line['removed'], line['inserted']) / line['before']:.1f}",
             seconds(line["fresh_s"]), seconds(line["remesh_s"]), f"{100 * line['share']:.1f}"]
            for (name, threads), line in results.alone["remesh"].items() if threads == 1]
    return table(["remesh", "vertices before", "after", "% made anew", "fresh mesh s", "remesh s",
                  "% of fresh"], rows) if rows else "Not measured."


def remap_part(results):
    rows = [[name, threads, count(line["sources"]), count(line["targets"]),
             count(line["overlaps"]), digits(line["first_overlaps_per_s"] / 1e6),
             digits(line["second_overlaps_per_s"] / 1e6)]
            for (name, threads), line in results.alone["remap"].items()]
    return table(["remap", "threads", "cells from", "to", "overlaps", "M overlaps/s, first order",
                  "second"], rows) if rows else "Not measured."


# ------------------------------------------------------------------ goals


def verdict(name, measured, is_met):
    return [name, measured, "yes" if is_met else "no"]


def rate_goals(results):
    for name, goal, is_ellipsoid in [("sphere", REFINE_GOAL_PER_S, False),
                                     ("ellipsoid", REFINE_GOAL_ELLIPSOID_PER_S, True)]:
        rates = [(line["refine_vertices_per_s"], line["case"]) for line in results.one_core()
                 if (line["surface"] != "sphere") == is_ellipsoid
                 and line["vertices"] >= RATE_FROM]
        if rates:
            rate, case = min(rates)
            yield verdict(f"refine, one core, every case of the {name}: {goal / 1e6:g} M vertices/s",
                          f"least {digits(rate / 1e6)} ({case})", rate >= goal)
    rates = [(line["dual_cells_per_s"], line["case"]) for line in results.one_core()
             if line["vertices"] >= RATE_FROM]
    if rates:
        rate, case = min(rates)
        yield verdict(f"dual with all tables and weights, one core: {DUAL_GOAL_PER_S / 1e6:g} M "
                      "cells/s", f"least {digits(rate / 1e6)} ({case})", rate >= DUAL_GOAL_PER_S)


def jigsaw_goals(results):
    pairs = [(peer, results.find(peer.case)) for peer in JIGSAW if results.find(peer.case)]
    if not pairs:
        return
    ratio, case = min((peer.total_s / user_s(line, MESH), peer.case) for peer, line in pairs)
    yield verdict(f"refine + relax + polish, one core: 1/{TIME_GOAL} of JIGSAW's time",
                  f"at least 1/{ratio:.0f} ({case})", ratio >= TIME_GOAL)
    best = [(peer, results.find(peer.case)) for peer in JIGSAW_BEST if results.find(peer.case)]
    for name, peers in [("JIGSAW's defaults", pairs), ("JIGSAW's best settings", best)]:
        behind, n = [], 0
        for peer, line in peers:
            for column, value in zip(QUALITY, peer.quality):
                if value is None:
                    continue
                n += 1
                if column.is_better(value, line[column.key]):
                    setting = peer.name.partition(", ")[2]
                    behind.append(f"{peer.case} {column.key}" + (setting and f" ({setting})"))
        if n:
            yield verdict(f"no column of quality behind {name}",
                          f"{n - len(behind)} of {n}" +
                          (f"; behind: {', '.join(behind)}" if behind else ""), not behind)


def thread_goals(results):
    for threads, goal in SPEEDUP_GOALS.items():
        means = {phase: mean_speedup(results, phase, threads) for phase in THREADED}
        means = {phase: mean for phase, mean in means.items() if mean}
        if means:
            yield verdict(f"{threads} threads: {goal:g} times as fast",
                          ", ".join(f"{phase} {mean:.2f}" for phase, mean in means.items()),
                          min(means.values()) >= goal)


def growth_goals(results):
    """What counts is a vertex of the mesh and a cell of the dual; the phases stand beside."""
    for series in SERIES:
        points = {phase: growth(results, series, phase) for phase in ["mesh", "dual"] + MESH}
        if any(len(p) < 2 for p in points.values()):
            continue
        spreads = {phase: spread(p) for phase, p in points.items()}
        shown = {phase: f"{phase} ± {100 * s:.0f}" for phase, s in spreads.items()}
        first, last = (points["mesh"][end][0] for end in (0, -1))
        yield verdict(f"time a vertex, {series}, {count(first)} to {count(last)} vertices: "
                      f"refine + relax + polish and dual within ± {100 * GROWTH_GOAL:.0f} %",
                      f"{shown['mesh'].replace('mesh', 'all three')}, {shown['dual']} ("
                      + ", ".join(shown[phase] for phase in MESH) + ")",
                      max(spreads["mesh"], spreads["dual"]) <= GROWTH_GOAL)


def goals_part(results):
    rows = [*rate_goals(results), *jigsaw_goals(results), *thread_goals(results),
            *growth_goals(results)]
    sizes = [(line["mesh_bytes_per_vertex"], line["case"]) for line in results.one_core()
             if line["vertices"] >= BYTES_FROM]
    if sizes:
        size, case = max(sizes)
        rows.append(verdict(f"memory to the triangulation: {BYTES_GOAL} bytes a vertex",
                            f"at most {digits(size)} ({case})", size <= BYTES_GOAL))
    return table(["goal", "measured", "met"], rows) if rows else "Not measured."


PARTS = {"machine": machine_part, "goals": goals_part, "times": times_part,
         "jigsaw": jigsaw_part, "quality": quality_part, "sizing": sizing_part,
         "kernels": kernels_part, "remesh": remesh_part, "remap": remap_part,
         "threads": threads_part, "growth": growth_part, "memory": memory_part,
         "building": building_part}


def rewrite(page_text, results):
    """The page with every part between `<!-- begin X -->` and `<!-- end X -->` made anew."""
    for name, part in PARTS.items():
        marks = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.S)
        if len(marks.findall(page_text)) != 1:
            sys.exit(f"the page must have the marks of the part '{name}' once")
        text = part(results)
        page_text = marks.sub(lambda found: found.group(1) + text + "\n" + found.group(2),
                              page_text)
    return page_text


# ------------------------------------------------------------------ the picture

COLOURS = {"refine": "#0072b2", "relax": "#e69f00", "polish": "#009e73", "dual": "#cc79a7",
           "limit": "#56b4e9"}  # told apart by colour-blind readers, too (Okabe & Ito 2008)
STYLES = {"graded": ("o", "-"), "uniform": ("s", ":")}


def draw_growth(axes, results):
    for phase in MESH + ["dual"]:
        for series, (marker, style) in STYLES.items():
            points = growth(results, series, phase)
            if not points:
                continue
            n, micro = zip(*points)
            time = [1e-6 * a * b for a, b in points]
            axes.loglog(n, time, marker + style, color=COLOURS[phase], markersize=4, linewidth=1,
                        label=phase if series == "graded" else None)
            middle = 0.5e-6 * (max(micro) + min(micro))
            if series == "graded" and len(points) > 1:
                axes.fill_between(n, [(1 - GROWTH_GOAL) * middle * x for x in n],
                                  [(1 + GROWTH_GOAL) * middle * x for x in n],
                                  color=COLOURS[phase], alpha=0.2, linewidth=0)
    axes.set(xlabel="vertices", ylabel="the program's processor seconds, one thread",
             title="growth; bands: ± 15 % about proportional")
    for series, (marker, style) in STYLES.items():
        axes.plot([], [], marker + style, color="grey", markersize=4, linewidth=1, label=series)
    axes.grid(True, which="both", linewidth=0.3)
    axes.legend(fontsize=7, loc="upper left")


def draw_threads(axes, results):
    counts = results.thread_counts()
    axes.plot(counts, counts, "--", color="grey", linewidth=1, label="ideal")
    for phase in THREADED:
        means = [(t, 1.0 if t == 1 else mean_speedup(results, phase, t)) for t in counts]
        means = [(t, mean) for t, mean in means if mean]
        if len(means) > 1:
            axes.plot(*zip(*means), "o-", color=COLOURS[phase], markersize=4, linewidth=1,
                      label=phase)
    axes.set(xlabel="threads", ylabel="times as fast as on one", xticks=counts,
             title=f"threads; cases from {count(SPEEDUP_FROM)} vertices")
    axes.grid(True, linewidth=0.3)
    axes.legend(fontsize=7)


def draw(results, path):
    try:
        import matplotlib
    except ImportError:
        sys.exit(f"no matplotlib for {sys.executable}; Debian's python3-matplotlib is for "
                 "/usr/bin/python3; --no-picture leaves the picture as it is")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams["axes.titlesize"] = 10
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    draw_growth(left, results)
    draw_threads(right, results)
    path.parent.mkdir(exist_ok=True)
    figure.savefig(path, dpi=110, metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", nargs="?", default=HERE / "results.jsonl", type=pathlib.Path)
    parser.add_argument("--page", default=PAGE, type=pathlib.Path)
    parser.add_argument("--no-picture", action="store_true")
    arguments = parser.parse_args()
    results = Results(arguments.results)
    page = arguments.page
    text = rewrite(page.read_text(encoding="utf-8"), results)
    if not arguments.no_picture:
        draw(results, page.parent / "performance" / "times.png")
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
