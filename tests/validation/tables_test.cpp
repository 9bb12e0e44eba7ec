// The aims of the study: what the tables say is not met, and only that.
#include "tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "support/scenes.hpp"

namespace meshgraft::validation {
namespace {

class TheTables : public testing::Test {
 protected:
  TheTables() {
    study_.reported = {"PLATE"};
    study_.n_modes = 2, study_.spare_modes = 1;
    cases_ = {plate("refined", Role::kRefined, 0.03, 0, 1), plate("one", Role::kCad, 0.07, 0.004, 0.97),
              plate("two", Role::kCad, 0.08, 0.006, 1.03), plate("merged", Role::kMerged, 0.075, 0.003, 1)};
  }

  /// Half waves along a plate in the first three modes, frequencies too high by `error`, stress rising along the plate
  /// to `stress`.
  static Case plate(const std::string& name, Role role, double size, double error, double stress) {
    Case c{name, role, {}, {}};
    const Model model = scenes::staggered_plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, size, "PLATE", 0.15);
    c.structure.position = model.position;
    for (std::size_t e = 0; e < model.n_elements(); ++e) {
      const auto v = model.nodes_of(ElementId(e));
      c.structure.faces.push_back({v[0].value, v[1].value, v[2].value});
      c.response.von_mises.push_back(stress * centroid(model.corners(ElementId(e))).x);
    }
    c.structure.thickness.assign(c.structure.faces.size(), 5);
    c.structure.reported_faces.resize(1);
    for (std::uint32_t f = 0; f < c.structure.faces.size(); ++f) c.structure.reported_faces[0].push_back(f);
    for (int mode = 1; mode <= 3; ++mode) {
      c.response.frequency.push_back(100 * mode * (1 + error));
      c.response.shape.emplace_back();
      for (const Vec3 p : model.position)
        c.response.shape.back().push_back({0, 0, std::sin(mode * std::numbers::pi * p.x)});
    }
    return c;
  }

  [[nodiscard]] std::vector<std::string> unmet() const { return tables_of(cases_, study_, 0.1).unmet; }
  Response& merged() { return cases_.back().response; }

  Study study_;
  std::vector<Case> cases_;
};

TEST_F(TheTables, HaveNothingToSayOfAMergedMeshThatIsAsGood) {
  EXPECT_EQ(unmet(), std::vector<std::string>{});
  EXPECT_NE(tables_of(cases_, study_, 0.1).text.find("| 2 | 200.00 | +0.40 % to +0.60 % | 200.60 (+0.30 %) |"),
            std::string::npos);
}

TEST_F(TheTables, FollowModesThatChangePlaces) {
  std::swap(merged().shape[1], merged().shape[2]);
  std::swap(merged().frequency[1], merged().frequency[2]);
  EXPECT_EQ(unmet(), std::vector<std::string>{});
}

TEST_F(TheTables, MissALostMode) {
  merged().shape[1] = merged().shape[0];
  ASSERT_FALSE(unmet().empty());
  EXPECT_NE(unmet()[0].find("merged: a mode is lost"), std::string::npos);
}

TEST_F(TheTables, MissAFrequencyThatIsFartherOffThanThoseFromCad) {
  merged().frequency[0] = 100.7;
  ASSERT_EQ(unmet().size(), 2U);
  EXPECT_NE(unmet()[0].find("off in the mean"), std::string::npos);
  EXPECT_NE(unmet()[1].find("meshes from CAD at most 0.60 %"), std::string::npos);
  merged().frequency[0] = 101.1;
  ASSERT_EQ(unmet().size(), 3U);
  EXPECT_NE(unmet()[0].find("a frequency is 1.10 % off"), std::string::npos);
}

TEST_F(TheTables, MissAStressOutsideTheSpreadOfThoseFromCad) {
  for (double& s : merged().von_mises) s *= 1.15;
  ASSERT_EQ(unmet().size(), 2U);
  EXPECT_NE(unmet()[0].find("95 % stress of PLATE"), std::string::npos);
  EXPECT_NE(unmet()[1].find("largest stress of PLATE"), std::string::npos);
}

TEST_F(TheTables, HaveARowOfConvergenceForEachMeshButTheRefinedOne) {
  const std::string rows =
      convergence_of({cases_[0], cases_[3]}, {plate("finer", Role::kMerged, 0.05, 0.001, 1)}, study_);
  const std::string faces = std::to_string(cases_[3].structure.faces.size());
  const auto merged = rows.find("| merged | " + faces + " | +0.30 % | 0.30 % | 0.30 % |\n");
  const auto finer = rows.find("| +0.10 % | 0.10 % | 0.10 % |\n");
  ASSERT_NE(merged, std::string::npos);
  ASSERT_NE(finer, std::string::npos);
  EXPECT_LT(merged, finer);
  EXPECT_EQ(rows.find("refined"), std::string::npos);
}

}  // namespace
}  // namespace meshgraft::validation
