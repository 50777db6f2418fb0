#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the sources and fails on what the layout forbids.

    layering.py [ROOT]      list every violation under ROOT, exit 1 if there is one
    layering.py --self-test plant one violation of every rule in a copy of a clean tree and
                            check that exactly that rule reports it
"""
import pathlib
import re
import sys
import tempfile

# Layer -> layers it may include (beside itself). Read from bottom to top.
BELOW = {
    "core": [],
    "time": ["core"],
    "geometry": ["core"],
    "triangulation": ["geometry", "core"],
    "sizing": ["triangulation", "geometry", "core"],
    "refine": ["sizing", "triangulation", "geometry", "core"],
    "relax": ["sizing", "triangulation", "geometry", "core"],
    "dual": ["triangulation", "geometry", "core"],
    "partition": ["dual", "triangulation", "geometry", "core"],
    "domain": ["partition", "dual", "sizing", "triangulation", "geometry", "core"],
    "metrics": ["dual", "sizing", "triangulation", "geometry", "core"],
    "remap": ["dual", "triangulation", "geometry", "core"],
    "adapt": ["remap", "metrics", "dual", "relax", "refine", "sizing", "triangulation", "geometry", "time", "core"],
    "io": ["dual", "sizing", "triangulation", "geometry", "core"],
    "pictures": ["metrics", "dual", "sizing", "triangulation", "geometry", "core"],
    "lifecycle": ["adapt", "remap", "io", "metrics", "domain", "partition", "dual", "relax", "refine", "sizing",
                  "triangulation", "geometry", "time", "core"],
    "app": ["lifecycle", "pictures", "remap", "io", "metrics", "partition", "dual", "relax", "refine", "sizing",
            "triangulation", "geometry", "time", "core"],
}
# What adapters may name: the phase functions and what these hand over.
INTERFACES_MAY_INCLUDE = ["lifecycle", "remap", "io", "metrics", "domain", "partition", "dual", "sizing",
                          "triangulation", "geometry", "time", "core"]
# Folders beside the layers: CMake functions; the picture of PERFORMANCE.md.
NO_LAYERS = ["cmake", "performance"]
# Layers whose code is on the path from configuration to grid: no libm there.
GRID_PATH = ["core", "geometry", "triangulation", "sizing", "refine", "relax", "dual", "domain", "remap", "adapt"]

# Each third party's name, and the only files that may say it.
HOMES = [
    ("oneTBB", r"\btbb::|#include\s*[<\"](?:oneapi/)?tbb", ["component/core/parallel.cpp"]),
    ("netCDF", r"\bnc_\w+\s*\(|#include\s*[<\"]netcdf", ["component/io/netcdf_types.hpp", "component/io/netcdf_reader.cpp", "component/io/netcdf_writer.cpp"]),
    ("yaml-cpp", r"\bYAML::|#include\s*[<\"]yaml-cpp", ["component/lifecycle/settings"]),
    ("cairo", r"\bcairo_\w+|#include\s*[<\"]cairo", ["component/pictures/canvas.cpp"]),
    ("OpenSSL", r"\bEVP_\w+|#include\s*[<\"]openssl", ["component/core/hash.cpp"]),
    ("METIS", r"\bMETIS_\w+|#include\s*[<\"]metis", ["component/partition/kway.cpp"]),
    ("shapelib", r"\bSHP\w+\s*\(|#include\s*[<\"]shapefil", ["component/io/shapefile.cpp"]),
    ("MPI", r"\bMPI_\w+|#include\s*[<\"]mpi\.h[>\"]", ["interfaces/mpi/", "interfaces/esmf/team_mpi.cpp"]),
    ("CLI11", r"\bCLI::|#include\s*[<\"]CLI/", ["component/app/"]),
]

LIBM = ("sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 expm1 log log2 "
        "log10 log1p pow cbrt hypot fma erf erfc tgamma lgamma").split()
# `std::sin(`, `::sin(`, or a bare call that is no declaration, member or elementary::sin.
LIBM_CALL = re.compile(r"(?<![\w.>:])(?:std::|::)(" + "|".join(LIBM) + r")f?\s*\(")
ARRAY_LIBM = re.compile(r"\.(?:array\(\)\.)?(sin|cos|tan|exp|log|log10|pow|tanh)\(\)")
BARE_LIBM = re.compile(r"(?<![\w.>:~])(" + "|".join(LIBM) + r")f?\s*\(")
# fma is correctly rounded everywhere: fit for the exact product of two doubles, nothing else.
FMA_HOME = "component/geometry/expansion.hpp"
PRINTS = re.compile(r"\bstd::(?:cout|cerr|clog|printf|puts)\b|(?<![\w:.>])(?:printf|fprintf|puts|"
                    r"putchar|perror)\s*\(|#include\s*<iostream>")
ENDS_PROCESS = re.compile(r"(?<![\w.>])(?:std::|::)?(?:exit|abort|quick_exit|_exit|signal|sigaction|"
                          r"setlocale|fesetround|feenableexcept)\s*\(")
# Model time comes from its caller: neither the machine's clock nor its locale has a part in it.
WORLD = re.compile(r"#include\s*<(?:chrono|ctime|time\.h|sys/time\.h|locale|clocale|sstream|iomanip)>|"
                   r"\bstd::(?:chrono|time|locale|stoi|stol|stoll|stod|strtod)\b|\bsetlocale\b")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')


def stripped(text):
    """The source without comments and without the contents of strings, line by line."""
    def blank(match):
        token = match.group(0)
        if token.startswith("/"):
            return re.sub(r"[^\n]", " ", token)
        if token.startswith("R\""):
            return '""' + "\n" * token.count("\n")
        return token[0] + token[-1]
    pattern = (r"//[^\n]*|/\*.*?\*/|R\"([^(]*)\(.*?\)\1\""
               r"|\"(?:\\.|[^\"\\\n])*\"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])'")
    return re.sub(pattern, blank, text, flags=re.S).splitlines()


def check_includes(path, layer, raw_lines):
    for number, line in enumerate(raw_lines, 1):
        found = INCLUDE.match(line)
        if not found:
            continue
        target = found.group(1).split("/")[0]
        if target not in BELOW or target == layer:
            continue
        allowed = INTERFACES_MAY_INCLUDE if layer == "interfaces" else BELOW[layer]
        if target not in allowed:
            yield "include", f"{path}:{number}: {layer} must not include {target} ({found.group(1)})"


def own_names(lines):
    """Names of LIBM that this file declares itself or takes from elementary."""
    text = "\n".join(lines)
    return {name for name in LIBM
            if re.search(rf"\b(?!return\b|else\b)[A-Za-z_]\w*\s+{name}\s*\(", text)
            or re.search(rf"using\s+(?:delos::)?elementary::{name}\s*;", text)}


def libm_call(line, own):
    """The name of the C library function that this line calls, or None."""
    for pattern in (LIBM_CALL, ARRAY_LIBM):
        if found := pattern.search(line):
            return found.group(1)
    for found in BARE_LIBM.finditer(line):
        if found.group(1) not in own:
            return found.group(1)
    return None


def check_lines(path, layer, lines, raw_lines):
    own = own_names(lines)
    for number, (line, raw) in enumerate(zip(lines, raw_lines), 1):
        where = f"{path}:{number}"
        text = raw if raw.lstrip().startswith("#include") else line
        for name, pattern, homes in HOMES:
            if re.search(pattern, text) and not any(path.startswith(home) for home in homes):
                yield name, f"{where}: {name} belongs to {' and '.join(homes)} only"
        if layer in GRID_PATH and not path.startswith("component/core/elementary."):
            call = libm_call(line, own)
            if call and not (call == "fma" and path == FMA_HOME):
                yield "libm", (f"{where}: {call} of the C library on the path to the grid; "
                               "its bits differ between systems, use delos::elementary")
            if re.search(r"\bstd::execution\b|#include\s*<thread>|\bstd::async\b|\bomp\b", text):
                yield "threads", f"{where}: threads only through core/parallel"
        if layer == "time" and WORLD.search(text):
            yield "clock", f"{where}: model time knows neither the machine's clock nor its locale"
        if layer != "app":
            if PRINTS.search(text):
                yield "print", f"{where}: the library never prints; log through the monitor"
            if ENDS_PROCESS.search(line):
                yield "process", f"{where}: the library never ends or changes its host's process"


def check_cmake(root):
    """The DEPENDS of each layer's CMakeLists.txt must say the same as the table above."""
    for layer, below in BELOW.items():
        lists = root / "component" / layer / "CMakeLists.txt"
        if not lists.exists():
            continue
        found = re.search(r"delos_layer\([^)]*DEPENDS([^)]*?)(?:LIBRARIES|SOURCES|\))",
                          lists.read_text())
        for name in found.group(1).split() if found else []:
            if name not in below:
                yield "cmake", f"component/{layer}/CMakeLists.txt: {layer} must not depend on {name}"


def violations(root):
    component = root / "component"
    for folder in sorted(p for p in component.iterdir()
                         if p.is_dir() and p.name not in NO_LAYERS):
        if folder.name not in BELOW:
            yield "layer", f"component/{folder.name}: unknown layer; give it a place in layering.py"
        elif any(folder.glob("*.?pp")) and not (folder / "README.md").exists():
            yield "readme", f"component/{folder.name}: no README.md"
    yield from check_cmake(root)
    files = [*component.rglob("*.?pp"), *(root / "interfaces").rglob("*.?pp")]
    for file in sorted(files):
        path = file.relative_to(root).as_posix()
        layer = path.split("/")[1] if path.startswith("component/") else "interfaces"
        if layer not in BELOW and layer != "interfaces":
            continue
        text = file.read_text()
        raw_lines = text.splitlines()
        if not text.startswith("// SPDX-License-Identifier:"):
            yield "licence", f"{path}:1: no SPDX line"
        yield from check_includes(path, layer, raw_lines)
        yield from check_lines(path, layer, stripped(text), raw_lines)


PLANTED = [
    ("include", "component/geometry/bad.cpp", '#include "refine/refine.hpp"\n'),
    ("include", "component/refine/bad.cpp", '#include "relax/relax.hpp"\n'),
    ("include", "component/time/bad.cpp", '#include "geometry/ellipsoid.hpp"\n'),
    ("include", "component/geometry/bad.cpp", '#include "time/clock.hpp"\n'),
    ("include", "interfaces/cpp/delos/bad.cpp", '#include "app/main.hpp"\n'),
    ("oneTBB", "component/relax/bad.cpp", "void f() { tbb::parallel_for(0, 1, g); }\n"),
    ("oneTBB", "component/core/bad.cpp", "#include <oneapi/tbb/task_arena.h>\n"),
    ("netCDF", "component/io/bad.cpp", 'int f() { return nc_close (3); }\n'),
    ("yaml-cpp", "component/lifecycle/bad.cpp", "YAML::Node node;\n"),
    ("cairo", "component/pictures/bad.cpp", "cairo_t* c;\nvoid f() { cairo_fill(c); }\n"),
    ("OpenSSL", "component/io/bad.cpp", "#include <openssl/evp.h>\n"),
    ("METIS", "component/partition/bad.cpp", "#include <metis.h>\n"),
    ("shapelib", "component/io/bad.cpp", "#include <shapefil.h>\n"),
    ("MPI", "interfaces/cpp/bad.cpp", "#include <mpi.h>\n"),
    ("CLI11", "component/lifecycle/bad.cpp", "#include <CLI/CLI.hpp>\n"),
    ("libm", "component/sizing/bad.cpp", "double f(double x) { return std::sin(x); }\n"),
    ("libm", "component/relax/bad.cpp", "double f(double x) { return 2.0 * pow(x, 3); }\n"),
    ("libm", "component/dual/bad.cpp", "double f(double x) { return std::fma(x, x, x); }\n"),
    ("threads", "component/refine/bad.cpp", "#include <thread>\n"),
    ("clock", "component/time/bad.cpp", "#include <chrono>\n"),
    ("clock", "component/time/bad.cpp", "double f(const char* t) { return std::stod(t); }\n"),
    ("print", "component/metrics/bad.cpp", 'void f() { std::cout << "x"; }\n'),
    ("print", "component/io/bad.cpp", 'void f() { printf("x"); }\n'),
    ("process", "component/lifecycle/bad.cpp", "void f() { std::exit(1); }\n"),
    ("cmake", "component/geometry/CMakeLists.txt", "delos_layer(geometry DEPENDS core sizing)\n"),
    ("layer", "component/misc/bad.cpp", "int x;\n"),
    ("licence", "component/core/bad.cpp", None),
    ("readme", "component/dual/README.md", None),
]
HARMLESS = """// SPDX-License-Identifier: BSD-3-Clause
// std::sin( in a comment, tbb:: and nc_open( too
#include "core/types.hpp"
#include <cmath>
const char* text = "std::cout << tbb::x, nc_close(1), std::exit(1)";
double f(double x) { return elementary::sin(x) + std::sqrt(x) + std::abs(x) + delos::elementary::exp(x); }
double log(double x);
double g(const Table& table) { return table.log(3) + catalogue.exp(2); }
"""


def clean_tree(root):
    for layer in BELOW:
        folder = root / "component" / layer
        folder.mkdir(parents=True)
        (folder / "README.md").write_text("x\n")
        (folder / "good.cpp").write_text(HARMLESS if layer != "misc" else "")
    (root / "interfaces" / "cpp" / "delos").mkdir(parents=True)


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        clean_tree(root)
        noise = list(violations(root))
        assert not noise, f"a clean tree is reported: {noise}"
    for rule, path, text in PLANTED:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            clean_tree(root)
            target = root / path
            target.parent.mkdir(parents=True, exist_ok=True)
            if text is None and target.exists():
                target.unlink()
            else:
                head = "" if text is None or path.endswith(".txt") else \
                    "// SPDX-License-Identifier: BSD-3-Clause\n"
                target.write_text(head + (text or "int x;\n"))
            found = {name for name, _ in violations(root)}
            assert found == {rule}, f"planted '{rule}' in {path}: reported {found or 'nothing'}"
    print(f"layering: each of {len(PLANTED)} planted violations is found, and nothing else")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return 0
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    found = list(violations(root))
    for rule, message in found:
        print(f"{message} [{rule}]")
    print(f"layering: {len(found)} violations under {root.name}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
