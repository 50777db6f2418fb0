#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes bathymetry_half_degree.i16 from ETOPO5 (Debian: ferret-datasets, python3-netcdf4, python3-numpy).

    ./make_embedded_bathymetry.py [etopo5.cdf [bathymetry_half_degree.i16]]

ETOPO5 has its values at nodes every 1/12 degree, poles included; a node stands for the 1/12 degree
around it. Each half-degree cell gets the mean over its area, so nodes on a side count half. The file
is 360 rows from south to north of 720 columns from -180 degrees eastward, int16 little-endian, metres,
rounded half to even.
"""
import os
import sys

import netCDF4
import numpy as np

N_ROWS, N_COLUMNS, PER_CELL = 360, 720, 6

source = sys.argv[1] if len(sys.argv) > 1 else "/usr/share/ferret-vis/data/etopo5.cdf"
target = (sys.argv[2] if len(sys.argv) > 2 else
          os.path.join(os.path.dirname(os.path.abspath(__file__)), "bathymetry_half_degree.i16"))

with netCDF4.Dataset(source) as dataset:
    nodes = dataset["ROSE"][:].filled(np.nan).astype(np.float64)
assert nodes.shape == (2161, 4320) and np.isfinite(nodes).all()

# Means along longitude; column 0 of the result begins at -180 degrees.
nodes = np.roll(nodes, 2160, axis=1)
nodes = np.concatenate([nodes, nodes[:, :1]], axis=1)
along = np.array([0.5, 1, 1, 1, 1, 1, 0.5]) / PER_CELL
strips = sum(along[k] * nodes[:, k:k + N_COLUMNS * PER_CELL:PER_CELL] for k in range(PER_CELL + 1))

# Means along latitude, weighted with the area between the parallels that bound each node's share.
cells = np.empty((N_ROWS, N_COLUMNS))
node_lat = -90.0 + np.arange(2161) / 12.0
for row in range(N_ROWS):
    south, north = -90.0 + 0.5 * row, -89.5 + 0.5 * row
    rows = slice(row * PER_CELL, row * PER_CELL + PER_CELL + 1)
    low = np.maximum(node_lat[rows] - 1.0 / 24.0, south)
    high = np.minimum(node_lat[rows] + 1.0 / 24.0, north)
    weight = np.sin(np.radians(high)) - np.sin(np.radians(low))
    cells[row] = weight @ strips[rows] / weight.sum()

np.rint(cells).astype("<i2").tofile(target)
