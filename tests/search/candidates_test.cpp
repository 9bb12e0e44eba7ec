#include "search/candidates.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry/quality.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

std::vector<std::vector<ElementId>> candidates_of(const std::vector<Model>& models, const SearchOptions& options = {}) {
  std::vector<const Model*> inputs;
  for (const Model& m : models) inputs.push_back(&m);
  return candidate_faces(inputs, FaceRuns(inputs), one_for_each_input(inputs.size()), options);
}

/// The box of paper 5.1, or that of the tolerance.
Box least_box(const Model& m, ElementId f, const SearchOptions& o) {
  Box scaled, box;
  for (const Vec3 p : m.corners(f)) box.add(p);
  const Vec3 half = 0.5 * (box.high - box.low), centre = midpoint(box.low, box.high);
  scaled.add(centre - o.box_scale * half), scaled.add(centre + o.box_scale * half);
  scaled.add(box.grown(o.tolerance.at(mean_edge_length(m.corners(f)))));
  return scaled;
}

/// Every pair of inputs and of faces, one by one.
std::vector<std::vector<ElementId>> expected(const std::vector<Model>& models, const SearchOptions& o) {
  std::vector<std::vector<ElementId>> result(models.size());
  for (std::size_t a = 0; a < models.size(); ++a)
    for (std::size_t i = 0; i < models[a].n_elements(); ++i) {
      bool meets = false;
      for (std::size_t b = 0; b < models.size() && !meets; ++b)
        for (std::size_t j = 0; b != a && j < models[b].n_elements() && !meets; ++j)
          meets = least_box(models[a], ElementId(i), o).overlaps(least_box(models[b], ElementId(j), o));
      if (meets) result[a].push_back(ElementId(i));
    }
  return result;
}

TEST(Candidates, AStiffenerAcrossAPlateMeetsOnlyTheFacesUnderIt) {
  const auto found = candidates_of(
      {scenes::plate({0, 0, 0}, {10, 0, 0}, {0, 10, 0}, 0.5), scenes::plate({2, 5.2, -1}, {5, 0, 0}, {0, 0, 2}, 0.5)});
  ASSERT_FALSE(found[0].empty());
  ASSERT_FALSE(found[1].empty());
  EXPECT_LE(found[0].size(), 24u);
  EXPECT_TRUE(std::is_sorted(found[0].begin(), found[0].end()));
}

TEST(Candidates, ALargeToleranceReachesAcrossAGap) {
  const std::vector<Model> models{scenes::plate({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 0.5),
                                  scenes::plate({1, 2.1, 0.3}, {2, 0, 0}, {0, 0, 1}, 0.5)};
  EXPECT_TRUE(candidates_of(models)[0].empty());
  SearchOptions wide;
  wide.tolerance = {0.2, false};
  EXPECT_FALSE(candidates_of(models, wide)[0].empty());
}

TEST(Candidates, OneInputAloneHasNone) { EXPECT_TRUE(candidates_of({scenes::sphere({0, 0, 0}, 1, 3)})[0].empty()); }

RC_GTEST_PROP(Candidates, HoldEveryFaceWhoseBoxMeetsAnother, ()) {
  const auto coordinate = [] { return *rc::gen::inRange(-20, 21) / 10.0; };
  std::vector<Model> models{scenes::plate({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, *rc::gen::element(0.4, 1.0, 4.0))};
  for (int parts = *rc::gen::inRange(1, 4); parts > 0; --parts)
    models.push_back(scenes::moved(scenes::plate({0, 0, 0}, {2, 0, 0}, {0.3, 0, 1}, *rc::gen::element(0.3, 0.7)),
                                   [d = Vec3{coordinate(), coordinate(), coordinate()}](Vec3 p) { return p + d; }));
  SearchOptions options;
  options.tolerance = {*rc::gen::element(0.01, 0.2), *rc::gen::arbitrary<bool>()};
  const auto found = candidates_of(models, options), least = expected(models, options);
  for (std::size_t k = 0; k < models.size(); ++k)
    RC_ASSERT(std::includes(found[k].begin(), found[k].end(), least[k].begin(), least[k].end()));
}

}  // namespace
}  // namespace meshgraft
