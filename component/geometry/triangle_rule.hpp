// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Quadrature on triangles.
#include <array>
#include <cstddef>

namespace delos {

/// Symmetric rule on the triangle: weights and barycentric coordinates of the nodes, and their
/// products in pairs, [i] without coordinate i.
template <std::size_t kNodes>
struct TriangleRule {
  std::array<double, kNodes> weight{};
  std::array<std::array<double, kNodes>, 3> coordinate{}, product{};
  std::size_t n_nodes = 0;

  constexpr void add(double w, double a, double b, double c) {
    weight[n_nodes] = w;
    coordinate[0][n_nodes] = a;
    coordinate[1][n_nodes] = b;
    coordinate[2][n_nodes] = c;
    product[0][n_nodes] = b * c;
    product[1][n_nodes] = c * a;
    product[2][n_nodes] = a * b;
    ++n_nodes;
  }
  constexpr void add_three(double w, double a) {
    const double rest = (1 - a) - a;
    add(w, a, a, rest);
    add(w, a, rest, a);
    add(w, rest, a, a);
  }
  constexpr void add_six(double w, double a, double b) {
    const double rest = (1 - a) - b;
    add(w, a, b, rest);
    add(w, b, rest, a);
    add(w, rest, a, b);
    add(w, b, a, rest);
    add(w, a, rest, b);
    add(w, rest, b, a);
  }
};

/// Degree 5 (Radon 1948): 9/40, (155 -+ sqrt(15)) / 1200 at (6 -+ sqrt(15)) / 21.
constexpr TriangleRule<7> degree_5() {
  TriangleRule<7> rule;
  rule.add(0.225, 1.0 / 3, 1.0 / 3, 1.0 / 3);
  rule.add_three(0.12593918054482715260, 0.10128650732345633880);
  rule.add_three(0.13239415278850618074, 0.47014206410511508977);
  return rule;
}

/// Degree 8 (Dunavant 1985, doi:10.1002/nme.1620210612), the published digits polished to double
/// precision.
constexpr TriangleRule<16> degree_8() {
  TriangleRule<16> rule;
  rule.add(0.14431560767778716825, 1.0 / 3, 1.0 / 3, 1.0 / 3);
  rule.add_three(0.095091634267284624794, 0.45929258829272315603);
  rule.add_three(0.10321737053471825028, 0.17056930775176020662);
  rule.add_three(0.032458497623198080311, 0.050547228317030975458);
  rule.add_six(0.027230314174434994265, 0.26311282963463811342, 0.72849239295540428124);
  return rule;
}

inline constexpr TriangleRule<7> kDegree5 = degree_5();
inline constexpr TriangleRule<16> kDegree8 = degree_8();

}  // namespace delos
