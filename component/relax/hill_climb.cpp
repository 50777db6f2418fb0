// SPDX-License-Identifier: BSD-3-Clause
#include "relax/hill_climb.hpp"

#include <algorithm>
#include <cmath>

namespace delos {
namespace {

constexpr double kActiveBand = 0.02;  // triangles this near to the worst pull at the vertex too
constexpr double kLeastGain = 1e-4;   // of the score, for a move to count
constexpr std::array<double, 5> kSteps = {0.16, 0.08, 0.04, 0.02, 0.01};  // times the spacing
constexpr double kSpringStep = 0.15;  // of the spring force, per sweep

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

class Climber {
 public:
  Climber(const Target& target, Patch& patch)
      : target_(target), patch_(patch), stars_(patch::stars(patch)) {}

  // Least score of the star with its vertex at p.
  double star_score(Index vertex, const Vertex& p) const {
    double least = 1.0;
    for_star(vertex, [&](const Vertex& from, const Vertex& to) {
      least = std::min(least, triangle_score(p, from, to));
    });
    return least;
  }

  bool improve(Index vertex, double enough) {
    const Vertex p = patch_.vertex(vertex);
    const double before = star_score(vertex, p);
    if (before >= enough) return false;
    for (const Vec3& direction : {quality_direction(vertex, before), spring_force(vertex)}) {
      const double length = std::sqrt(direction.squaredNorm());
      if (length == 0.0) continue;
      for (const double step : kSteps) {
        const Vertex q = moved(p, (step * p.spacing / length) * direction);
        if (star_score(vertex, q) > before + kLeastGain) {
          patch_.vertices[at(vertex)] = q;
          return true;
        }
      }
    }
    return false;
  }

  void spring(Index vertex, double floor) {
    const Vertex p = patch_.vertex(vertex);
    const Vertex q = moved(p, kSpringStep * spring_force(vertex));
    const double after = star_score(vertex, q);
    if (after >= floor || after > star_score(vertex, p)) patch_.vertices[at(vertex)] = q;
  }

 private:
  // visit(from, to) for the ring sides of the star, counter-clockwise each.
  template <class Visit>
  void for_star(Index vertex, const Visit& visit) const {
    for (Index i = stars_.offsets[at(vertex)]; i < stars_.offsets[at(vertex) + 1]; ++i) {
      const Index corner = stars_.corners[at(i)];
      const Triangle& t = patch_.triangle(corner / 3);
      const int k = static_cast<int>(corner % 3);
      visit(patch_.vertex(t.vertex[at(next_corner(k))]),
            patch_.vertex(t.vertex[at(previous_corner(k))]));
    }
  }

  Vertex moved(const Vertex& p, const Vec3& step) const {
    const Vec3 q = target_.surface.project(p.position() + step);
    return {q.x(), q.y(), q.z(), target_.spacing.at(q.x(), q.y(), q.z())};
  }

  // Sum of the gradients of a_f = c A / S, S the sum of the squared sides, over the triangles whose
  // score is within the band of the worst: grad a_f = c (grad A - A grad S / S) / S.
  Vec3 quality_direction(Index vertex, double worst) const {
    const Vertex& v = patch_.vertex(vertex);
    const Vec3 p = v.position();
    Vec3 sum(0, 0, 0);
    for_star(vertex, [&](const Vertex& from, const Vertex& to) {
      if (triangle_score(v, from, to) > worst + kActiveBand) return;
      const Vec3 a = from.position(), b = to.position();
      const Vec3 base = b - a;
      const Vec3 normal = (a - p).cross(b - p);
      const double twice_area = std::sqrt(normal.squaredNorm());
      if (twice_area == 0.0) return;
      const double squares = base.squaredNorm() + (p - a).squaredNorm() + (p - b).squaredNorm();
      const Vec3 area_gradient = 0.5 * (normal / twice_area).cross(base);
      const Vec3 squares_gradient = 2.0 * (2.0 * p - a - b);
      sum +=
          (area_gradient - (0.5 * twice_area / squares) * squares_gradient) * (v.spacing / squares);
    });
    return sum;
  }

  Vec3 spring_force(Index vertex) const {
    const Vertex& p = patch_.vertex(vertex);
    Vec3 force(0, 0, 0);
    for_star(vertex, [&](const Vertex& from, const Vertex&) {
      const Vec3 offset = from.position() - p.position();
      const double length = std::sqrt(offset.squaredNorm());
      force += (1.0 - 0.5 * (p.spacing + from.spacing) / length) * offset;
    });
    return force;
  }

  const Target& target_;
  Patch& patch_;
  patch::Stars stars_;
};

}  // namespace

void hill_climb(const Target& target, const ClimbOptions& options, Patch& patch) {
  Climber climber(target, patch);
  bool has_moved = true;
  for (int sweep = 0; has_moved && sweep < options.sweeps; ++sweep) {
    has_moved = false;
    for (Index v = 0; v < patch.n_free; ++v) has_moved |= climber.improve(v, options.enough);
  }
}

void relax_patch(const Target& target, const SpringOptions& options, Patch& patch) {
  Climber climber(target, patch);
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    for (Index v = 0; v < patch.n_free; ++v) climber.spring(v, options.floor);
  }
}

}  // namespace delos
