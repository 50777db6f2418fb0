// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/require.hpp"

#include "core/error.hpp"

namespace delos {

RequireSettings read_require(MapReader& root) {
  // Those of requirement_rules(), which a test compares, and three more.
  MapReader keys = root.map(
      "require", {"well_centred", "relative_edge_min", "relative_edge_max", "dual_ratio_min",
                  "stagger_max", "area_length_min", "angle_min", "angle_max", "radius_edge_max",
                  "grading_max", "degree_min", "degree_max", "degree_6_min", "keep"});
  RequireSettings out;
  out.bounds.well_centred = keys.boolean("well_centred", false);
  for (const RequirementRule& rule : requirement_rules()) {
    const bool is_angle = *rule.unit != '\0';
    out.bounds.*rule.wanted =
        keys.optional_quantity(rule.key, is_angle ? Dimension::angle : Dimension::none,
                               Bounds::between(rule.lowest, rule.highest));
  }
  out.bounds.degree_6_min =
      keys.optional_quantity("degree_6_min", Dimension::none, Bounds::between(0.0, 1.0));
  out.keep = keys.boolean("keep", false);
  return out;
}

RequireSettings read_require(const ConfigNode& root) {
  ConfigNode alone, effective;
  alone.kind = ConfigNode::Kind::map;
  if (const ConfigNode* const block = root.find("require")) alone.put("require", *block);
  MapReader reader(alone, "", effective, {"require"});
  return read_require(reader);
}

std::string missed_message(const std::string& name, const Settings& settings,
                           const std::vector<std::string>& missed) {
  if (missed.empty()) return "";
  std::string out = text(name, " misses ", missed.size(),
                         missed.size() == 1 ? " requirement." : " requirements.");
  for (const std::string& sentence : missed) out += " " + sentence;
  out += settings.generator == Generator::frontal
             ? " Raise relax.polish_rounds or relax.spring_rounds, lower sizing.gradient_limit, "
             : " Use generator: frontal, ";
  return out + "ask for less, or set require.keep: true to have the grid all the same.";
}

}  // namespace delos
