// SPDX-License-Identifier: BSD-3-Clause
// Given points and lines in the grid: on spheres and ellipsoids, over the date line and a pole.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "refine/refine.hpp"
#include "relax/relax.hpp"
#include "support/sample_spacings.hpp"
#include "triangulation/flip.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

using Kind = GivenLine::Kind;
using Degrees = std::vector<std::array<double, 2>>;

GivenLine line_of(const Ellipsoid& surface, const std::string& name, Kind kind,
                  const Degrees& lon_lat_deg) {
  GivenLine out{name, kind, {}};
  for (const auto& [lon, lat] : lon_lat_deg) {
    out.points.push_back(
        surface.point({lon * kRadPerDeg, lat * kRadPerDeg}, LatitudeKind::geodetic));
  }
  return out;
}

struct LineSample {
  std::string name;
  Ellipsoid surface;
  SpacingField spacing;
  std::vector<GivenLine> lines;
};

// Rough as a coast is: corners between 70 and 290 degrees.
Degrees coast(double lon, double lat, double radius) {
  Degrees out;
  for (int i = 0; i < 24; ++i) {
    const double r = radius * (i % 4 == 0 ? 0.8 : i % 4 == 2 ? 1.15 : 1.0);
    const double angle = i * kPi / 12.0;
    out.push_back(
        {lon + r * std::cos(angle) / std::cos(lat * kRadPerDeg), lat + r * std::sin(angle)});
  }
  return out;
}

std::vector<LineSample> line_samples() {
  const Ellipsoid earth = Ellipsoid::sphere(6371220.0), wgs84 = Ellipsoid::wgs84();
  const Ellipsoid flat(Vec3(1.0, 0.7, 0.4) * 6371220.0, Vec3(0, 0, 0));
  const auto constant = [](const Ellipsoid& surface, double spacing_m) {
    return SpacingField::constant(surface, spacing_m);
  };
  const auto patch = [](double lon, double lat, Index, Index) {
    const double d2 = (lon + 40.0) * (lon + 40.0) + (lat - 35.0) * (lat - 35.0);
    return 1e3 * (400.0 - 280.0 * std::exp(-d2 / 800.0));
  };
  const Degrees moorings = {{-60, 20},   {-50, 22}, {-40, 24}, {-35, 24}, {-30, 26},
                            {-42.5, 30}, {180, 0},  {0, 90},   {0, -90},  {-70, -70}};
  return {{"meridian",
           earth,
           constant(earth, 240e3),
           {line_of(earth, "section", Kind::line, {{-30, -90}, {-30, 0}, {-30, 65}})}},
          {"coast",
           earth,
           constant(earth, 200e3),
           {line_of(earth, "coast", Kind::ring, coast(-40.0, 35.0, 25.0))}},
          {"moorings",
           earth,
           constant(earth, 240e3),
           {line_of(earth, "moorings", Kind::points, moorings)}},
          {"date line",
           wgs84,
           constant(wgs84, 250e3),
           {line_of(wgs84, "coast", Kind::ring, coast(179.0, -20.0, 18.0)),
            line_of(wgs84, "section", Kind::line, {{150, 30}, {-150, 25}})}},
          {"pole",
           earth,
           constant(earth, 200e3),
           {line_of(earth, "arctic", Kind::line, {{20, 80}, {-160, 75}}),
            line_of(earth, "coast", Kind::ring,
                    {{0, 70}, {60, 65}, {120, 72}, {180, 68}, {-120, 70}, {-60, 66}})}},
          {"crossing",
           earth,
           sample_table(earth, patch),
           {line_of(earth, "east", Kind::line, {{-80, 30}, {-10, 30}}),
            line_of(earth, "north", Kind::line, {{-40, 0}, {-41, 65}}),
            line_of(earth, "fork", Kind::line, {{-40, 0}, {-10, 55}})}},
          {"1 : 0.7 : 0.4",
           flat,
           constant(flat, 250e3),
           {line_of(flat, "ring", Kind::ring, coast(30.0, 20.0, 30.0)),
            line_of(flat, "moorings", Kind::points, {{-60, 20}, {-50, 0}, {100, -50}})}}};
}

Index vertex_at(const Mesh& mesh, const Vec3& p) {
  for (Index v = 0; v < mesh.fixed.n_vertices(); ++v) {
    if (mesh.position(v) == p) return v;
  }
  return kNone;
}

std::set<std::pair<Index, Index>> edges_of(const Mesh& mesh) {
  std::set<std::pair<Index, Index>> out;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) out.emplace(t.vertex[k], t.vertex[(k + 1) % 3]);
  }
  return out;
}

// Walks along fixed edges that lie on the arc from p to q; the number of edges, 0 when it fails.
int walk_arc(const Mesh& mesh, Index from, Index to) {
  const Vec3 p = mesh.position(from), q = mesh.position(to);
  const Vec3 normal = p.cross(q).normalized();
  int n = 0;
  for (Index at = from, next = kNone; at != to; at = next, ++n) {
    const auto begin = static_cast<std::size_t>(mesh.fixed.offsets[static_cast<std::size_t>(at)]);
    const auto end = static_cast<std::size_t>(mesh.fixed.offsets[static_cast<std::size_t>(at) + 1]);
    next = kNone;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 r = mesh.position(mesh.fixed.ends[i]);
      if (std::abs(normal.dot(r)) < 1e-9 && mesh.position(at).cross(r).dot(normal) > 0.0 &&
          (r - q).norm() < (mesh.position(at) - q).norm()) {
        next = mesh.fixed.ends[i];
      }
    }
    if (next == kNone) return 0;
  }
  return n;
}

void check_lines(const Mesh& mesh, const std::vector<GivenLine>& lines) {
  const auto edges = edges_of(mesh);
  for (Index v = 0; v < mesh.fixed.n_vertices(); ++v) {
    for (Index i = mesh.fixed.offsets[static_cast<std::size_t>(v)];
         i < mesh.fixed.offsets[static_cast<std::size_t>(v) + 1]; ++i) {
      const Index end = mesh.fixed.ends[static_cast<std::size_t>(i)];
      CHECK(edges.count({v, end}) == 1);
    }
  }
  for (const GivenLine& line : lines) {
    CAPTURE(line.name);
    std::vector<Index> ids;
    for (const Vec3& p : line.points) ids.push_back(vertex_at(mesh, p));
    CHECK(std::count(ids.begin(), ids.end(), kNone) == 0);
    if (line.kind == Kind::points) continue;
    if (line.kind == Kind::ring) ids.push_back(ids.front());
    for (std::size_t i = 1; i < ids.size(); ++i) CHECK(walk_arc(mesh, ids[i - 1], ids[i]) > 0);
  }
}

// Middles of the triangles that are not acute.
std::vector<Vec3> obtuse_places(const Mesh& mesh) {
  std::vector<Vec3> out;
  for (const Triangle& t : mesh.triangles) {
    Vec3 sum(0, 0, 0);
    bool is_obtuse = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.position(t.vertex[k]);
      const Vec3 u = mesh.position(t.vertex[(k + 1) % 3]) - p;
      is_obtuse |= u.dot(mesh.position(t.vertex[(k + 2) % 3]) - p) <= 0.0;
      sum += p / 3.0;
    }
    if (is_obtuse) out.push_back(sum);
  }
  return out;
}

Mesh refined_with(Context& context, const LineSample& sample, RefineReport& report) {
  RefineOptions options;
  options.tile_vertices = 1000.0;  // so that lines cross sides and corners of tiles
  options.lines = sample.lines;
  return refine(context, sample.surface, sample.spacing, options, report);
}

}  // namespace

TEST_CASE("given points and lines are vertices and edges before and after relaxation") {
  for (const LineSample& sample : line_samples()) {
    CAPTURE(sample.name);
    TestRun run(2);
    RefineReport refined;
    Mesh mesh = refined_with(run.context, sample, refined);
    ValidateOptions options;
    options.delaunay = false;
    CHECK(summary(validate(mesh, sample.surface, options)) == "");
    check_lines(mesh, sample.lines);
    const RelaxReport report = relax(run.context, sample.surface, sample.spacing, {}, mesh);
    CHECK(summary(validate(mesh, sample.surface)) == "");
    check_lines(mesh, sample.lines);
    CHECK(report.n_below_target < mesh.n_triangles() / 50);
    for (const Vec3& p : obtuse_places(mesh)) {
      // Only where lines meet at a small angle.
      const double reach = 4.0 * sample.spacing.at(p.x(), p.y(), p.z());
      CHECK(std::any_of(refined.sharp_corners.begin(), refined.sharp_corners.end(),
                        [&](const auto& corner) { return (corner.place - p).norm() < reach; }));
    }
  }
}

TEST_CASE("lines refine and relax to the same bits with 1, 2, 5 and 8 threads") {
  for (const LineSample& sample : line_samples()) {
    CAPTURE(sample.name);
    const auto bits = [&](int threads) {
      TestRun run(threads);
      RefineReport report;
      Mesh mesh = refined_with(run.context, sample, report);
      relax(run.context, sample.surface, sample.spacing, {}, mesh);
      return digest(mesh);
    };
    const std::string one = bits(1);
    for (const int threads : {2, 5, 8}) CHECK(bits(threads) == one);
  }
}

TEST_CASE("far from the lines a grid is as good as without them") {
  const LineSample sample = line_samples()[0];
  TestRun run(2);
  RefineReport report;
  Mesh with = refined_with(run.context, sample, report);
  const RelaxReport relaxed = relax(run.context, sample.surface, sample.spacing, {}, with);
  RefineOptions options;
  options.tile_vertices = 1000.0;
  const Mesh without = refine(run.context, sample.surface, sample.spacing, options, report);
  CHECK(relaxed.n_below_target == 0);
  CHECK(with.n_vertices() == doctest::Approx(without.n_vertices()).epsilon(0.01));
}

TEST_CASE("lines that can't be kept are refused with both their names and the place") {
  const Ellipsoid earth = Ellipsoid::sphere(6371220.0);
  const SpacingField spacing = SpacingField::constant(earth, 240e3);
  const auto message = [&](const std::vector<GivenLine>& lines) -> std::string {
    TestRun run(1);
    RefineReport report;
    RefineOptions options;
    options.lines = lines;
    try {
      refine(run.context, earth, spacing, options, report);
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::input);
      return error.what();
    }
    return "no error";
  };
  const auto line = [&](const char* name, const Degrees& points) {
    return line_of(earth, name, Kind::line, points);
  };
  const auto has = [](const std::string& text, const std::vector<std::string>& parts) {
    CAPTURE(text);
    for (const std::string& part : parts) CHECK(text.find(part) != std::string::npos);
  };
  has(message({line("a", {{0, 0}, {40, 0}}), line("b", {{0, 1}, {40, 1}})}),
      {"a and b are ", "km apart at lon", "spacing is 240 km"});
  has(message({line("a", {{0, 0}, {40, 0}}), line("b", {{0, 0}, {40, 3}})}),
      {"a and b meet at ", " degrees at lon 0, lat 0 deg"});
  has(message({line("a", {{0, 0}, {40, 0}}), line("b", {{10, 1}, {10, -20}})}),
      {"a and b cross at lon 10", "from the point at lon 10, lat 1 deg"});
  has(message({line("a", {{0, 0}, {179, 0}})}), {"a: its points at", "170 degrees"});
  has(message({line_of(earth, "p", Kind::points, {{0, 0}, {1, 0}})}), {"p and p are ", "apart"});
}
