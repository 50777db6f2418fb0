// SPDX-License-Identifier: BSD-3-Clause
#include "remap/clip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.hpp"
#include "geometry/tangent_frame.hpp"

namespace delos::remap {
namespace {

// A corner this near to a side, in a length that is right within a factor of two (the sum of the
// line's coordinates), lies on it: positions are good to a few units of 1.1e-16.
constexpr double kOnSide = 1e-15;
// A side shorter than this has no direction of its own (four cocircular cells) and cuts nothing.
constexpr double kShortest = 1e-13;

double twice_area(const Corner& a, const Corner& b, const Corner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Solid angle. A fan of triangles, each with tan(E / 2) = det / denominator (Van Oosterom &
// Strackee 1983, doi:10.1109/TBME.1983.325207); half angles add up as the arguments of complex
// numbers, so that one arctangent serves all of them.
double solid_angle(std::span<const Corner> corners) {
  const Corner& a = corners[0];
  const auto length = [](const Corner& p) { return std::sqrt(1.0 + (p.x * p.x + p.y * p.y)); };
  const auto dot = [](const Corner& p, const Corner& q) { return 1.0 + (p.x * q.x + p.y * q.y); };
  const double length_a = length(a);
  double length_b = length(corners[1]);
  double re = 1.0, im = 0.0;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Corner &b = corners[k - 1], &c = corners[k];
    const double length_c = length(c);
    const double denominator = 0.25 * ((length_a * length_b * length_c + dot(a, b) * length_c) +
                                       (dot(b, c) * length_a + dot(c, a) * length_b));
    const double det = 0.25 * twice_area(a, b, c);
    const double turned = re * denominator - im * det;
    im = re * det + im * denominator;
    re = turned;
    length_b = length_c;
  }
  return 2.0 * elementary::atan2(im, re);
}

}  // namespace

Frame::Frame(const Vec3& origin) : origin_(origin), height_(origin.norm()) {
  up_ = origin / height_;
  const TangentFrame plane(up_);
  east_ = plane.right;
  north_ = plane.ahead;
}

bool Clipper::begin(const Tiling& tiling, std::int64_t polygon) {
  frame_ = Frame(tiling.centres()[at(polygon)]);
  subject_.clear();
  for (const Index id : tiling.corners(polygon)) {
    const Vec3 p = frame_.local(tiling.corner(id));
    if (!(p.z() > 0.0)) return false;
    subject_.push_back({p.x() / p.z(), p.y() / p.z(), kNone});
  }
  reach_ = 0.0;
  for (std::size_t k = 0; k < subject_.size(); ++k) {
    reach_ = std::max({reach_, std::abs(subject_[k].x), std::abs(subject_[k].y)});
    subject_[k].side = ~static_cast<Index>(k + 1 == subject_.size() ? 0 : k + 1);
  }
  sides_.resize(std::max(sides_.size(), subject_.size()));
  for (std::size_t k = 0; k < subject_.size(); ++k) {
    const Corner &a = subject_[k == 0 ? subject_.size() - 1 : k - 1], &b = subject_[k];
    const double whole = std::abs(b.x - a.x) + std::abs(b.y - a.y);
    sides_[k] = {tiling.bow(polygon, k), whole > 0.0 ? 1.0 : 0.0, whole > 0.0 ? whole : 1.0};
  }
  plane_area_.reset();
  if (!tiling.surface().is_sphere()) {
    plane_area_ = frame_.areas_on(tiling.surface());
    if (reach_ > plane_area_->reach()) plane_area_.reset();
  }
  area_m2_ = tiling.area_m2()[at(polygon)];
  is_sound_ = find_lines();
  return true;
}

// The sides as lines; false when one runs backwards.
bool Clipper::find_lines() {
  lines_.resize(subject_.size());
  bool is_sound = true;
  for (std::size_t k = 0; k < subject_.size(); ++k) {
    const Corner &a = subject_[k == 0 ? subject_.size() - 1 : k - 1], &b = subject_[k];
    const Vec3 line(a.y - b.y, b.x - a.x, a.x * b.y - a.y * b.x);
    const double slope = std::abs(line.x()) + std::abs(line.y());
    lines_[k] = {line, slope, slope + std::abs(line.z())};
    is_sound = is_sound && (slope < kShortest || line.z() > 0.0);
  }
  return is_sound;
}

std::span<const Corner> Clipper::clip(const Tiling& tiling, std::int64_t polygon) {
  const auto ids = tiling.corners(polygon);
  make_room(ids.size());
  Vec3* const clipping = clipping_.data();
  for (std::size_t k = 0; k < ids.size(); ++k) clipping[k] = frame_.local(tiling.corner(ids[k]));
  const Vec3 centre = frame_.local(tiling.centres()[at(polygon)]);
  n_clipping_ = ids.size();
  const bool is_smaller = tiling.area_m2()[at(polygon)] < area_m2_ && is_sound_ && flatten(centre);
  if (!(is_smaller ? cut_by_subject() : cut_subject(centre))) return {};
  return {current_.data(), n_};
}

// The second polygon in the plane, as what is to be cut. False when it reaches round the body or
// where the grid folds by a trifle: such a side cuts nothing and can't be cut either.
bool Clipper::flatten(const Vec3& centre) {
  double lowest = centre.z();
  for (std::size_t k = 0; k < n_clipping_; ++k) lowest = std::min(lowest, clipping_[k].z());
  if (!(lowest > 0.0)) return false;
  flat_x_ = centre.x() / centre.z();
  flat_y_ = centre.y() / centre.z();
  flat_reach_ = 0.0;
  for (std::size_t k = 0; k < n_clipping_; ++k) {
    const Vec3& p = clipping_[k];
    Corner& corner = current_[k];
    corner = {p.x() / p.z(), p.y() / p.z(), static_cast<Index>(k + 1 == n_clipping_ ? 0 : k + 1)};
    flat_reach_ =
        std::max({flat_reach_, std::abs(corner.x - flat_x_), std::abs(corner.y - flat_y_)});
  }
  n_ = n_clipping_;
  const Corner middle{flat_x_, flat_y_, kNone};
  for (std::size_t k = 0; k < n_; ++k) {
    const Corner &a = current_[k == 0 ? n_ - 1 : k - 1], &b = current_[k];
    const bool is_long = std::abs(b.x - a.x) + std::abs(b.y - a.y) >= kShortest;
    if (is_long && !(twice_area(middle, a, b) > 0.0)) return false;
  }
  return true;
}

bool Clipper::cut_by_subject() {
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const auto& [line, slope, length] = lines_[k];
    if (slope < kShortest) continue;
    const double off = (line.x() * flat_x_ + line.y() * flat_y_) + line.z();
    if (off >= flat_reach_ * slope) continue;
    if (off <= -flat_reach_ * slope) return false;
    if (!cut(line, kOnSide * length, ~static_cast<Index>(k))) return false;
  }
  return true;
}

bool Clipper::cut_subject(const Vec3& centre) {
  const Vec3* const clipping = clipping_.data();
  n_ = subject_.size();
  std::copy(subject_.begin(), subject_.end(), current_.begin());
  for (std::size_t k = 0; k < n_clipping_; ++k) {
    const Vec3 line = clipping[k == 0 ? n_clipping_ - 1 : k - 1].cross(clipping[k]);
    const double length = line.cwiseAbs().sum();
    // A side that runs backwards, where the grid folds by a trifle, cuts nothing either.
    if (length < kShortest || !(line.dot(centre) > 0.0)) continue;
    // All of the subject lies to its left, farther off than rounding.
    if (line.z() >= reach_ * (std::abs(line.x()) + std::abs(line.y()))) continue;
    if (!cut(line, kOnSide * length, static_cast<Index>(k))) return false;
  }
  return true;
}

// Each side adds one corner, or one more where rounding has bent a polygon, and cut() writes one
// more than it keeps.
void Clipper::make_room(std::size_t n_clipping) {
  const std::size_t most = 2 * (subject_.size() + n_clipping) + 1;
  if (current_.size() >= most) return;
  current_.resize(most);
  next_.resize(most);
  distance_.resize(most);
  clipping_.resize(most);
  sides_.resize(std::max(sides_.size(), most));
}

// Sutherland & Hodgman 1974 (doi:10.1145/360767.360802): keeps what lies left of the line. A
// corner that is not kept is overwritten by the next, without a branch, which can't be foretold.
bool Clipper::cut(const Vec3& line, double on_side, Index side) {
  const Corner* const now = current_.data();
  double* const distance = distance_.data();
  double least = on_side, most = -on_side;
  for (std::size_t k = 0; k < n_; ++k) {
    distance[k] = (line.x() * now[k].x + line.y() * now[k].y) + line.z();
    least = std::min(least, distance[k]);
    most = std::max(most, distance[k]);
  }
  if (most <= on_side) return false;
  if (least >= -on_side) return true;
  Corner* kept = next_.data();
  for (std::size_t k = 0; k < n_; ++k) {
    const std::size_t l = k + 1 == n_ ? 0 : k + 1;
    const Corner &p = now[k], &q = now[l];
    const double from = distance[k], to = distance[l];
    const bool leaves = to < -on_side;
    *kept = {p.x, p.y, (leaves & (from <= on_side)) ? side : p.side};
    kept += static_cast<int>(from >= -on_side);
    if (((from > on_side) & leaves) | ((from < -on_side) & (to > on_side))) {
      const double t = from / (from - to);
      *kept++ = {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), leaves ? side : p.side};
    }
  }
  n_ = static_cast<std::size_t>(kept - next_.data());
  std::swap(current_, next_);
  return n_ >= 3;
}

double Clipper::area(const Ellipsoid& surface, std::span<const Corner> corners) const {
  if (surface.is_sphere()) return solid_angle(corners);
  const Corner& first = corners[0];
  double sum = 0.0;
  if (plane_area_) {
    std::array<double, 2> u = {corners[1].x - first.x, corners[1].y - first.y};
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const std::array<double, 2> v = {corners[k].x - first.x, corners[k].y - first.y};
      sum += plane_area_->triangle({first.x, first.y}, u, v);
      u = v;
    }
    return sum;
  }
  const auto on_surface = [&](const Corner& p) { return surface.project(frame_.point(p.x, p.y)); };
  const Vec3 a = on_surface(first);
  Vec3 b = on_surface(corners[1]);
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Vec3 c = on_surface(corners[k]);
    sum += surface.triangle_area(a, b, c);
    b = c;
  }
  return sum;
}

// Of differences along one line any norm gives the ratio. Which polygon a side belongs to can't be
// foretold: both kinds stand in one list.
double Clipper::with_bows(double area, const Tiling& tiling, std::int64_t polygon,
                          std::span<const Corner> corners) {
  const std::size_t n_own = subject_.size();
  for (std::size_t k = 0; k < n_clipping_; ++k) {
    const Vec3 &a = clipping_[k == 0 ? n_clipping_ - 1 : k - 1], &b = clipping_[k];
    const double whole =
        std::abs(b.x() * a.z() - a.x() * b.z()) + std::abs(b.y() * a.z() - a.y() * b.z());
    // Round the body: coarse beyond caring.
    const bool counts = a.z() > 0.0 && b.z() > 0.0 && whole > 0.0;
    sides_[n_own + k] = {tiling.bow(polygon, k), counts ? a.z() * b.z() : 0.0,
                         counts ? whole : 1.0};
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Corner &p = corners[k], &q = corners[k + 1 == corners.size() ? 0 : k + 1];
    const std::size_t base = p.side < 0 ? 0 : n_own;
    const Side& side = sides_[base + at(p.side < 0 ? ~p.side : p.side)];
    const double part = std::abs(q.x - p.x) + std::abs(q.y - p.y);
    area += side.bow * (part * side.scale / side.whole);
  }
  return area;
}

Vec3 Clipper::middle(const Ellipsoid& surface, std::span<const Corner> corners) const {
  const Corner& a = corners[0];
  double x = 0.0, y = 0.0, weight = 0.0;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Corner &b = corners[k - 1], &c = corners[k];
    const double w = twice_area(a, b, c);
    x += w * ((b.x - a.x) + (c.x - a.x));
    y += w * ((b.y - a.y) + (c.y - a.y));
    weight += 3.0 * w;
  }
  const double scale = weight > 0.0 ? 1.0 / weight : 0.0;
  return surface.project(frame_.point(a.x + x * scale, a.y + y * scale));
}

}  // namespace delos::remap
