// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small help for messages about names that are not there.
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace delos {

/// Smallest number of one-character insertions, removals and replacements that turn `a` into `b`.
inline std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// The candidate most like `wanted`, upper and lower case taken as equal; empty when none is near
/// (more than half of the characters differ).
inline std::string nearest_name(const std::string& wanted,
                                const std::vector<std::string>& candidates) {
  const auto lower = [](std::string s) {
    for (char& c : s) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return s;
  };
  std::string best;
  std::size_t best_distance = wanted.size() / 2 + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(lower(wanted), lower(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

/// "a, b, c"; beyond `limit` names "a, b, ... (12 in all)".
inline std::string join_names(const std::vector<std::string>& names, std::size_t limit = 20) {
  std::string joined;
  for (std::size_t i = 0; i < std::min(names.size(), limit); ++i) {
    joined += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > limit) joined += ", ... (" + std::to_string(names.size()) + " in all)";
  return joined;
}

}  // namespace delos
