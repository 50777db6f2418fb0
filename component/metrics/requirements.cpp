// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/requirements.hpp"

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "metrics/certificate.hpp"

namespace delos {
namespace {

// Equilateral triangles have dual_ratio and radius_edge of 1 / sqrt(3): no grid does better.
constexpr double kEquilateral = 0.577;
// A closed surface has cells of five neighbours or fewer, and of six or more when it has many.
constexpr double kTriangle = 3.0, kPentagon = 5.0, kHexagon = 6.0, kMostNeighbours = 100.0;
constexpr double kLargeRatio = 1000.0;

constexpr std::array kRules = {
    RequirementRule{"relative_edge_min", &Requirements::relative_edge_min,
                    &Quality::relative_edge_min, true, "", 0.0, 1.0, true},
    RequirementRule{"relative_edge_max", &Requirements::relative_edge_max,
                    &Quality::relative_edge_max, false, "", 1.0, kLargeRatio, true},
    RequirementRule{"dual_ratio_min", &Requirements::dual_ratio_min, &Quality::dual_ratio_min, true,
                    "", 0.0, kEquilateral},
    RequirementRule{"stagger_max", &Requirements::stagger_max, &Quality::stagger_max, false, "",
                    0.0, kLargeRatio},
    RequirementRule{"area_length_min", &Requirements::area_length_min, &Quality::area_length_min,
                    true, "", 0.0, 1.0},
    RequirementRule{"angle_min", &Requirements::angle_min_deg, &Quality::angle_min_deg, true,
                    " deg", 0.0, 60.0},
    RequirementRule{"angle_max", &Requirements::angle_max_deg, &Quality::angle_max_deg, false,
                    " deg", 60.0, 180.0},
    RequirementRule{"radius_edge_max", &Requirements::radius_edge_max, &Quality::radius_edge_max,
                    false, "", kEquilateral, kLargeRatio},
    RequirementRule{"grading_max", &Requirements::grading_max, &Quality::grading_max, false, "",
                    1.0, kLargeRatio},
    RequirementRule{"degree_min", &Requirements::degree_min, &Quality::degree_min, true, "",
                    kTriangle, kPentagon},
    RequirementRule{"degree_max", &Requirements::degree_max, &Quality::degree_max, false, "",
                    kHexagon, kMostNeighbours},
};

// Not `<` alone: what can't be compared is missed.
bool is_met(const RequirementRule& rule, double wanted, double reached) {
  return rule.is_least ? reached >= wanted : reached <= wanted;
}

std::string missed_sentence(const RequirementRule& rule, double wanted, const Quality& quality) {
  if (rule.needs_spacing && !quality.knows_spacing) {
    return text(rule.key, ": can't be judged, the wanted spacing is not known.");
  }
  const Extreme& worst = quality.*rule.reached;
  if (is_met(rule, wanted, worst.value)) return "";
  return text(rule.key, ": ", worst.value, rule.unit, " instead of at ",
              rule.is_least ? "least " : "most ", wanted, rule.unit, ", at ", describe(worst), ".");
}

}  // namespace

std::span<const RequirementRule> requirement_rules() { return kRules; }

std::vector<std::string> missed_requirements(const Requirements& wanted, const Quality& quality) {
  DELOS_CHECK(quality.n_triangles > 0, ErrorKind::internal,
              "a grid without triangles can't be judged; measure the quality of a closed mesh "
              "first.");
  std::vector<std::string> missed;
  if (wanted.well_centred && quality.n_obtuse > 0) {
    missed.push_back(text("well_centred: ", quality.n_obtuse, " of ", quality.n_triangles,
                          " triangles are obtuse instead of none, the largest angle is ",
                          quality.angle_max_deg.value, " deg, at ", describe(quality.angle_max_deg),
                          "."));
  }
  for (const RequirementRule& rule : kRules) {
    const std::optional<double>& bound = wanted.*rule.wanted;
    if (!bound) continue;
    std::string sentence = missed_sentence(rule, *bound, quality);
    if (!sentence.empty()) missed.push_back(std::move(sentence));
  }
  if (wanted.degree_6_min && !(quality.degree_6 >= *wanted.degree_6_min)) {
    missed.push_back(text("degree_6_min: ", quality.degree_6, " of the cells instead of at least ",
                          *wanted.degree_6_min, " have six neighbours, the most, ",
                          quality.degree_max.value, ", at ", describe(quality.degree_max), "."));
  }
  return missed;
}

}  // namespace delos
