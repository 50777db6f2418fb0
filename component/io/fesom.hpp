// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// FESOM2 meshes: nod2d.out, elem2d.out and aux3d.out of a folder, in ASCII.
#include <functional>
#include <string>
#include <vector>

#include "io/triangle_set.hpp"

namespace delos {

/// Whether the last part of the path ends with nod2d.out, or it is a folder with that file.
bool is_fesom(const std::string& path);

/// nod2d.out (number; id, longitude, latitude in degrees, 1 on the border, else 0), elem2d.out
/// (number; three ids from 1, clockwise as published), and aux3d.out (number of levels, their
/// depths 0, -5, ..., depth at each node, all negative) where the set has depths and levels, into
/// `folder`, which must be there; all or none. Error(output) when a node has no triangle: FESOM2
/// takes none.
void write_fesom(const std::string& folder, const TriangleSet& set);

struct FesomFile {
  std::string name;
  std::function<void(const std::string& path)> write;  ///< refers to the set
};

/// The files of write_fesom, each for itself.
std::vector<FesomFile> fesom_files(const TriangleSet& set);

/// A folder, or its nod2d.out, which may have a prefix that its companions share
/// (pi_nod2d.out, pi_elem2d.out, pi_aux3d.out); aux3d.out may be missing. Corners in the
/// orientation of the file, of which both are in use (orient() settles it). On the sphere with the
/// radius that FESOM2 uses, 6367.5 km. Error(input) "file:line: ..." for what is malformed.
TriangleSet read_fesom(const std::string& path);

}  // namespace delos
