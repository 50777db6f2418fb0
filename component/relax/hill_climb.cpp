// SPDX-License-Identifier: BSD-3-Clause
#include "relax/hill_climb.hpp"

#include <algorithm>
#include <cmath>

namespace delos {
namespace {

constexpr double kActiveBand = 0.02;  // what is this near to the worst pulls at the vertex too
constexpr double kLeastGain = 1e-4;   // of the score, for a move to count
constexpr std::array<double, 5> kSteps = {0.16, 0.08, 0.04, 0.02, 0.01};  // times the spacing
constexpr double kSpringStep = 0.15;  // of the spring force, per sweep
// a_f = kSidesAreaLength * area / S, S the sum of the squared sides.
const double kSidesAreaLength = 4.0 * std::sqrt(3.0);

// What surrounds one vertex, in an array of its own: ring vertex i and the next make triangle i.
struct Ring {
  std::vector<Vertex> vertices;
  std::vector<double> cot_beyond;  // of the angle opposite to ring side i, outside the star
  std::vector<Cotangents> cot;     // of triangle i at the centre, at i and at i + 1: scratch

  std::size_t size() const { return vertices.size(); }
  const Vertex& from(std::size_t i) const { return vertices[i]; }
  const Vertex& to(std::size_t i) const { return vertices[i + 1 < size() ? i + 1 : 0]; }
};

class Climber {
 public:
  Climber(const Target& target, Patch& patch)
      : target_(target), patch_(patch), stars_(patch::stars(patch)) {}

  // Moves the vertex if that raises the worst score of its star; `enough` needs no raising.
  bool improve(Index vertex, double enough) {
    const Vertex p = patch_.vertex(vertex);
    load_ring(vertex);
    const double before = ring_score(p);
    if (before >= enough) return false;
    for (const Vec3& direction : {quality_direction(p, before), spring_force(p)}) {
      const double length = std::sqrt(direction.squaredNorm());
      if (length == 0.0) continue;
      for (const double step : kSteps) {
        const Vertex q = moved(p, (step * p.spacing / length) * direction);
        if (ring_score(q) > before + kLeastGain) {
          patch_.vertices[at(vertex)] = q;
          return true;
        }
      }
    }
    return false;
  }

  void spring(Index vertex, double floor) {
    const Vertex p = patch_.vertex(vertex);
    load_ring(vertex);
    const Vertex q = moved(p, kSpringStep * spring_force(p));
    const double after = ring_score(q);
    if (after >= floor || after > ring_score(p)) patch_.vertices[at(vertex)] = q;
  }

 private:
  void load_ring(Index vertex) {
    ring_.vertices.clear();
    ring_.cot_beyond.clear();
    for (Index i = stars_.offsets[at(vertex)]; i < stars_.offsets[at(vertex) + 1]; ++i) {
      const Index tri = stars_.corners[at(i)] / 3;
      const int k = static_cast<int>(stars_.corners[at(i)] % 3);
      const Triangle& t = patch_.triangle(tri);
      const Vertex& from = patch_.vertex(t.vertex[at(next_corner(k))]);
      const Vertex& to = patch_.vertex(t.vertex[at(previous_corner(k))]);
      ring_.vertices.push_back(from);
      ring_.cot_beyond.push_back(cotangent(patch_.across(tri, k), to, from));
    }
    ring_.cot.resize(ring_.size());
  }

  // Least score of the star with its vertex at p: of its triangles, of the sides between them, and
  // of those to the triangles outside.
  double ring_score(const Vertex& p) {
    double least = 1.0;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const Vertex &from = ring_.from(i), &to = ring_.to(i);
      least = std::min(least, triangle_score(p, from, to));
      ring_.cot[i] = cotangents(p.position(), from.position(), to.position());
      least = std::min(least, side_score(ring_.cot[i][0], ring_.cot_beyond[i]));
    }
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      least = std::min(least, side_score(ring_.cot[i][2], before(i)[1]));
    }
    return least;
  }

  // The cotangents of the triangle that shares the side from the centre to ring vertex i.
  const Cotangents& before(std::size_t i) const {
    return ring_.cot[i > 0 ? i - 1 : ring_.size() - 1];
  }

  Vertex moved(const Vertex& p, const Vec3& step) const {
    const Vec3 q = target_.surface.project(p.position() + step);
    return {q.x(), q.y(), q.z(), target_.spacing.at(q.x(), q.y(), q.z())};
  }

  // Gradients, with respect to the centre, of what ring_score() compares.
  struct Gradients {
    Vec3 area_length;
    std::array<Vec3, 3> cot;
  };

  // a_f = K A / S: grad a_f = K (grad A - A grad S / S) / S. A cotangent is D / 2A, D the product
  // of the two sides at its corner: grad cot = (grad D - cot grad 2A) / 2A.
  Gradients gradients(const Vec3& p, std::size_t i) const {
    const Vec3 a = ring_.from(i).position(), b = ring_.to(i).position();
    const Vec3 base = b - a;
    const Vec3 normal = (a - p).cross(b - p);
    const double twice_area = std::sqrt(normal.squaredNorm());
    const double squares = base.squaredNorm() + (p - a).squaredNorm() + (p - b).squaredNorm();
    const Vec3 twice_area_gradient = (normal / twice_area).cross(base);
    const Vec3 squares_gradient = 2.0 * (2.0 * p - a - b);
    Gradients out;
    out.area_length = (0.5 * kSidesAreaLength / squares) *
                      (twice_area_gradient - (twice_area / squares) * squares_gradient);
    const std::array<Vec3, 3> product = {2.0 * p - a - b, base, -base};
    for (std::size_t k = 0; k < 3; ++k) {
      out.cot[k] = (product[k] - ring_.cot[i][k] * twice_area_gradient) / twice_area;
    }
    return out;
  }

  // Sum of the gradients of all that is within the band of the worst; leaves ring_.cot as at v.
  Vec3 quality_direction(const Vertex& v, double worst) {
    const Vec3 p = v.position();
    ring_score(v);
    std::vector<Gradients> all;
    for (std::size_t i = 0; i < ring_.size(); ++i) all.push_back(gradients(p, i));
    Vec3 sum(0, 0, 0);
    const auto add_side = [&](double cot, double other, const Vec3& gradient) {
      if (side_score(cot, other) > worst + kActiveBand) return;
      sum += (cot > other ? -kSideWeight : kSideWeight) * gradient;
    };
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      if (triangle_score(v, ring_.from(i), ring_.to(i)) <= worst + kActiveBand) {
        sum += all[i].area_length;
      }
      const std::size_t previous = i > 0 ? i - 1 : ring_.size() - 1;
      add_side(ring_.cot[i][0], ring_.cot_beyond[i], all[i].cot[0]);
      add_side(ring_.cot[i][2], ring_.cot[previous][1], all[i].cot[2] - all[previous].cot[1]);
    }
    return sum.allFinite() ? sum : Vec3(0, 0, 0);
  }

  Vec3 spring_force(const Vertex& p) const {
    Vec3 force(0, 0, 0);
    for (const Vertex& from : ring_.vertices) {
      const Vec3 offset = from.position() - p.position();
      const double length = std::sqrt(offset.squaredNorm());
      force += (1.0 - 0.5 * (p.spacing + from.spacing) / length) * offset;
    }
    return force;
  }

  const Target& target_;
  Patch& patch_;
  patch::Stars stars_;
  Ring ring_;
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
