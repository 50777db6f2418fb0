#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs one small case through delos_benchmark and checks what comes out: every column, figures
that can be true, the page and the comparison made of them.

    check.py DELOS_BENCHMARK
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import page  # noqa: E402

CASE = "U240"
HEAD = {"processor", "cores", "memory_gib", "compiler", "build", "delos", "label"}
COLUMNS = (
    {"case", "threads", "repeats", "surface", "vertices", "digest", "limit_nodes", "start_mib",
     "peak_mib", "refine_vertices_per_s", "mesh_vertices_per_s", "dual_cells_per_s",
     "limit_nodes_per_s", "mesh_bytes_per_vertex", "bytes_per_vertex"}
    | {f"{phase}{kind}" for phase in page.ALL_PHASES for kind in ("_s", "_cpu_s", "_user_s")}
    | {f"{phase}_peak_mib" for phase in page.MESH + ["dual"]}
    | {column.key for column in page.QUALITY})
# What a uniform case can't have; the yardstick may be missing, and is run on one thread only.
EMPTY = {"limit_s", "limit_cpu_s", "limit_user_s", "limit_nodes", "limit_nodes_per_s"}
MAYBE_EMPTY = {"cgal_s", "cgal_cpu_s", "cgal_user_s"}
failures = 0


def check(condition, what):
    global failures
    if not condition:
        print(f"FAILED {what}")
        failures += 1


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=False)


def check_line(line):
    name = f"{line.get('case')} on {line.get('threads')} threads"
    check(set(line) == COLUMNS, f"{name}: columns {sorted(set(line) ^ COLUMNS)} are missing or new")
    for key in COLUMNS & set(line):
        is_empty = line[key] is None
        if key not in MAYBE_EMPTY:
            check(is_empty == (key in EMPTY), f"{name}: {key} is {line[key]}")
        if key.endswith("_s") and not is_empty:
            check(line[key] >= 0, f"{name}: {key} is {line[key]}")
        if key.endswith("_user_s") and not is_empty:
            whole = line[key.replace("_user_s", "_cpu_s")]
            check(line[key] <= whole, f"{name}: {key} is {line[key]}, of {whole}")
    for phase in page.MESH + ["dual", "quality", "write"]:
        check(line[f"{phase}_cpu_s"] > 0 and line[f"{phase}_s"] > 0, f"{name}: {phase} took no time")
    peaks = [line[f"{phase}_peak_mib"] for phase in page.MESH + ["dual"]] + [line["peak_mib"]]
    check(0 < line["start_mib"] < peaks[0] and peaks == sorted(peaks), f"{name}: peaks {peaks}")
    check(9_000 < line["vertices"] < 11_000, f"{name}: {line['vertices']} vertices")
    check(0.9 < line["area_length_min"] < line["area_length_p01"] < line["area_length_mean"] <= 1,
          f"{name}: area-length quality")
    check(line["obtuse"] == 0 and line["repeats"] == 2, f"{name}: obtuse, repeats")
    check(len(line["digest"]) == 64, f"{name}: digest {line['digest']}")


KERNEL = "profile"


def check_kernels(benchmark, results):
    """A kernel alone, whose lines the page shows and the comparison knows again."""
    done = run(benchmark, "--sizing", "--threads", "1,2", KERNEL)
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    check(done.returncode == 0, f"--sizing: exit status {done.returncode}: {done.stderr}")
    check([line.get("sizing") for line in lines if "threads" in line] == [KERNEL] * 2,
          f"--sizing: lines {done.stdout}")
    with results.open("a", encoding="utf-8") as file:
        file.write(done.stdout)


def check_output(benchmark, results):
    done = run(benchmark, "--threads", "1,2", "--repeat", "2", "--label", "check", CASE)
    check(done.returncode == 0, f"exit status {done.returncode}: {done.stderr}")
    results.write_text(done.stdout, encoding="utf-8")
    head, *lines = [json.loads(line) for line in done.stdout.splitlines()]
    check(set(head["machine"]) == HEAD, f"machine: {head}")
    check([line["threads"] for line in lines] == [1, 2], "one line for each number of threads")
    for line in lines:
        check_line(line)
    check(len({line["digest"] for line in lines}) == 1, "the same digest for 1 and 2 threads")


def check_page(results, folder):
    copy = folder / "PAGE.md"
    shutil.copy(page.PAGE, copy)
    done = run(sys.executable, "-B", str(page.HERE / "page.py"), str(results), "--page", str(copy),
               "--no-picture")
    check(done.returncode == 0, f"page.py: {done.stderr}")
    text = copy.read_text(encoding="utf-8")
    def body_of(part):
        return text.split(f"<!-- begin {part} -->")[1].split(f"<!-- end {part} -->")[0]

    check(body_of("kernels").count(f"| {KERNEL} |") == 2, "page: the kernel on 1 and 2 threads")
    for part in ("times", "quality", "memory"):
        body = body_of(part)
        check(CASE in body and "V1" not in body, f"page: part {part} is made of the lines given")
    check("at check" in text, "page: the label stands in it")


def check_comparison(results):
    done = run(sys.executable, "-B", str(page.HERE / "compare.py"), str(results), str(results))
    check(done.returncode == 0, f"compare.py: {done.stderr}")
    rows = [row.split() for row in done.stdout.splitlines()[1:]]
    check({row[2] for row in rows} >= set(page.MESH), "compare.py: a row for each phase")
    check(any(row[:2] == ["sizing", KERNEL] for row in rows), "compare.py: a row for the kernel")
    check(all("1.000" in row for row in rows), "compare.py: equal runs have ratios of 1")


def check_errors(benchmark):
    for words in (["no_such_case"], ["--threads", "0", CASE], ["--threads"], ["--no-such-option"]):
        done = run(benchmark, *words)
        check(done.returncode == 2 and "usage" in done.stderr and not done.stdout,
              f"{words}: exit status {done.returncode}, '{done.stderr}'")
    listed = run(benchmark, "--list").stdout.split("\n")
    for case in [peer.case for peer in page.JIGSAW] + sum(page.SERIES.values(), []):
        check(any(row.split(" ")[0] == case for row in listed), f"--list: {case} of the page")


def main():
    benchmark = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        results = folder / "lines.jsonl"
        check_output(benchmark, results)
        check_kernels(benchmark, results)
        check_page(results, folder)
        check_comparison(results)
    check_errors(benchmark)
    print(f"{failures} failed")
    return failures != 0


if __name__ == "__main__":
    sys.exit(main())
