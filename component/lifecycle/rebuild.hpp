// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The mesh of a running model's grid made anew where the wanted spacing has changed, to a budget.
#include <cstdint>
#include <vector>

#include "lifecycle/generate.hpp"

namespace delos {

/// What a rebuild starts from.
struct RebuildInput {
  const Product& old;           ///< with its dual
  const Grid& whole;            ///< the dual of all of its mesh (WholeGrid)
  const SpacingRecipe& recipe;  ///< that gave the wanted spacing
  /// [n_cells of the whole] or empty: cells that stay whatever is wanted.
  const std::vector<char>& is_fixed;
  std::int64_t cells = 0;  ///< budget; 0: none
};

/// The mesh; phases "refine" and so on. Without a budget what differs by more than the policy's tau
/// is made anew, and around it the spacing passes into that of the old mesh (followed_spacing()),
/// in more rings, or over everything that differs, where the certificate would be missed. With one
/// the count is within 1 % of it: first the spacing of what is made anew is changed, by a factor
/// of 1.05 at most; when that is not enough, more is made anew (what differs by more than the
/// square root of tau, then by its fourth root); then all that differs, and the whole recipe is
/// scaled. A budget that can't be met even so is an Error(config) that says how near it came.
/// `sized` becomes what the mesh follows. Fixed cells stay in any case.
Mesh rebuild_mesh(Context& context, const RebuildInput& input, Sized& sized,
                  std::vector<ReportSection>& sections);

}  // namespace delos
