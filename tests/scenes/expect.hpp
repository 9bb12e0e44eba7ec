// What the scenes expect of every merge.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "meshgraft/check.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft::scenes {

inline std::string first_problem(const Report& report) {
  return report.broken_promises.empty() ? "" : to_string(report.broken_promises.front());
}

/// Nothing degenerate, doubled or intersecting, and no node alone or twice in one place.
inline void expect_sound(const Model& result) {
  const CheckResult check = meshgraft::check(result);
  EXPECT_TRUE(check.sound()) << check.intersections << " intersections, " << check.n_degenerate_faces << " degenerate, "
                             << check.n_duplicate_faces << " duplicate";
  EXPECT_EQ(check.n_orphan_nodes, 0u);
  EXPECT_EQ(check.n_coincident_nodes, 0u);
}

inline double area_of(const Model& model, ElementId e) {
  const auto t = model.corners(e);
  return 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
}

inline std::map<std::string, double> area_by_group(const Model& model) {
  std::map<std::string, double> areas;
  for (std::size_t e = 0; e < model.n_elements(); ++e)
    if (model.is_face(ElementId(e)))
      for (const GroupId g : model.group_sets.members(model.element_groups[e]))
        areas[model.groups[g.value].name] += area_of(model, ElementId(e));
  return areas;
}

}  // namespace meshgraft::scenes
