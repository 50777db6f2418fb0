// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangles of a new vertex's star, eight side by side.
#include <cmath>

#include "refine/work_mesh.hpp"

namespace delos {

inline constexpr std::size_t kLanes = 8;

/// Of the bounds on size and radius-edge ratio, squared.
struct BoundFactors {
  double size, edge;
};

/// Up to eight triangles (p, i, i + 1) of a star side by side, so that the compiler can use vector
/// registers: the corners less p, and what is computed for each triangle.
struct StarLanes {
  alignas(64) double x[kLanes + 1], y[kLanes + 1], z[kLanes + 1], spacing[kLanes + 1];
};
struct CircleLanes {
  alignas(64) double x[kLanes], y[kLanes], z[kLanes], bound[kLanes];  // see WorkTriangle
  alignas(64) double size_excess[kLanes], edge_excess[kLanes];        // > 0: off the bound
};

/// The same arithmetic as WorkMesh::cache_circle() for planes.
inline void plane_lanes(const Vertex& p, const StarLanes& s, CircleLanes& out) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double nx = s.y[i] * s.z[i + 1] - s.z[i] * s.y[i + 1];
    const double ny = s.z[i] * s.x[i + 1] - s.x[i] * s.z[i + 1];
    const double nz = s.x[i] * s.y[i + 1] - s.y[i] * s.x[i + 1];
    const double aa = s.x[i] * s.x[i] + s.y[i] * s.y[i] + s.z[i] * s.z[i];
    const double bb = s.x[i + 1] * s.x[i + 1] + s.y[i + 1] * s.y[i + 1] + s.z[i + 1] * s.z[i + 1];
    const double inverse = 1.0 / (nx * p.x + ny * p.y + nz * p.z);
    out.x[i] = nx * inverse;
    out.y[i] = ny * inverse;
    out.z[i] = nz * inverse;
    out.bound[i] = plane_bound(out.x[i], out.y[i], out.z[i], (aa + bb) * inverse);
  }
}

/// Surface Delaunay balls as Ellipsoid::ball_centre() finds them: from the circumcentre along the
/// normal n to the surface, the outer root of |q + t n|_W = 1, W = diag(1 / r^2).
inline void ball_lanes(const Vertex& p, const Vec3& weight, const StarLanes& s, CircleLanes& out) {
  const double wx = weight.x(), wy = weight.y(), wz = weight.z();
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double ux = s.x[i], uy = s.y[i], uz = s.z[i];
    const double vx = s.x[i + 1], vy = s.y[i + 1], vz = s.z[i + 1];
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const double uu = ux * ux + uy * uy + uz * uz, vv = vx * vx + vy * vy + vz * vz;
    const double half = 0.5 / (nx * nx + ny * ny + nz * nz);
    // Circumcentre - p = (|u|^2 v x n + |v|^2 n x u) / (2 |n|^2).
    const double mx = uu * vx - vv * ux, my = uu * vy - vv * uy, mz = uu * vz - vv * uz;
    const double ox = half * (my * nz - mz * ny), oy = half * (mz * nx - mx * nz);
    const double oz = half * (mx * ny - my * nx);
    const double qx = p.x + ox, qy = p.y + oy, qz = p.z + oz;
    const double a = wx * nx * nx + wy * ny * ny + wz * nz * nz;
    const double b = wx * nx * qx + wy * ny * qy + wz * nz * qz;
    const double c = wx * qx * qx + wy * qy * qy + wz * qz * qz - 1.0;
    const double discriminant = b * b - a * c;
    const double root = std::sqrt(discriminant > 0.0 ? discriminant : 0.0);
    const double t = b > 0.0 ? -c / (b + root) : (root - b) / a;
    // A line that misses the surface belongs to a triangle as large as the body; its direction
    // stands in.
    const bool is_hit = discriminant >= 0.0;
    const double x = is_hit ? qx + t * nx : nx, y = is_hit ? qy + t * ny : ny;
    const double z = is_hit ? qz + t * nz : nz;
    const double scale = 1.0 / std::sqrt(wx * x * x + wy * y * y + wz * z * z);
    out.x[i] = x * scale;
    out.y[i] = y * scale;
    out.z[i] = z * scale;
    const double dx = out.x[i] - p.x, dy = out.y[i] - p.y, dz = out.z[i] - p.z;
    out.bound[i] = dx * dx + dy * dy + dz * dz;
  }
}

/// The same arithmetic as TileFront::flag(): how far off the two bounds, which are compared as
/// squares, with the circumradius R^2 = product / (4 |cross|^2).
inline void flag_lanes(const Vertex& p, const BoundFactors& bounds, const StarLanes& s,
                       CircleLanes& out) {
  const double size_factor = bounds.size, edge_factor = bounds.edge;  // which no store may change
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double nx = s.y[i] * s.z[i + 1] - s.z[i] * s.y[i + 1];
    const double ny = s.z[i] * s.x[i + 1] - s.x[i] * s.z[i + 1];
    const double nz = s.x[i] * s.y[i + 1] - s.y[i] * s.x[i + 1];
    const double aa = s.x[i] * s.x[i] + s.y[i] * s.y[i] + s.z[i] * s.z[i];
    const double bb = s.x[i + 1] * s.x[i + 1] + s.y[i + 1] * s.y[i + 1] + s.z[i + 1] * s.z[i + 1];
    const double dx = s.x[i] - s.x[i + 1], dy = s.y[i] - s.y[i + 1], dz = s.z[i] - s.z[i + 1];
    const double cc = dx * dx + dy * dy + dz * dz;
    const double h = s.spacing[i] + s.spacing[i + 1] + p.spacing;
    const double product = aa * bb * cc, cross = nx * nx + ny * ny + nz * nz;
    const double ab = aa < bb ? aa : bb;
    out.size_excess[i] = product - size_factor * h * h * cross;
    out.edge_excess[i] = product - edge_factor * (ab < cc ? ab : cc) * cross;
  }
}

}  // namespace delos
