// SPDX-License-Identifier: BSD-3-Clause
#include "remap/stream.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geometry/point_order.hpp"
#include "geometry/tangent_frame.hpp"
#include "remap/walk.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kSumGrain = 8192;  // 0.1 ms; part of the answer
constexpr std::int64_t kFitBlock = 512;   // vertices along the curve, 1 ms of fits

// A dual edge shorter than this part of its edge would make the projection's weights unbounded.
constexpr double kShortest = 1e-6;
// Gradient of the projection against the flow at which it has arrived; 1e-10 is promised.
constexpr double kArrived = 1e-13;
// Vertices nearer than this (radii) are the same one.
constexpr double kSame = 1e-15;

// min over psi of sum (dc / dv) (flux + psi[v1] - psi[v0])^2.
struct Projection {
  parallel::Executor& exec;
  const Grid& grid;
  Array<double> flux;    // [n_edges] m2/s
  Array<double> weight;  // [n_edges] dc / dv

  double misfit(std::int64_t edge, std::span<const double> psi) const {
    const auto [v, w] = grid.vertices_on_edge[at(edge)];
    return flux[at(edge)] + (psi[at(w)] - psi[at(v)]);
  }
  double sum(std::span<const double> a, std::span<const double> b) const {
    return parallel::sum(exec, static_cast<std::int64_t>(a.size()), kSumGrain,
                         [&](std::int64_t i) { return a[at(i)] * b[at(i)]; });
  }
};

Projection project(parallel::Executor& exec, const Grid& grid, std::span<const double> normal) {
  Projection result{exec, grid, {}, {}};
  result.flux.resize(at(grid.n_edges()));
  result.weight.resize(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kSumGrain, [&](std::int64_t edge) {
    const double dv = grid.vertex_distance_m[at(edge)], dc = grid.cell_distance_m[at(edge)];
    result.flux[at(edge)] = normal[at(edge)] * dv;
    result.weight[at(edge)] = dc / std::max(dv, kShortest * dc);
  });
  return result;
}

// Breadth first from vertex 0; short paths keep rounding small.
Array<double> sum_along_tree(const Grid& grid, std::span<const double> flux) {
  Array<double> psi(at(grid.n_vertices()));
  std::vector<char> is_known(at(grid.n_vertices()), 0);
  std::vector<Index> queue{0};
  queue.reserve(at(grid.n_vertices()));
  psi[0] = 0.0;
  is_known[0] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const Index edge : grid.edges_on_vertex[at(queue[next])]) {
      const auto [v, w] = grid.vertices_on_edge[at(edge)];
      const bool forward = v == queue[next];
      const Index other = forward ? w : v;
      if (is_known[at(other)]) continue;
      is_known[at(other)] = 1;
      psi[at(other)] = psi[at(queue[next])] + (forward ? -flux[at(edge)] : flux[at(edge)]);
      queue.push_back(other);
    }
  }
  return psi;
}

// out[v] = sum over its edges of +- weight times value(edge), + where v is the edge's second.
template <class Value>
void gather(const Projection& p, Value&& value, Array<double>& out) {
  parallel::for_index(p.exec, p.grid.n_vertices(), kSumGrain, [&](std::int64_t v) {
    double sum = 0.0;
    for (const Index edge : p.grid.edges_on_vertex[at(v)]) {
      const double term = p.weight[at(edge)] * value(edge);
      sum += p.grid.vertices_on_edge[at(edge)][1] == v ? term : -term;
    }
    out[at(v)] = sum;
  });
}

// Conjugate gradients, each vertex scaled by its diagonal; a fixed number of rounds at most.
void descend(Context& context, const Projection& p, Array<double>& psi) {
  const std::size_t n = psi.size();
  Array<double> diagonal(n), residual(n), scaled(n), direction(n), image(n);
  parallel::for_index(p.exec, p.grid.n_vertices(), kSumGrain, [&](std::int64_t v) {
    double sum = 0.0;
    for (const Index edge : p.grid.edges_on_vertex[at(v)]) sum += p.weight[at(edge)];
    diagonal[at(v)] = sum;
  });
  gather(
      p, [&](Index edge) { return -p.misfit(edge, psi); }, residual);
  const auto each = [&](auto&& body) {
    parallel::for_index(p.exec, p.grid.n_vertices(), kSumGrain, body);
  };
  const double size = parallel::sum(p.exec, p.grid.n_edges(), kSumGrain, [&](std::int64_t e) {
    return p.weight[at(e)] * p.flux[at(e)] * p.flux[at(e)];
  });
  const auto rounds = 1000 + 20 * static_cast<std::int64_t>(std::sqrt(static_cast<double>(n)));
  double before = 0.0;
  for (std::int64_t round = 0; round < rounds; ++round) {
    context.monitor.check_cancelled();
    each([&](std::int64_t v) { scaled[at(v)] = residual[at(v)] / diagonal[at(v)]; });
    const double now = p.sum(residual, scaled);
    if (now <= kArrived * kArrived * size) return;
    const double keep = round == 0 ? 0.0 : now / before;
    each([&](std::int64_t v) {
      direction[at(v)] = round == 0 ? scaled[at(v)] : scaled[at(v)] + keep * direction[at(v)];
    });
    gather(
        p,
        [&](Index edge) {
          const auto [v, w] = p.grid.vertices_on_edge[at(edge)];
          return direction[at(w)] - direction[at(v)];
        },
        image);
    const double step = now / p.sum(direction, image);
    each([&](std::int64_t v) {
      psi[at(v)] += step * direction[at(v)];
      residual[at(v)] -= step * image[at(v)];
    });
    before = now;
  }
}

double remainder(const Projection& p, std::span<const double> psi) {
  double rest = 0.0, size = 0.0;
  rest = parallel::sum(p.exec, p.grid.n_edges(), kSumGrain, [&](std::int64_t e) {
    return p.weight[at(e)] * p.misfit(e, psi) * p.misfit(e, psi);
  });
  size = parallel::sum(p.exec, p.grid.n_edges(), kSumGrain, [&](std::int64_t e) {
    return p.weight[at(e)] * p.flux[at(e)] * p.flux[at(e)];
  });
  return size > 0.0 ? std::sqrt(rest / size) : 0.0;
}

// Value at p of the quadratic that fits psi at the corners of a cell and its neighbours best, near
// corners most.
class Fit {
 public:
  Fit(const Tiling& cells, std::span<const double> psi) : cells_(cells), psi_(psi) {}

  double value(Index cell, const Vec3& p) {
    corners_.clear();
    for (const Index id : cells_.corners(cell)) {
      if ((cells_.corner(id) - p).cwiseAbs().maxCoeff() <= kSame) return psi_[at(id)];
      corners_.push_back(id);
    }
    for (const Index beside : cells_.neighbours(cell)) {
      const auto more = cells_.corners(beside);
      corners_.insert(corners_.end(), more.begin(), more.end());
    }
    std::sort(corners_.begin(), corners_.end());
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    return solve(p, psi_[at(cells_.corners(cell)[0])]);
  }

 private:
  double solve(const Vec3& p, double reference) const {
    using Six = Eigen::Matrix<double, 6, 1>;
    const TangentFrame plane(p.normalized());
    double square = 0.0;
    for (const Index id : corners_) square += (cells_.corner(id) - p).squaredNorm();
    square /= static_cast<double>(corners_.size());
    const double scale = 1.0 / std::sqrt(square);
    Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
    Six right = Six::Zero();
    for (const Index id : corners_) {
      const Vec3 d = cells_.corner(id) - p;
      const double x = scale * d.dot(plane.right), y = scale * d.dot(plane.ahead);
      const double weight = 1.0 / (0.1 + (x * x + y * y));
      Six row;
      row << 1.0, x, y, x * x, x * y, y * y;
      matrix += weight * row * row.transpose();
      right += weight * (psi_[at(id)] - reference) * row;
    }
    // Few corners (the coarsest grids) leave the curvature open; then it is small.
    constexpr double kSmall = 1e-12;
    for (int k = 3; k < 6; ++k) matrix(k, k) += kSmall;
    return reference + matrix.ldlt().solve(right)[0];
  }

  const Tiling& cells_;
  std::span<const double> psi_;
  std::vector<Index> corners_;
};

}  // namespace

StreamFunction stream_function(Context& context, const Grid& grid, std::span<const double> normal) {
  DELOS_CHECK(static_cast<std::int64_t>(normal.size()) == grid.n_edges(), ErrorKind::input,
              "a flow of ", normal.size(), " normal velocities was given for ", grid.n_edges(),
              " edges: it belongs to another grid.");
  const Projection projection = project(context.exec, grid, normal);
  StreamFunction result;
  result.psi = sum_along_tree(grid, projection.flux);
  descend(context, projection, result.psi);
  const double first = result.psi[0];
  for (double& value : result.psi) value -= first;
  result.remainder = remainder(projection, result.psi);
  return result;
}

Array<double> flow_of(parallel::Executor& exec, const Grid& grid, std::span<const double> psi) {
  Array<double> normal(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kSumGrain, [&](std::int64_t edge) {
    const auto [v, w] = grid.vertices_on_edge[at(edge)];
    const double dv = grid.vertex_distance_m[at(edge)];
    normal[at(edge)] = dv > 0.0 ? (psi[at(v)] - psi[at(w)]) / dv : 0.0;
  });
  return normal;
}

Array<double> transfer_stream_function(parallel::Executor& exec, const Grid& source,
                                       const Grid& target, std::span<const double> psi) {
  DELOS_CHECK(static_cast<std::int64_t>(psi.size()) == source.n_vertices(), ErrorKind::input,
              "a stream function of ", psi.size(), " values was given for ", source.n_vertices(),
              " vertices: it belongs to another grid.");
  const Tiling cells = Tiling::cells(exec, source);
  const std::span<const Vec3> points = target.vertex_position;
  const std::vector<Index> order = hilbert_order(exec, points);
  Array<double> result(points.size());
  const auto n = static_cast<std::int64_t>(points.size());
  parallel::for_range(exec, n, kFitBlock, [&](std::int64_t begin, std::int64_t end) {
    Fit fit(cells, psi);
    Index here = start_near(cells, points[at(order[at(begin)])]);
    for (std::int64_t k = begin; k < end; ++k) {
      const Vec3& p = points[at(order[at(k)])];
      here = walk(cells, p, here);
      result[at(order[at(k)])] = fit.value(here, p);
    }
  });
  return result;
}

}  // namespace delos::remap
