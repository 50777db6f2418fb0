// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small finished grids, and what a file says about them.
#include "core/progress.hpp"
#include "dual/build.hpp"
#include "geometry/conformal.hpp"
#include "io/provenance.hpp"
#include "support/sample_meshes.hpp"

namespace delos::samples {

inline Grid grid_of(const Ellipsoid& surface, const Mesh& mesh) {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  return build_grid(context, surface, LatitudeKind::geodetic, mesh);
}

/// The same triangles on the sphere.
inline Mesh on_sphere(const SphereMap& map, Mesh mesh) {
  for (Vertex& vertex : mesh.vertices) {
    const double stretch = map.stretch(vertex.position());
    const Vec3 image = map(vertex.position());
    vertex = {image.x(), image.y(), image.z(), vertex.spacing * stretch};
  }
  return mesh;
}

inline Provenance provenance() {
  Provenance result;
  result.version = "1.2.3";
  result.config = "sizing:\n  - constant: 240 km";
  result.digest = std::string(64, 'a');
  result.inputs = {{"depth of the sea.nc", std::string(64, 'b')}, {"b.nc", std::string(64, 'c')}};
  result.history = history_line(0, "delos mesh a.yaml");
  result.certificate = FileCertificate{0.75,
                                       3,
                                       {91.5, {6, kNone}, {-180.0, 12.5}},
                                       {0.25, {2, 3}, {10.0, -90.0}},
                                       {0.125, {0, 9}, {0.1, 0.2}},
                                       FileExtreme{0.7, {4, 5}, {20.0, 30.0}}};
  return result;
}

}  // namespace delos::samples
