// SPDX-License-Identifier: BSD-3-Clause
#include "refine/chains.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace delos {
namespace {

constexpr double kLongestChord = 0.25;  // longer arcs are halved, so that chords follow them evenly
constexpr int kFirstSteps = 16;         // of the h-mass integral along a chord; doubled until
constexpr double kMostMass = 0.25;      // no step has more than this of an edge, or
constexpr int kMostSteps = 65536;       // there are so many

// Points along the arc no farther apart than kLongestChord, without the first.
void add_knots(const Ellipsoid& surface, const Vec3& from, const Vec3& to,
               std::vector<Vec3>& knots) {
  if ((to - from).norm() > kLongestChord) {
    const Vec3 middle = surface.project(from + to);
    add_knots(surface, from, middle, knots);
    add_knots(surface, middle, to, knots);
  } else {
    knots.push_back(to);
  }
}

Vec3 along(const Ellipsoid& surface, const std::vector<Vec3>& knots, double t) {
  const std::size_t k = std::min(static_cast<std::size_t>(t), knots.size() - 2);
  const double u = t - static_cast<double>(k);
  return surface.project((1.0 - u) * knots[k] + u * knots[k + 1]);
}

// h-mass from the first knot up to each of n_steps a chord.
std::vector<double> masses(const Ellipsoid& surface, const SpacingField& spacing,
                           const std::vector<Vec3>& knots, int n_steps) {
  const std::size_t n = (knots.size() - 1) * static_cast<std::size_t>(n_steps);
  std::vector<Vertex> middle(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = along(surface, knots, (static_cast<double>(i) + 0.5) / n_steps);
    middle[i] = {p.x(), p.y(), p.z(), 0.0};
  }
  spacing.evaluate(middle);
  std::vector<double> mass{0.0};
  Vec3 previous = knots.front();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 next = along(surface, knots, (static_cast<double>(i) + 1.0) / n_steps);
    mass.push_back(mass.back() + (next - previous).norm() / middle[i].spacing);
    previous = next;
  }
  return mass;
}

double largest_step(const std::vector<double>& mass) {
  double largest = 0.0;
  for (std::size_t i = 1; i < mass.size(); ++i) largest = std::max(largest, mass[i] - mass[i - 1]);
  return largest;
}

std::vector<Vec3> points_along(const Ellipsoid& surface, const SpacingField& spacing,
                               const Vec3& from, const Vec3& to) {
  std::vector<Vec3> knots{from};
  add_knots(surface, from, to, knots);
  int n_steps = kFirstSteps;
  std::vector<double> mass = masses(surface, spacing, knots, n_steps);
  while (largest_step(mass) > kMostMass && n_steps < kMostSteps) {
    n_steps *= 2;
    mass = masses(surface, spacing, knots, n_steps);
  }
  std::vector<Vec3> points;
  for (const double cut : equal_mass_cuts(mass)) {
    points.push_back(along(surface, knots, cut / n_steps));
  }
  return points;
}

Index add_vertex(const SpacingField& spacing, const Vec3& p, ChainSet& chains) {
  chains.vertices.push_back({p.x(), p.y(), p.z(), spacing.at(p.x(), p.y(), p.z())});
  return static_cast<Index>(chains.vertices.size() - 1);
}

// Where along the edge from the sharp node to the other end, as a share of it.
double shell_share(double length) {
  return std::ldexp(1.0, std::ilogb(length * (2.0 / 3.0))) / length;
}

Vec3 place_between(const Ellipsoid& surface, const ChainSet& chains, Index a, Index b) {
  const auto is_sharp = [&](Index v) {
    return v < chains.n_nodes() && chains.is_sharp[at(v)] != 0;
  };
  if (is_sharp(b) && !is_sharp(a)) std::swap(a, b);
  const Vec3 p = chains.vertices[at(a)].position(), q = chains.vertices[at(b)].position();
  if (!is_sharp(a) || is_sharp(b)) return surface.project(p + q);
  const double share = shell_share((q - p).norm());
  return surface.project((1.0 - share) * p + share * q);
}

}  // namespace

std::vector<double> equal_mass_cuts(std::span<const double> mass) {
  const double total = mass.back();
  const auto n_pieces =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(total + 0.5)));
  std::vector<double> cuts;
  cuts.reserve(static_cast<std::size_t>(n_pieces));
  std::size_t s = 0;
  for (std::int64_t piece = 1; piece < n_pieces; ++piece) {
    const double wanted = total * static_cast<double>(piece) / static_cast<double>(n_pieces);
    while (mass[s + 1] < wanted) ++s;
    cuts.push_back(static_cast<double>(s) + (wanted - mass[s]) / (mass[s + 1] - mass[s]));
  }
  return cuts;
}

FixedEdges ChainSet::fixed_edges() const {
  FixedEdges out;
  if (vertices.empty()) return out;
  std::vector<std::pair<Index, Index>> ends;
  for (const Chain& chain : chains) {
    for (std::size_t i = 1; i < chain.points.size(); ++i) {
      ends.emplace_back(chain.points[i - 1], chain.points[i]);
      ends.emplace_back(chain.points[i], chain.points[i - 1]);
    }
  }
  std::sort(ends.begin(), ends.end());
  out.offsets.assign(vertices.size() + 1, 0);
  for (const auto& [from, to] : ends) {
    ++out.offsets[at(from) + 1];
    out.ends.push_back(to);
  }
  for (std::size_t v = 1; v < out.offsets.size(); ++v) out.offsets[v] += out.offsets[v - 1];
  return out;
}

ChainSet make_chains(const Ellipsoid& surface, const SpacingField& spacing,
                     const LineNetwork& network) {
  ChainSet out;
  for (const LineNetwork::Node& node : network.nodes) {
    add_vertex(spacing, node.position, out);
    out.is_sharp.push_back(node.is_sharp ? 1 : 0);
  }
  for (const LineNetwork::Arc& arc : network.arcs) {
    const auto [a, b] = arc.node;
    Chain chain{{a}, arc.line};
    for (const Vec3& p : points_along(surface, spacing, network.nodes[at(a)].position,
                                      network.nodes[at(b)].position)) {
      chain.points.push_back(add_vertex(spacing, p, out));
    }
    chain.points.push_back(b);
    out.chains.push_back(std::move(chain));
  }
  return out;
}

std::size_t halve_edges(const Ellipsoid& surface, const SpacingField& spacing,
                        const std::function<bool(Index, Index)>& is_missing, ChainSet& chains) {
  std::size_t n_halved = 0;
  for (Chain& chain : chains.chains) {
    std::vector<Index> points{chain.points.front()};
    for (std::size_t i = 1; i < chain.points.size(); ++i) {
      const Index a = chain.points[i - 1], b = chain.points[i];
      if (is_missing(a, b)) {
        points.push_back(add_vertex(spacing, place_between(surface, chains, a, b), chains));
        ++n_halved;
      }
      points.push_back(b);
    }
    chain.points = std::move(points);
  }
  return n_halved;
}

namespace {

// The chains around each vertex, and whether two vertices lie on the same or neighbouring ones.
class ChainNeighbours {
 public:
  explicit ChainNeighbours(const ChainSet& chains)
      : chains_(chains), chains_at_(chains.vertices.size()) {
    for (std::size_t c = 0; c < chains.chains.size(); ++c) {
      for (const Index v : chains.chains[c].points)
        chains_at_[at(v)].push_back(static_cast<Index>(c));
    }
  }

  bool are_related(Index u, Index v) const {
    if (u < chains_.n_nodes() && v < chains_.n_nodes()) return false;
    for (const Index c : chains_at_[at(u)]) {
      for (const Index d : chains_at_[at(v)]) {
        if (c == d || share_node(c, d)) return true;
      }
    }
    return false;
  }

  Index line_of(Index vertex, const LineNetwork& network) const {
    return vertex < chains_.n_nodes() ? network.nodes[at(vertex)].line
                                      : chains_.chains[at(chains_at_[at(vertex)].front())].line;
  }

 private:
  bool share_node(Index c, Index d) const {
    const std::vector<Index>&p = chains_.chains[at(c)].points, &q = chains_.chains[at(d)].points;
    return p.front() == q.front() || p.front() == q.back() || p.back() == q.front() ||
           p.back() == q.back();
  }

  const ChainSet& chains_;
  std::vector<std::vector<Index>> chains_at_;
};

}  // namespace

void check_distances(const Ellipsoid& surface, const LineNetwork& network, const ChainSet& chains,
                     const Mesh& mesh) {
  const auto n = static_cast<Index>(chains.vertices.size());
  const ChainNeighbours neighbours(chains);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index u = t.vertex[k], v = t.vertex[(k + 1) % 3];
      if (u >= v || v >= n) continue;
      const Vertex &p = chains.vertices[at(u)], &q = chains.vertices[at(v)];
      const double h = 0.5 * (p.spacing + q.spacing),
                   distance = (q.position() - p.position()).norm();
      if (distance >= kNearestGiven * h || neighbours.are_related(u, v)) continue;
      const double km = 1e-3 * surface.scale_m();
      const Index a = neighbours.line_of(u, network), b = neighbours.line_of(v, network);
      throw Error(ErrorKind::input,
                  text(network.names[at(std::min(a, b))], " and ",
                       network.names[at(std::max(a, b))], " are ", km * distance, " km apart at ",
                       place_text(surface, p.position()), ", where the spacing is ", km * h,
                       " km: points and lines must be 0.65 of it apart. Make the spacing finer "
                       "there, or leave points out."));
    }
  }
}

}  // namespace delos
