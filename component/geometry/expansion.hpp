// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact sums and products of doubles as expansions: sums of doubles that do not overlap, smallest
// first (Shewchuk 1997, doi:10.1007/PL00009321), and the two-term "double-double" in between.
// Exact as long as nothing overflows and no product falls below 2^-1022.
#include <array>
#include <cstddef>
#ifdef __FMA__
#include <cmath>
#endif

namespace delos::expansion {

/// hi + lo, hi being the rounded sum.
struct Two {
  double hi, lo;
};

/// a + b exactly (Knuth).
inline Two two_sum(double a, double b) {
  const double s = a + b;
  const double t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// a + b exactly when |a| >= |b|.
inline Two fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// a * b exactly. Both branches give the same two doubles.
inline Two two_product(double a, double b) {
  const double p = a * b;
#ifdef __FMA__
  return {p, std::fma(a, b, -p)};
#else
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1 (Dekker 1971)
  const double ca = kSplitter * a;
  const double cb = kSplitter * b;
  const double ah = ca - (ca - a);
  const double bh = cb - (cb - b);
  const double al = a - ah;
  const double bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
#endif
}

/// Double-double sum: relative error below 2^-103 of |a| + |b| (Joldes et al. 2017, algorithm 6).
inline Two add(const Two& a, const Two& b) {
  const Two s = two_sum(a.hi, b.hi);
  const Two t = two_sum(a.lo, b.lo);
  const Two v = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(v.hi, t.lo + v.lo);
}

/// Double-double product: relative error below 2^-103 (same, algorithm 10).
inline Two multiply(const Two& a, const Two& b) {
  const Two p = two_product(a.hi, b.hi);
  return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline Two negate(const Two& a) { return {-a.hi, -a.lo}; }

/// An exact number of up to N terms, smallest first, without zeros.
template <std::size_t N>
struct Expansion {
  std::array<double, N> term;
  std::size_t n = 0;

  void push(double value) {
    if (value != 0) term[n++] = value;
  }
  /// Sign of the number: that of its largest term.
  int sign() const { return n == 0 ? 0 : (term[n - 1] > 0 ? 1 : -1); }
};

inline Expansion<2> exact_product(double a, double b) {
  const Two p = two_product(a, b);
  Expansion<2> out;
  out.push(p.lo);
  out.push(p.hi);
  return out;
}

template <std::size_t N>
Expansion<N> negate(Expansion<N> e) {
  for (std::size_t i = 0; i < e.n; ++i) e.term[i] = -e.term[i];
  return e;
}

/// e + f (Shewchuk's LINEAR-EXPANSION-SUM by growing: short inputs, simplicity over speed).
template <std::size_t N, std::size_t M>
Expansion<N + M> sum(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> out;
  for (std::size_t i = 0; i < e.n; ++i) out.term[i] = e.term[i];
  out.n = e.n;
  for (std::size_t j = 0; j < f.n; ++j) {
    double carry = f.term[j];
    std::size_t kept = 0;
    for (std::size_t i = 0; i < out.n; ++i) {
      const Two s = two_sum(carry, out.term[i]);
      carry = s.hi;
      if (s.lo != 0) out.term[kept++] = s.lo;
    }
    if (carry != 0) out.term[kept++] = carry;
    out.n = kept;
  }
  return out;
}

/// e * b (Shewchuk's SCALE-EXPANSION with zero elimination).
template <std::size_t N>
Expansion<2 * N> scale(const Expansion<N>& e, double b) {
  Expansion<2 * N> out;
  if (e.n == 0 || b == 0) return out;
  const Two first = two_product(e.term[0], b);
  out.push(first.lo);
  double carry = first.hi;
  for (std::size_t i = 1; i < e.n; ++i) {
    const Two p = two_product(e.term[i], b);
    const Two low = two_sum(carry, p.lo);
    out.push(low.lo);
    const Two high = fast_two_sum(p.hi, low.hi);
    out.push(high.lo);
    carry = high.hi;
  }
  out.push(carry);
  return out;
}

/// a * d - b * c.
inline Expansion<4> minor2(double a, double b, double c, double d) {
  return sum(exact_product(a, d), negate(exact_product(b, c)));
}

}  // namespace delos::expansion
