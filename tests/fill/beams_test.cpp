// 1D elements in holes: which are followed, and what is said about others.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "fill/fill_laws.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using scenes::without_faces;

/// Whether an edge of the faces that were made joins two nodes.
bool is_filled_along(const Model& base, const Model& result, NodeId a, NodeId b) {
  for (std::size_t e = base.n_elements(); e < result.n_elements(); ++e) {
    const auto v = result.nodes_of(ElementId(e));
    if (std::ranges::find(v, a) != v.end() && std::ranges::find(v, b) != v.end()) return true;
  }
  return false;
}

/// A plate, flat or part of a saddle, with a round hole, its nodes nearest to points of the plane, and lines.
struct Beamed {
  std::function<double(double, double)> height;
  Model holed;
  ModelBuilder builder;
  std::vector<std::array<NodeId, 2>> beams;

  explicit Beamed(double bend)
      : height([bend](double x, double y) { return bend * (x * x - y * y); }),
        holed(without_faces(scenes::moved(scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.05),
                                          [this](Vec3 p) {
                                            return Vec3{p.x, p.y, height(p.x, p.y)};
                                          }),
                            [](Vec3 p) { return std::hypot(p.x - 0.5, p.y - 0.5) < 0.26; })),
        builder(scenes::faces_of(holed)) {}

  NodeId nearest(double x, double y) const {
    NodeId best{std::size_t{0}};
    const auto far = [&](std::size_t n) { return std::hypot(holed.position[n].x - x, holed.position[n].y - y); };
    for (std::size_t n = 0; n < holed.n_nodes(); ++n)
      if (far(n) < far(best.value)) best = NodeId(n);
    return best;
  }
  NodeId add(double x, double y) { return builder.add_node({x, y, height(x, y)}); }
  void line(const std::vector<NodeId>& nodes) {
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      builder.add_line(nodes[k - 1], nodes[k]);
      beams.push_back({nodes[k - 1], nodes[k]});
    }
  }
};

TEST(Fill, BeamsInAHoleAreFollowed) {
  for (const double bend : {0.0, 0.5}) {
    Beamed b(bend);
    std::vector<NodeId> across{b.nearest(0.25, 0.5)}, branch, dead_end{b.nearest(0.5, 0.25)};
    for (const double x : {0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7}) across.push_back(b.add(x, 0.5));
    across.push_back(b.nearest(0.75, 0.5));
    branch.push_back(across[5]);  // in the middle
    for (const double y : {0.55, 0.6, 0.65, 0.7}) branch.push_back(b.add(0.5, y));
    branch.push_back(b.nearest(0.5, 0.75));
    for (const double y : {0.3, 0.35}) dead_end.push_back(b.add(0.5, y));
    for (const auto& line : {across, branch, dead_end}) b.line(line);
    b.line({across[3], b.builder.add_node({0.4, 0.5, 0.4})});  // a column on them
    const Model base = b.builder.build();
    const Merged m = made(base);
    EXPECT_EQ(broken(m.report), std::vector<std::string>{});
    EXPECT_EQ(broken_laws(base, m), "");
    EXPECT_GE(m.report.quality.min, 0.5);
    EXPECT_EQ(std::ranges::count(m.report.warnings, "beam-on-filling", &Warning::name), 0);
    const Model result = apply(base, {}, m);
    EXPECT_EQ(contours_of(result).size(), 1u);
    for (std::size_t k = 0; k + 1 < b.beams.size(); ++k)
      EXPECT_TRUE(is_filled_along(base, result, b.beams[k][0], b.beams[k][1])) << k;
    for (const NewNode& n : m.graft.new_nodes)
      EXPECT_NEAR(n.position.z, b.height(n.position.x, n.position.y), 0.01 * bend);
  }
}

TEST(Fill, BeamsThatCannotBeFollowedAreNamed) {
  const auto warnings_with = [](const std::function<void(Beamed&)>& add) {
    Beamed b(0);
    add(b);
    const Model base = b.builder.build();
    const Merged m = made(base);
    EXPECT_EQ(broken(m.report), std::vector<std::string>{});
    EXPECT_EQ(broken_laws(base, m), "");
    return std::ranges::count(m.report.warnings, "beam-on-filling", &Warning::name);
  };
  EXPECT_EQ(warnings_with([](Beamed& b) { b.line({b.nearest(0, 0), b.nearest(0.05, 0)}); }), 0);  // along the border
  EXPECT_EQ(warnings_with([](Beamed& b) { b.line({b.nearest(0, 0), b.add(0.51, 0.47)}); }), 1);   // over faces
  EXPECT_EQ(warnings_with([](Beamed& b) { b.line({b.nearest(0.25, 0.5), b.nearest(0.75, 0.5)}); }), 1);  // too long
  EXPECT_EQ(warnings_with([](Beamed& b) { b.line({b.add(0.48, 0.5), b.add(0.52, 0.51)}); }), 1);         // by itself
  EXPECT_EQ(warnings_with([](Beamed& b) {  // crossing each other
              std::vector<NodeId> one{b.nearest(0.25, 0.5)}, other{b.nearest(0.5, 0.25)};
              for (const double at : {0.3, 0.35, 0.4, 0.45, 0.53, 0.57, 0.61, 0.65, 0.7})
                one.push_back(b.add(at, 0.5)), other.push_back(b.add(0.5, at));
              one.push_back(b.nearest(0.75, 0.5)), other.push_back(b.nearest(0.5, 0.75));
              b.line(one), b.line(other);
            }),
            1);
}

}  // namespace
}  // namespace meshgraft
