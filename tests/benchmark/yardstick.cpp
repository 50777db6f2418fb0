// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/yardstick.hpp"

#ifdef DELOS_HAS_CGAL
#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>
#endif

namespace delos::benchmark {

#ifdef DELOS_HAS_CGAL
void run_yardstick(Monitor& monitor, std::span<const Vec3> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;
  std::vector<Kernel::Point_3> sites;
  sites.reserve(points.size());
  for (const Vec3& p : points) sites.emplace_back(p.x(), p.y(), p.z());
  const Phase phase(monitor, "cgal", static_cast<std::int64_t>(sites.size()));
  const Traits traits(Kernel::Point_3(0, 0, 0), 1.0);
  const CGAL::Delaunay_triangulation_on_sphere_2<Traits> mesh(sites.begin(), sites.end(), traits);
  monitor.advance(static_cast<std::int64_t>(mesh.number_of_vertices()));
}
#else
void run_yardstick(Monitor&, std::span<const Vec3>) {}
#endif

}  // namespace delos::benchmark
