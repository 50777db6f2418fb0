#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints what another reader finds in a mesh file, as "key value" lines.

    read_mesh.py meshio|vtk|gmsh FILE     n_points, n_cells, area (of triangles, flat, in the file's
                                          unit squared), n_border (edges of one cell), n_other (edges
                                          of more than two), and the sum of every array of cells
    read_mesh.py --has meshio|vtk|gmsh    exit 1 where Debian's Python lacks the module
"""
import collections
import importlib.util
import math
import sys


def describe(points, cells, arrays):
    sides = collections.Counter()
    area = 0.0
    for cell in cells:
        sides.update(frozenset(pair) for pair in zip(cell, (*cell[1:], cell[0])))
        if len(cell) == 3:
            a, b, c = (points[i] for i in cell)
            u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
            area += 0.5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                     u[0] * v[1] - u[1] * v[0])
    print("n_points", len(points))
    print("n_cells", len(cells))
    print("area", repr(area))
    print("n_border", sum(1 for n in sides.values() if n == 1))
    print("n_other", sum(1 for n in sides.values() if n > 2))
    for name, values in arrays.items():
        print(name, repr(math.fsum(values)))


def by_meshio(path):
    import meshio
    mesh = meshio.read(path)
    cells = [[int(i) for i in cell] for block in mesh.cells for cell in block.data]
    arrays = {name: [float(v) for block in blocks for v in block]
              for name, blocks in mesh.cell_data.items() if blocks[0].ndim == 1}
    describe([[float(x) for x in p] for p in mesh.points], cells, arrays)


def by_vtk(path):
    import vtk
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    cells = []
    for i in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(i).GetPointIds()
        cells.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
    data = grid.GetCellData()
    arrays = {}
    for k in range(data.GetNumberOfArrays()):
        array = data.GetArray(k)
        if array.GetNumberOfComponents() == 1:
            arrays[array.GetName()] = [array.GetValue(i) for i in range(array.GetNumberOfTuples())]
    describe([grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())], cells, arrays)


def by_gmsh(path):
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.AbortOnError", 2)
    gmsh.open(path)
    tags, flat, _ = gmsh.model.mesh.getNodes()
    place = {int(tag): i for i, tag in enumerate(tags)}
    points = [tuple(flat[3 * i:3 * i + 3]) for i in range(len(tags))]
    cells = []
    for kind, nodes in zip(*(gmsh.model.mesh.getElements()[k] for k in (0, 2))):
        n = gmsh.model.mesh.getElementProperties(kind)[3]
        cells += [[place[int(tag)] for tag in nodes[k:k + n]] for k in range(0, len(nodes), n)]
    describe(points, cells, {})
    gmsh.finalize()


def main():
    if sys.argv[1] == "--has":
        return 0 if importlib.util.find_spec(sys.argv[2]) else 1
    {"meshio": by_meshio, "vtk": by_vtk, "gmsh": by_gmsh}[sys.argv[1]](sys.argv[2])
    return 0


if __name__ == "__main__":
    sys.exit(main())
