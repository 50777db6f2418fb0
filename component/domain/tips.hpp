// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tips of sea or land one cell wide, and which of them the data do not insist on.
#include <functional>
#include <span>
#include <vector>

#include "domain/mask.hpp"

namespace delos::domain {

/// How far from the share that makes a cell sea its wet share may be for a tip to change sides. At
/// 0.2 tips and offset both become less, at 0.35 tips alone (README).
inline constexpr double kTipMargin = 0.2;

/// Wet shares of cells, how much makes them sea, and what of that a tip may overrule.
struct TipRule {
  std::span<const double> wet_fraction;
  double least_wet = 0.5;
  double margin = 0.0;
};

/// Fills the list with the neighbours of a cell, in the order around it; kNone where none is.
using NeighboursOf = std::function<void(Index cell, std::vector<Index>& neighbours)>;

/// A cell whose neighbours but two at most are of the other kind, in succession, and whose wet
/// share is within the margin changes its kind; neighbours never in one round, the lower id first.
/// Some rounds, until none does. Returns how many did. One thread: the same for any number.
std::int64_t clear_tips(const TipRule& rule, const NeighboursOf& neighbours_of, Mask& sea);

}  // namespace delos::domain
