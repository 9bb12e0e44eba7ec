// 1D elements in holes: which are followed, and what is said about others.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <sstream>

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
    for (const char* name : {"beam-on-filling", "beam-not-followed"})
      EXPECT_EQ(std::ranges::count(m.report.warnings, name, &Warning::name), 0);
    const Model result = apply(base, {}, m);
    EXPECT_EQ(contours_of(result).size(), 1u);
    for (std::size_t k = 0; k + 1 < b.beams.size(); ++k)
      EXPECT_TRUE(is_filled_along(base, result, b.beams[k][0], b.beams[k][1])) << k;
    for (const NewNode& n : m.graft.new_nodes)
      EXPECT_NEAR(n.position.z, b.height(n.position.x, n.position.y), 0.01 * bend);
  }
}

/// Across the hole in steps of 0.05, inner nodes as high as `height` says.
std::vector<NodeId> across(Beamed& b, const std::function<double(double x)>& height) {
  std::vector<NodeId> nodes{b.nearest(0.25, 0.5)};
  for (int k = 1; k < 10; ++k) nodes.push_back(b.builder.add_node({0.25 + 0.05 * k, 0.5, height(0.25 + 0.05 * k)}));
  nodes.push_back(b.nearest(0.75, 0.5));
  return nodes;
}

std::function<double(double)> arch(double rise) {
  return [=](double x) { return rise * std::sin(2 * std::numbers::pi * (x - 0.25)); };
}

/// How many beams the filling follows, and what the warning that others are not says, by its beginning.
struct Fate {
  std::size_t followed = 0;
  std::string told;
  friend bool operator==(const Fate&, const Fate&) = default;
};
std::ostream& operator<<(std::ostream& out, const Fate& f) { return out << f.followed << " followed; " << f.told; }

Fate fate_of(const Model& base, const std::vector<std::array<NodeId, 2>>& beams, const FillOptions& options = {}) {
  const Merged m = made(base, options);
  EXPECT_EQ(broken(m.report), std::vector<std::string>{});
  EXPECT_EQ(broken_laws(base, m), "");
  const Model result = apply(base, {}, m);
  Fate fate;
  for (const auto& [a, b] : beams)
    if (is_filled_along(base, result, a, b)) ++fate.followed;
  for (const Warning& w : m.report.warnings) {
    if (w.name != "beam-not-followed" && w.name != "beam-on-filling") continue;
    fate.told += w.name + ": " + w.what + "\n";
  }
  return fate;
}

Fate fate_of(Beamed& b) { return fate_of(b.builder.build(), b.beams); }

TEST(Fill, BeamsAcrossAFlatHoleAreFollowedHoweverItsNodesAreRounded) {
  for (const double rounding : {0.0, 1e-15, -1e-12, 1e-9}) {
    Beamed beam(0);
    beam.line(across(beam, [&](double) { return rounding; }));
    EXPECT_EQ(fate_of(beam), (Fate{10, ""})) << rounding;

    Beamed rim(0);
    rim.line(across(rim, [](double) { return 0; }));
    Model base = rim.builder.build();
    base.position[rim.nearest(0.5, 0.25).value].z = rounding;
    EXPECT_EQ(fate_of(base, rim.beams), (Fate{10, ""})) << rounding;
  }
}

TEST(Fill, WhetherBeamsAreFollowedDoesNotDependOnHowTheHoleLies) {
  const auto turned = [](Vec3 p) { return Vec3{p.x, 0.8 * p.y - 0.6 * p.z, 0.6 * p.y + 0.8 * p.z}; };
  for (const double rise : {0.02, 0.05, 0.2}) {
    Beamed b(0);
    b.line(across(b, arch(rise)));
    const Model base = b.builder.build();
    const Fate flat = fate_of(base, b.beams);
    EXPECT_EQ(flat.followed, rise < 0.1 ? 10u : 0u) << flat;
    EXPECT_EQ(fate_of(scenes::moved(base, turned), b.beams).followed, flat.followed);
  }
}

TEST(Fill, BeamsThatBeginAndEndAtTheRimAreNamedWhereTheyAreNotFollowed) {
  struct Case {
    std::function<void(Beamed&)> add;
    std::vector<std::string> told;
  };
  const std::vector<Case> cases{
      {[](Beamed& b) { b.line(across(b, arch(0.3))); }, {"more than 20 degrees", "others between them and the rim"}},
      {[](Beamed& b) {  // an arch of few beams
         b.line({b.nearest(0.25, 0.5), b.builder.add_node({0.5, 0.5, 0.06}), b.nearest(0.75, 0.5)});
       },
       {"longer than two sides"}},
      {[](Beamed& b) {
         b.line({b.nearest(0.75, 0.55), b.builder.add_node({0.8, 0.55, 0.01}), b.builder.add_node({0.8, 0.5, 0.01}),
                 b.nearest(0.75, 0.5)});
       },
       {"pass over faces"}},
      {[](Beamed& b) {  // a mast
         b.line({b.nearest(0.25, 0.5), b.builder.add_node({0.25, 0.5, 0.1}), b.builder.add_node({0.3, 0.5, 0.2})});
       },
       {}}};
  for (const Case& c : cases) {
    Beamed b(0);
    c.add(b);
    const Fate fate = fate_of(b);
    EXPECT_EQ(fate.followed, 0u);
    EXPECT_EQ(std::ranges::count(fate.told, '\n'), std::ptrdiff_t(c.told.size())) << fate;
    for (const std::string& words : c.told) EXPECT_NE(fate.told.find(words), std::string::npos) << words << fate;
  }
}

/// Beams nearer to a side of the rim than they are long: faces between them would be flat.
std::vector<NodeId> along_rim(Beamed& b, double off) {
  std::vector<NodeId> nodes{b.nearest(0.35, 0.3)};
  const Vec3 first = b.holed.position[nodes.front().value];
  for (int k = 1; k < 8; ++k) nodes.push_back(b.add(first.x + 0.04 * k, first.y + off));
  nodes.push_back(b.nearest(first.x + 0.3, first.y));
  return nodes;
}

TEST(Fill, BeamsThatWouldBreakAPromiseAreLeftOutAndNamed) {
  for (const double off : {1e-5, 1e-3}) {
    Beamed b(0);
    b.line(along_rim(b, off));
    const std::size_t n_poor = b.beams.size();
    b.line(across(b, [](double) { return 0.0; }));
    const Model base = b.builder.build();
    const Fate fate = fate_of(base, b.beams);  // no promise is broken
    EXPECT_EQ(fate.followed, 10u) << off;
    EXPECT_NE(fate.told.find("smaller --min-quality"), std::string::npos) << fate;
    EXPECT_NE(fate.told.find("and " + std::to_string(n_poor - 1) + " more"), std::string::npos) << fate;

    FillOptions options;
    options.zone.min_quality = 0;
    EXPECT_EQ(fate_of(base, b.beams, options), (Fate{b.beams.size(), ""})) << off;
  }
}

/// Beams a tenth of the sides of the rim: where the two meet, no face is good.
TEST(Fill, BeamsMuchShorterThanTheRimAreFollowedIfTheQualityAllowsIt) {
  Beamed b(0);
  std::vector<NodeId> nodes{b.nearest(0.25, 0.5)};
  for (int k = 1; k < 100; ++k) nodes.push_back(b.add(0.25 + 0.005 * k, 0.5));
  nodes.push_back(b.nearest(0.75, 0.5));
  b.line(nodes);
  const Model base = b.builder.build();
  EXPECT_EQ(fate_of(base, b.beams).followed, 0u);
  FillOptions options;
  options.zone.min_quality = 0.3;
  EXPECT_EQ(fate_of(base, b.beams, options), (Fate{100, ""}));
}

/// Where a promise is broken without any beam, leaving beams out is no help.
TEST(Fill, BeamsStayFollowedWhereFacesElsewhereBreakAPromise) {
  Beamed b(0);
  b.line(across(b, [](double) { return 0.0; }));
  Model base = b.builder.build();
  const NodeId of_rim = b.nearest(0.5, 0.25), beside = b.nearest(0.55, 0.25);
  base.position[of_rim.value] += 0.9999 * (base.position[beside.value] - base.position[of_rim.value]);
  const Merged m = made(base);
  EXPECT_FALSE(m.report.broken_promises.empty());
  const Model result = apply(base, {}, m);
  for (const auto& [from, to] : b.beams) EXPECT_TRUE(is_filled_along(base, result, from, to));
}

/// A spring or hinge between nodes in one place, with the beams around.
TEST(Fill, ElementsWithoutLengthAreNamedAndDoNotKeepBeamsFromBeingFollowed) {
  const auto flat = [](double) { return 0.0; };
  for (const bool at_once : {false, true}) {
    Beamed dead_end(0);
    std::vector<NodeId> nodes{dead_end.nearest(0.25, 0.5)};
    for (const double x : {0.3, 0.35, 0.4, 0.45}) nodes.push_back(dead_end.add(x, 0.5));
    const NodeId copy = dead_end.add(0.45, 0.5);
    if (at_once) dead_end.line({copy, nodes.back()});  // the order of elements changes nothing
    dead_end.line(nodes);
    if (!at_once) dead_end.line({nodes.back(), copy});
    const Fate fate = fate_of(dead_end);
    EXPECT_EQ(fate.followed, 4u);
    EXPECT_NE(fate.told.find("have no length"), std::string::npos) << fate;
    EXPECT_EQ(std::ranges::count(fate.told, '\n'), 1) << fate;
  }
  for (const bool is_joined : {false, true}) {
    Beamed hinge(0);
    std::vector<NodeId> left = across(hinge, flat), right(left.begin() + 5, left.end());
    left.resize(6), right[0] = hinge.add(0.5, 0.5);
    hinge.line(left), hinge.line(right);
    if (is_joined) hinge.line({left.back(), right.front()});
    const Fate fate = fate_of(hinge);
    EXPECT_EQ(fate.followed, 9u);  // faces have one of the two nodes
    EXPECT_NE(fate.told.find("another node lies on"), std::string::npos) << fate;
    EXPECT_EQ(fate.told.find("have no length") != std::string::npos, is_joined) << fate;
  }
  Beamed rim(0);  // a beam ends on a copy of one of its nodes
  std::vector<NodeId> nodes = across(rim, flat);
  const Vec3 end = rim.holed.position[nodes.back().value];
  nodes.back() = rim.add(end.x, end.y);
  rim.line(nodes);
  const Fate fate = fate_of(rim);
  EXPECT_EQ(fate.followed, 9u);
  EXPECT_NE(fate.told.find("another node lies on"), std::string::npos) << fate;
}

/// By the words of the warnings: "element 7 at (1, 2, 3), and 4 more".
std::size_t n_told(const std::string& told) {
  std::size_t n = 0;
  std::istringstream lines(told);
  for (std::string line; std::getline(lines, line); ++n) {
    const std::size_t more = line.find(", and ", line.find(": element"));
    if (more != std::string::npos) n += std::stoul(line.substr(more + 6));
  }
  return n;
}

TEST(FillLaws, EachBeamFromRimToRimIsFollowedOrNamed) {
  EXPECT_TRUE(rc::check([] {
    Beamed b(*rc::gen::element(0.0, 0.0, 0.3));
    for (int chain = *rc::gen::inRange(1, 3); chain > 0; --chain) {
      const auto on_rim = [&] {
        const double angle = *rc::gen::inRange(0, 360) * std::numbers::pi / 180;
        return b.nearest(0.5 + 0.25 * std::cos(angle), 0.5 + 0.25 * std::sin(angle));
      };
      const NodeId from = on_rim(), to = on_rim();
      const Vec3 first = b.holed.position[from.value], last = b.holed.position[to.value];
      RC_PRE(distance(first, last) > 0.1);  // otherwise they may be sides of the rim
      const double step = *rc::gen::element(0.04, 0.05, 0.07, 0.15);
      const int n = std::max(1, static_cast<int>(std::lround(distance(first, last) / step)));
      const double rise = *rc::gen::element(0.0, 1e-14, 0.005, 0.02, 0.1);
      std::vector<NodeId> nodes{from};
      for (int k = 1; k < n; ++k) {
        Vec3 p = lerp(first, last, double(k) / n);
        p.z += rise * std::sin(std::numbers::pi * k / n);
        nodes.push_back(b.builder.add_node(p));
        if (*rc::gen::inRange(0, 20) == 0) nodes.push_back(b.builder.add_node(p));  // an element without length
      }
      nodes.push_back(to);
      b.line(nodes);
    }
    const Model base = b.builder.build();
    const Fate fate = fate_of(base, b.beams);
    RC_ASSERT(fate.followed + n_told(fate.told) == b.beams.size());
    RC_TAG(fate.followed == 0 ? "none followed" : fate.told.empty() ? "all followed" : "some followed");
  }));
}

TEST(Fill, BeamsThatCannotBeFollowedAreNamed) {
  const auto warnings_with = [](const std::function<void(Beamed&)>& add) {
    Beamed b(0);
    add(b);
    return std::ranges::count(fate_of(b).told, '\n');
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
