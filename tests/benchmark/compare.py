#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the ratios of two runs of delos_benchmark (compare.sh makes them).

    compare.py BASE.jsonl HEAD.jsonl

Of several lines of one case the least time counts. Processor seconds on one thread, where both
sides tell them; else wall time.
"""
import sys

sys.dont_write_bytecode = True
import page  # noqa: E402

NOTICED = 1e-3  # relative change of a quality column that is worth a line
SHORTEST_S = 1e-3  # shorter phases are noise
KERNEL = "alone"  # the phase of a kernel of the sizing layer, which has no other


def best(path):
    """{(case or kernel, threads): line with the least of each time}"""
    cases = {}
    for row in page.read_lines(path) + page.read_lines(path, "sizing"):
        key = (row["case"] if "case" in row else f"sizing {row['sizing']}", row["threads"])
        line = cases.setdefault(key, dict(row))
        for name, value in row.items():
            is_time = name.endswith("_s") and not name.endswith("_per_s") or name == "seconds"
            if is_time and value is not None and line.get(name) is not None:
                line[name] = min(value, line[name])
    return cases


def time_key(phase, threads, *lines):
    """The key under which all lines tell the time of the phase, or None."""
    keys = [f"{phase}_cpu_s"] * (threads == 1) + [f"{phase}_s"]
    for key in keys if phase != KERNEL else ["seconds"]:
        if all(line.get(key) is not None for line in lines):
            return key
    return None


def compare(base, head):
    yield f"{'case':14} {'threads':>7} {'phase':10} {'base s':>9} {'head s':>9} {'head/base':>9}"
    for (case, threads), old in base.items():
        new = head.get((case, threads))
        if new is None:
            continue
        place = f"{case:14} {threads:7}"
        for phase in page.ALL_PHASES + [KERNEL]:
            key = time_key(phase, threads, old, new)
            if key and old[key] >= SHORTEST_S:
                wall = "" if key.endswith("_cpu_s") else "  wall"
                yield (f"{place} {phase:10} {old[key]:9.3f} {new[key]:9.3f} "
                       f"{new[key] / old[key]:9.3f}{wall}")
        if old["digest"] == new["digest"]:
            continue
        yield f"{place} the grids differ"
        for column in page.QUALITY:
            before, after = old.get(column.key), new.get(column.key)
            if before is None or after is None or before == after:
                continue
            if abs(after - before) > NOTICED * max(abs(before), abs(after)):
                word = "better" if column.is_better(after, before) else "worse"
                yield f"{place}   {column.key} {before:g} -> {after:g} {word}"


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print("\n".join(compare(best(sys.argv[1]), best(sys.argv[2]))))
