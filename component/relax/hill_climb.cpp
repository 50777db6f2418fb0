// SPDX-License-Identifier: BSD-3-Clause
#include "relax/hill_climb.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace delos {
namespace {

constexpr double kActiveBand = 0.02;  // what is this near to the worst pulls at the vertex too
constexpr double kLeastClimb = 1e-4;  // of the score, for a move to count
constexpr std::array<double, 5> kSteps = {0.16, 0.08, 0.04, 0.02, 0.01};  // times the spacing
constexpr double kSpringStep = 0.15;  // of the spring force, per sweep
// a_f = kSidesAreaLength * area / S, S the sum of the squared sides.
const double kSidesAreaLength = 4.0 * std::sqrt(3.0);
// Bounds that need no root are kept by so much more that rounding can't tell them from the score.
constexpr double kRounding = 1e-9;
constexpr double kNoBound = -std::numeric_limits<double>::infinity();

// A vertex of the ring around another one, and the one beyond the side that follows it.
struct Link {
  const Vertex* ring;
  const Vertex* beyond;
};

// What surrounds one vertex: ring vertex i and the next make triangle i. What does not change while
// the vertex moves is found once, and cheap bounds come before roots.
class Star {
 public:
  /// Links of the vertex, counter-clockwise; they outlive the star.
  void load(std::span<const Link> links) {
    links_ = links;
    resize(links.size());
    has_fixed_ = false;
  }

  /// Puts the centre there: what follows is about that place.
  void place(const Vec3& p) {
    centre_ = p;
    for (std::size_t i = 0; i < size(); ++i) {
      spoke_[i] = ring(i).position() - p;
      spoke_square_[i] = spoke_[i].squaredNorm();
    }
  }

  /// Whether the score is above the target of `limits`, as far as that can be seen at once.
  bool is_clearly_good(double spacing, const ClearlyGood& limits) const {
    for (std::size_t i = 0; i < size(); ++i) {
      const Vertex &from = ring(i), &to = ring(next(i));
      if (!limits.holds(
              centre_, spoke_[i], spoke_[next(i)],
              {spacing + from.spacing, spacing + to.spacing, from.spacing + to.spacing})) {
        return false;
      }
    }
    for (std::size_t i = 0; i < size(); ++i) {
      const Vec3 p = links_[i].beyond->position();
      const Vec3 a = ring(next(i)).position() - p, b = ring(i).position() - p;
      if (!limits.has_angle(a.dot(b), a.cross(b).squaredNorm())) return false;
    }
    return true;
  }

  /// Least score of the star: of its triangles, of the sides between them, and of those to the
  /// triangles outside.
  double score(double spacing) {
    const double least = shape_score(kNoBound);
    return std::min(least, size_score(spacing));
  }

  /// Its part that the spacing has nothing to do with; where that is not above `bound`, anything
  /// that is not.
  double shape_score(double bound) {
    find_fixed();
    double least = 1.0;
    for (std::size_t i = 0; i < size(); ++i) {
      const Vec3 &ab = spoke_[i], &ac = spoke_[next(i)], &bc = base_[i];
      const Vec3 normal = ab.cross(ac);
      const double twice_area = std::sqrt(normal.squaredNorm());
      quality_[i] = quality_of(normal.dot(centre_), twice_area,
                               spoke_square_[i] + spoke_square_[next(i)] + base_square_[i]);
      least = std::min(least, quality_[i]);
      if (least <= bound) return least;
      cot_[i] = {ab.dot(ac) / twice_area, -ab.dot(bc) / twice_area, ac.dot(bc) / twice_area};
      least = std::min(least, side_score(cot_[i][0], cot_beyond_[i]));
    }
    for (std::size_t i = 0; i < size(); ++i) {
      least = std::min(least, side_score(cot_[i][2], cot_[before(i)][1]));
    }
    return least;
  }

  /// Its other part.
  double size_score(double spacing) {
    find_fixed();
    double least = least_base_, most = most_base_;
    for (std::size_t i = 0; i < size(); ++i) {
      spoke_relative_[i] = relative_square(spoke_square_[i], spacing + ring(i).spacing);
      least = std::min(least, spoke_relative_[i]);
      most = std::max(most, spoke_relative_[i]);
    }
    return lengths_score(least, most);
  }

  Vec3 spring_force(double spacing) const {
    Vec3 force(0, 0, 0);
    for (std::size_t i = 0; i < size(); ++i) {
      const double length = std::sqrt(spoke_square_[i]);
      force += (1.0 - 0.5 * (spacing + ring(i).spacing) / length) * spoke_[i];
    }
    return force;
  }

  /// Sum of the gradients of all that is within the band of the worst; after score().
  Vec3 quality_direction(double worst) {
    const double most = worst + kActiveBand;
    Vec3 sum(0, 0, 0);
    std::fill(has_gradients_.begin(), has_gradients_.end(), 0);
    const auto sign = [](double cot, double other) {
      return cot > other ? -kSideWeight : kSideWeight;
    };
    for (std::size_t i = 0; i < size(); ++i) {
      if (triangle_score(i) <= most) sum += gradients(i).area_length;
      if (side_score(cot_[i][0], cot_beyond_[i]) <= most) {
        sum += sign(cot_[i][0], cot_beyond_[i]) * gradients(i).cot[0];
      }
      const double cot = cot_[i][2], other = cot_[before(i)][1];
      if (side_score(cot, other) <= most) {
        const Vec3 gradient = gradients(i).cot[2] - gradients(before(i)).cot[1];
        sum += sign(cot, other) * gradient;
      }
    }
    return sum.allFinite() ? sum : Vec3(0, 0, 0);
  }

 private:
  // Gradients with respect to the centre.
  struct Gradients {
    Vec3 area_length;
    std::array<Vec3, 3> cot;
  };

  std::size_t size() const { return links_.size(); }
  const Vertex& ring(std::size_t i) const { return *links_[i].ring; }
  std::size_t next(std::size_t i) const { return i + 1 < size() ? i + 1 : 0; }
  std::size_t before(std::size_t i) const { return i > 0 ? i - 1 : size() - 1; }

  void resize(std::size_t n) {
    base_.resize(n);
    spoke_.resize(n);
    base_square_.resize(n);
    base_relative_.resize(n);
    cot_beyond_.resize(n);
    spoke_square_.resize(n);
    spoke_relative_.resize(n);
    quality_.resize(n);
    cot_.resize(n);
    gradients_.resize(n);
    has_gradients_.resize(n);
  }

  // What does not depend on the centre, but is only needed when bounds don't do.
  void find_fixed() {
    if (has_fixed_) return;
    has_fixed_ = true;
    least_base_ = std::numeric_limits<double>::infinity();
    most_base_ = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
      const Vertex &from = ring(i), &to = ring(next(i));
      base_[i] = to.position() - from.position();
      base_square_[i] = base_[i].squaredNorm();
      cot_beyond_[i] = cotangent(*links_[i].beyond, to, from);
      base_relative_[i] = relative_square(base_square_[i], from.spacing + to.spacing);
      least_base_ = std::min(least_base_, base_relative_[i]);
      most_base_ = std::max(most_base_, base_relative_[i]);
    }
  }

  double triangle_score(std::size_t i) const {
    const double a = spoke_relative_[i], b = base_relative_[i], c = spoke_relative_[next(i)];
    return std::min(quality_[i], lengths_score(std::min({a, b, c}), std::max({a, b, c})));
  }

  // a_f = K A / S: grad a_f = K (grad A - A grad S / S) / S. A cotangent is D / 2A, D the product
  // of the two sides at its corner: grad cot = (grad D - cot grad 2A) / 2A.
  const Gradients& gradients(std::size_t i) {
    Gradients& out = gradients_[i];
    if (has_gradients_[i] != 0) return out;
    has_gradients_[i] = 1;
    const Vec3 &p = centre_, a = ring(i).position(), b = ring(next(i)).position();
    const Vec3 normal = spoke_[i].cross(spoke_[next(i)]);
    const double twice_area = std::sqrt(normal.squaredNorm());
    const double squares = base_square_[i] + spoke_square_[i] + spoke_square_[next(i)];
    const Vec3 twice_area_gradient = (normal / twice_area).cross(base_[i]);
    const Vec3 squares_gradient = 2.0 * (2.0 * p - a - b);
    out.area_length = (0.5 * kSidesAreaLength / squares) *
                      (twice_area_gradient - (twice_area / squares) * squares_gradient);
    const std::array<Vec3, 3> product = {2.0 * p - a - b, base_[i], -base_[i]};
    for (std::size_t k = 0; k < 3; ++k) {
      out.cot[k] = (product[k] - cot_[i][k] * twice_area_gradient) / twice_area;
    }
    return out;
  }

  std::span<const Link> links_;
  // Of find_fixed().
  bool has_fixed_ = false;
  std::vector<Vec3> base_;  // from ring vertex i to the next
  std::vector<double> base_square_, base_relative_, cot_beyond_;
  double least_base_ = 0.0, most_base_ = 0.0;
  // Of place().
  Vec3 centre_;
  std::vector<Vec3> spoke_;  // from the centre to ring vertex i
  std::vector<double> spoke_square_, spoke_relative_, quality_;
  std::vector<Cotangents> cot_;  // of triangle i at the centre, at i and at i + 1
  std::vector<Gradients> gradients_;
  std::vector<char> has_gradients_;
};

class Climber {
 public:
  // `enough`: the score above which a star is good.
  Climber(const Target& target, double enough, Patch& patch)
      : target_(target),
        enough_(enough),
        clearly_good_(enough + kRounding),
        patch_(patch),
        stars_(patch::stars(patch)),
        is_settled_(at(patch.n_free), 0) {
    // Vertices keep their places in memory and their neighbours while they move.
    for (const Index corner : stars_.corners) {
      const Index tri = corner / 3;
      const int k = static_cast<int>(corner % 3);
      links_.push_back(
          {&patch.vertex(patch.triangle(tri).vertex[at(next_corner(k))]), &patch.across(tri, k)});
    }
  }

  // Moves the vertex if it is not good enough and that raises the worst score of its star.
  bool improve(Index vertex) {
    // It was found to stay, and nothing around it has moved since.
    if (is_settled_[at(vertex)] != 0) return false;
    is_settled_[at(vertex)] = 1;
    const Vertex p = patch_.vertex(vertex);
    star_.load(links_of(vertex));
    star_.place(p.position());
    if (star_.is_clearly_good(p.spacing, clearly_good_)) return false;
    const double before = star_.score(p.spacing);
    if (before >= enough_) return false;
    const double bound = before + kLeastClimb;
    if (climb(vertex, star_.quality_direction(before), bound)) return true;
    star_.place(p.position());
    return climb(vertex, star_.spring_force(p.spacing), bound);
  }

  void spring(Index vertex) {
    const Vertex p = patch_.vertex(vertex);
    star_.load(links_of(vertex));
    star_.place(p.position());
    const Vertex q = with_spacing(moved(p, kSpringStep * star_.spring_force(p.spacing)));
    star_.place(q.position());
    if (!star_.is_clearly_good(q.spacing, clearly_good_)) {
      const double after = star_.score(q.spacing);
      if (after < enough_) {
        star_.place(p.position());
        if (after <= star_.score(p.spacing)) return;
      }
    }
    patch_.vertices[at(vertex)] = q;
  }

 private:
  Vec3 moved(const Vertex& p, const Vec3& step) const {
    return target_.surface.project(p.position() + step);
  }
  Vertex with_spacing(const Vec3& q) const {
    return {q.x(), q.y(), q.z(), target_.spacing.at(q.x(), q.y(), q.z())};
  }

  // Takes the longest step there that brings the score above `bound`.
  bool climb(Index vertex, const Vec3& direction, double bound) {
    const Vertex p = patch_.vertex(vertex);
    const double length = std::sqrt(direction.squaredNorm());
    if (length == 0.0) return false;
    for (const double step : kSteps) {
      const Vec3 place = moved(p, (step * p.spacing / length) * direction);
      star_.place(place);
      if (!(star_.shape_score(bound) > bound)) continue;
      const Vertex q = with_spacing(place);
      if (!(star_.size_score(q.spacing) > bound)) continue;
      patch_.vertices[at(vertex)] = q;
      unsettle_around(vertex);
      return true;
    }
    return false;
  }

  std::span<const Link> links_of(Index vertex) const {
    const Index begin = stars_.offsets[at(vertex)], end = stars_.offsets[at(vertex) + 1];
    return {links_.data() + begin, links_.data() + end};
  }

  void unsettle(Index vertex) {
    if (vertex < patch_.n_free) is_settled_[at(vertex)] = 0;
  }
  // All whose star has the vertex in its ring, or beyond a side of that.
  void unsettle_around(Index vertex) {
    unsettle(vertex);
    for (Index i = stars_.offsets[at(vertex)]; i < stars_.offsets[at(vertex) + 1]; ++i) {
      const Index tri = stars_.corners[at(i)] / 3;
      const int k = static_cast<int>(stars_.corners[at(i)] % 3);
      const Triangle& t = patch_.triangle(tri);
      unsettle(t.vertex[at(next_corner(k))]);
      const Index other = t.neighbour[at(k)];
      if (other < 0) continue;
      const Triangle& o = patch_.triangle(other);
      unsettle(o.vertex[at(side_towards(o, tri))]);
    }
  }

  const Target& target_;
  double enough_;
  ClearlyGood clearly_good_;
  Patch& patch_;
  patch::Stars stars_;
  std::vector<Link> links_;  // by corner of the stars
  std::vector<char> is_settled_;
  Star star_;
};

}  // namespace

void hill_climb(const Target& target, const ClimbOptions& options, Patch& patch) {
  Climber climber(target, options.enough, patch);
  bool has_moved = true;
  for (int sweep = 0; has_moved && sweep < options.sweeps; ++sweep) {
    has_moved = false;
    for (Index v = 0; v < patch.n_free; ++v) has_moved |= climber.improve(v);
  }
}

void relax_patch(const Target& target, const SpringOptions& options, Patch& patch) {
  Climber climber(target, options.floor, patch);
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    for (Index v = 0; v < patch.n_free; ++v) climber.spring(v);
  }
}

}  // namespace delos
