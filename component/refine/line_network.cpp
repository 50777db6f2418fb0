// SPDX-License-Identifier: BSD-3-Clause
#include "refine/line_network.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "geometry/predicates.hpp"

namespace delos {
namespace {

constexpr double kOnLine = 0.05;        // of the spacing: a point so near to an arc lies on it
constexpr double kLongestArc = -0.985;  // cosine of 170 degrees: beyond, the way round is unclear
constexpr double kSharpAngle_deg = 60.0;
constexpr double kLeastAngle_deg = 10.0;  // below it triangles would be slivers for many cells

using Arc = LineNetwork::Arc;

// An arc, or a single point as one from a node to itself, with a box around it.
struct Item {
  Arc arc;
  Vec3 low, high;
  bool is_point() const { return arc.node[0] == arc.node[1]; }
};

class NetworkBuilder {
 public:
  NetworkBuilder(const Ellipsoid& surface, const SpacingField& spacing)
      : surface_(surface), spacing_(spacing) {}

  void add(const GivenLine& line);
  LineNetwork take();

 private:
  Index node_at(const Vec3& p, Index line);
  void add_arc(Index a, Index b, Index line);
  void cut_arcs();
  void meet(std::size_t i, std::size_t j);
  bool put_ends_on(std::size_t from, std::size_t onto);
  void cross(std::size_t i, std::size_t j);
  Index crossing_at(const Vec3& p, std::size_t i, std::size_t j);
  void split_arcs();
  void find_sharp_corners();
  void check_angle(Index node, const Arc& first, const Arc& second);

  const Vec3& position(Index node) const { return out_.nodes[at(node)].position; }
  double spacing_at(const Vec3& p) const { return spacing_.at(p.x(), p.y(), p.z()); }
  const std::string& name(Index line) const { return out_.names[at(line)]; }
  std::string both(Index a, Index b) const {
    return text(name(std::min(a, b)), " and ", name(std::max(a, b)));
  }
  std::string place(const Vec3& p) const { return place_text(surface_, p); }
  double km(double length) const { return 1e-3 * surface_.scale_m() * length; }
  Item item_of(const Arc& arc) const;

  const Ellipsoid& surface_;
  const SpacingField& spacing_;
  LineNetwork out_;
  std::map<std::array<double, 3>, Index> node_of_place_;
  std::vector<Item> items_;
  std::vector<std::vector<Index>> nodes_on_;  // by item: nodes that it is to go through
  std::set<std::pair<Index, Index>> joined_;
};

Index NetworkBuilder::node_at(const Vec3& p, Index line) {
  const auto [entry, is_new] =
      node_of_place_.try_emplace({p.x(), p.y(), p.z()}, static_cast<Index>(out_.nodes.size()));
  if (is_new) out_.nodes.push_back({p, line});
  return entry->second;
}

void NetworkBuilder::add_arc(Index a, Index b, Index line) {
  if (a > b) std::swap(a, b);
  if (a == b || !joined_.emplace(a, b).second) return;
  const Vec3 p = position(a), q = position(b);
  DELOS_CHECK(p.dot(q) > kLongestArc * p.norm() * q.norm(), ErrorKind::input, name(line),
              ": its points at ", place(p), " and ", place(q),
              " are more than 170 degrees apart. Give a point between them.");
  out_.arcs.push_back({{a, b}, line});
}

void NetworkBuilder::add(const GivenLine& line) {
  const auto id = static_cast<Index>(out_.names.size());
  out_.names.push_back(line.name);
  std::vector<Index> nodes;
  for (const Vec3& p : line.points) nodes.push_back(node_at(p, id));
  if (line.kind == GivenLine::Kind::points) return;
  for (std::size_t i = 1; i < nodes.size(); ++i) add_arc(nodes[i - 1], nodes[i], id);
  if (line.kind == GivenLine::Kind::ring && nodes.size() > 2) {
    add_arc(nodes.back(), nodes.front(), id);
  }
}

// The arc bulges out of the box of its ends by at most the chord's sagitta.
Item NetworkBuilder::item_of(const Arc& arc) const {
  const Vec3 &p = position(arc.node[0]), &q = position(arc.node[1]);
  const Vec3 middle = 0.5 * (p + q);
  const double margin =
      (surface_.project(middle) - middle).norm() + kOnLine * std::max(spacing_at(p), spacing_at(q));
  const Vec3 around(margin, margin, margin);
  return {arc, p.cwiseMin(q) - around, p.cwiseMax(q) + around};
}

// Looks at all pairs whose boxes meet, by a sweep along x.
void NetworkBuilder::cut_arcs() {
  std::vector<char> is_on_arc(out_.nodes.size(), 0);
  for (const Arc& arc : out_.arcs) {
    items_.push_back(item_of(arc));
    for (const Index node : arc.node) is_on_arc[at(node)] = 1;
  }
  for (Index node = 0; node < static_cast<Index>(out_.nodes.size()); ++node) {
    if (is_on_arc[at(node)] == 0)
      items_.push_back(item_of({{node, node}, out_.nodes[at(node)].line}));
  }
  std::stable_sort(items_.begin(), items_.end(),
                   [](const Item& a, const Item& b) { return a.low.x() < b.low.x(); });
  nodes_on_.resize(items_.size());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    for (std::size_t j = i + 1; j < items_.size() && items_[j].low.x() <= items_[i].high.x(); ++j) {
      const bool meets = (items_[i].low.array() <= items_[j].high.array()).all() &&
                         (items_[j].low.array() <= items_[i].high.array()).all();
      if (meets) meet(i, j);
    }
  }
}

void NetworkBuilder::meet(std::size_t i, std::size_t j) {
  const bool i_on_j = put_ends_on(i, j), j_on_i = put_ends_on(j, i);
  if (!i_on_j && !j_on_i) cross(i, j);
}

// Whether an end of the first lies on the second without being an end of it.
bool NetworkBuilder::put_ends_on(std::size_t from, std::size_t onto) {
  if (items_[onto].is_point()) return false;
  const auto [a, b] = items_[onto].arc.node;
  const Vec3 n = position(a).cross(position(b));
  bool has_found = false;
  for (const Index end : items_[from].arc.node) {
    if (end == a || end == b) continue;
    const Vec3& p = position(end);
    const double reach = kOnLine * spacing_at(p) * n.norm();
    if (std::abs(n.dot(p)) > reach || !(position(a).cross(p).dot(n) > 0.0) ||
        !(p.cross(position(b)).dot(n) > 0.0)) {
      continue;
    }
    nodes_on_[onto].push_back(end);
    has_found = true;
  }
  return has_found;
}

void NetworkBuilder::cross(std::size_t i, std::size_t j) {
  if (items_[i].is_point() || items_[j].is_point()) return;
  const auto [a, b] = items_[i].arc.node;
  const auto [c, d] = items_[j].arc.node;
  if (a == c || a == d || b == c || b == d) return;
  const Vec3 &pa = position(a), &pb = position(b), &pc = position(c), &pd = position(d);
  const auto side = [](const Vec3& u, const Vec3& v, const Vec3& p) {
    return predicates::orient_origin(u, v, p);
  };
  if (side(pa, pb, pc) * side(pa, pb, pd) >= 0 || side(pc, pd, pa) * side(pc, pd, pb) >= 0) return;
  Vec3 along = pa.cross(pb).cross(pc.cross(pd));
  if (along.dot(pa + pb) < 0.0) along = -along;
  if (!(along.dot(pc + pd) > 0.0)) return;  // they meet on the other side of the globe
  const Index node = crossing_at(surface_.project(along), i, j);
  nodes_on_[i].push_back(node);
  nodes_on_[j].push_back(node);
}

// The node where two arcs cross; where a third one crosses at the same place, there is one.
Index NetworkBuilder::crossing_at(const Vec3& p, std::size_t i, std::size_t j) {
  const double h = spacing_at(p);
  for (std::size_t node = static_cast<std::size_t>(out_.n_given); node < out_.nodes.size();
       ++node) {
    if ((out_.nodes[node].position - p).norm() < kOnLine * h) return static_cast<Index>(node);
  }
  for (const std::size_t item : {i, j}) {
    for (const Index end : items_[item].arc.node) {
      const double distance = (position(end) - p).norm();
      DELOS_CHECK(distance >= kNearestGiven * h, ErrorKind::input,
                  both(items_[i].arc.line, items_[j].arc.line), " cross at ", place(p), ", ",
                  km(distance), " km from the point at ", place(position(end)),
                  ", where the spacing is ", km(h),
                  " km. Move that point onto the crossing or away, or make the spacing finer.");
    }
  }
  out_.nodes.push_back({p, items_[i].arc.line});
  ++out_.n_crossings;
  return static_cast<Index>(out_.nodes.size() - 1);
}

// Every arc from node to node along it.
void NetworkBuilder::split_arcs() {
  out_.arcs.clear();
  joined_.clear();
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i].is_point()) continue;
    const auto [a, b] = items_[i].arc.node;
    std::vector<std::pair<double, Index>> along{{0.0, a}};
    for (const Index node : nodes_on_[i]) {
      along.emplace_back((position(node) - position(a)).norm(), node);
    }
    std::sort(along.begin(), along.end());
    along.emplace_back(0.0, b);
    for (std::size_t k = 1; k < along.size(); ++k) {
      add_arc(along[k - 1].second, along[k].second, items_[i].arc.line);
    }
  }
}

// The angle between two arcs at the node where they meet, in the tangent plane.
void NetworkBuilder::check_angle(Index node, const Arc& first, const Arc& second) {
  const Vec3& p = position(node);
  const Vec3 gradient = p.cwiseProduct(surface_.inverse_square());
  const auto direction = [&](const Arc& arc) -> Vec3 {
    const Vec3& q = position(arc.node[0] == node ? arc.node[1] : arc.node[0]);
    return q - gradient.dot(q) * p;
  };
  const Vec3 u = direction(first), v = direction(second);
  const double angle_deg = kDegPerRad * elementary::atan2(u.cross(v).norm(), u.dot(v));
  if (angle_deg >= kSharpAngle_deg) return;
  DELOS_CHECK(angle_deg >= kLeastAngle_deg, ErrorKind::input, both(first.line, second.line),
              " meet at ", angle_deg, " degrees at ", place(p),
              ": below 10 degrees no usable triangles fit between them. Let them end apart.");
  out_.nodes[at(node)].is_sharp = true;
  out_.sharp_corners.push_back({node, angle_deg});
}

void NetworkBuilder::find_sharp_corners() {
  std::vector<std::vector<Index>> arcs_at(out_.nodes.size());
  for (std::size_t arc = 0; arc < out_.arcs.size(); ++arc) {
    for (const Index node : out_.arcs[arc].node)
      arcs_at[at(node)].push_back(static_cast<Index>(arc));
  }
  for (std::size_t node = 0; node < arcs_at.size(); ++node) {
    const std::vector<Index>& around = arcs_at[node];
    for (std::size_t i = 0; i < around.size(); ++i) {
      for (std::size_t j = i + 1; j < around.size(); ++j) {
        check_angle(static_cast<Index>(node), out_.arcs[at(around[i])], out_.arcs[at(around[j])]);
      }
    }
  }
}

LineNetwork NetworkBuilder::take() {
  out_.n_given = static_cast<std::int64_t>(out_.nodes.size());
  cut_arcs();
  split_arcs();
  find_sharp_corners();
  return std::move(out_);
}

}  // namespace

std::string place_text(const Ellipsoid& surface, const Vec3& p) {
  const LonLat place = surface.lon_lat(p, LatitudeKind::geodetic);
  return text("lon ", place.lon_rad * kDegPerRad, ", lat ", place.lat_rad * kDegPerRad, " deg");
}

LineNetwork make_network(const Ellipsoid& surface, const SpacingField& spacing,
                         const std::vector<GivenLine>& lines) {
  NetworkBuilder builder(surface, spacing);
  for (const GivenLine& line : lines) builder.add(line);
  return builder.take();
}

}  // namespace delos
