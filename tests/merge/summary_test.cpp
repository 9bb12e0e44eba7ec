// The junction as polylines, the report as JSON, errors in the words of the user.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "merge/faults.hpp"
#include "merge/junction_summary.hpp"
#include "meshgraft/report.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kInputs = 3;

/// Vertices on given places, each edge carrying faces of the given inputs.
struct Net {
  Complex complex;
  Junction junction;
  std::size_t add(Vec3 p) {
    complex.add_vertex(p, {}, VertexState::kOpen, GroupSets::kEmpty);
    return complex.n_vertices() - 1;
  }
  void join(std::size_t a, std::size_t b, std::vector<std::uint32_t> inputs = {0, 1},
            JunctionEdge::Kind kind = JunctionEdge::kTouching) {
    junction.edges.push_back({{VertexId(std::min(a, b)), VertexId(std::max(a, b))}, std::move(inputs), kind});
  }
  std::vector<PolylineSummary> lines() {
    std::ranges::sort(junction.edges, {}, &JunctionEdge::ends);
    return polylines_of(complex, junction, one_for_each_input(kInputs));
  }
};

TEST(JunctionSummary, AnOpenLineHasItsEndsAndTurnsAsCorners) {
  Net net;
  const auto a = net.add({2, 1, 0}), b = net.add({0, 0, 0}), c = net.add({1, 0, 0}), d = net.add({2, 0, 0});
  net.join(b, c), net.join(c, d), net.join(d, a);
  const auto lines = net.lines();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_FALSE(lines[0].closed);
  EXPECT_DOUBLE_EQ(lines[0].length, 3);
  EXPECT_EQ(lines[0].nodes, 4u);
  EXPECT_EQ(lines[0].corners, 3u);
}

TEST(JunctionSummary, AClosedLineCountsEachNodeOnce) {
  Net net;
  const auto a = net.add({0, 0, 0}), b = net.add({1, 0, 0}), c = net.add({1, 1, 0}), d = net.add({0, 1, 0});
  net.join(a, b), net.join(b, c), net.join(c, d), net.join(d, a);
  const auto lines = net.lines();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_DOUBLE_EQ(lines[0].length, 4);
  EXPECT_EQ(lines[0].nodes, 4u);
  EXPECT_EQ(lines[0].corners, 4u);
}

TEST(JunctionSummary, LinesEndAtBranchesAndWhereOtherInputsMeet) {
  Net net;
  const auto o = net.add({0, 0, 0}), a = net.add({1, 0, 0}), b = net.add({-1, 0, 0}), c = net.add({0, 1, 0});
  const auto d = net.add({2, 0, 0});
  net.join(o, a), net.join(o, b), net.join(o, c), net.join(a, d, {0, 2});
  const auto lines = net.lines();
  EXPECT_EQ(lines.size(), 4u);
  double length = 0;
  for (const PolylineSummary& line : lines) length += line.length;
  EXPECT_DOUBLE_EQ(length, 4);
}

TEST(JunctionSummary, LinesEndWhereAPartNoLongerGoesThrough) {
  Net net;
  const auto a = net.add({0, 0, 0}), b = net.add({1, 0, 0}), c = net.add({2, 0, 0});
  net.join(a, b, {0, 1}, JunctionEdge::kCrossing), net.join(b, c, {0, 1}, JunctionEdge::kTouching);
  const auto lines = net.lines();
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].kind, "crossing");
  EXPECT_EQ(lines[1].kind, "touching");
}

/// A complex of triangles of two inputs on given places; equal places are one vertex.
struct Fan {
  Complex complex;
  std::map<std::array<double, 3>, VertexId> at;
  VertexId vertex(Vec3 p) {
    const auto [it, fresh] = at.try_emplace({p.x, p.y, p.z}, VertexId(complex.n_vertices()));
    if (fresh) complex.add_vertex(p, {}, VertexState::kOpen, GroupSets::kEmpty);
    return it->second;
  }
  void add(std::uint32_t input, Vec3 a, Vec3 b, Vec3 c) {
    complex.face.push_back({vertex(a), vertex(b), vertex(c)});
    complex.component.push_back(input);
  }
};

TEST(JunctionSummary, TheFacesOnALineTellCrossingFromTouching) {
  Fan t;  // two faces of the base on the edge, and one of the part
  t.add(0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), t.add(0, {0, 0, 0}, {1, 0, 0}, {0, -1, 0});
  t.add(1, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  auto lines = polylines_of(t.complex, junction_of(t.complex), one_for_each_input(kInputs));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, "touching");
  EXPECT_EQ(lines[0].inputs, (std::vector<std::uint32_t>{0, 1}));
  t.add(1, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  lines = polylines_of(t.complex, junction_of(t.complex), one_for_each_input(kInputs));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, "crossing");
}

TEST(JunctionSummary, ANodeWhereMeshesMeetWithoutALineIsAPoint) {
  Fan t;
  t.add(0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), t.add(1, {0, 0, 0}, {1, 0, 1}, {0, 1, 1});
  const auto lines = polylines_of(t.complex, junction_of(t.complex), one_for_each_input(kInputs));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, "point");
  EXPECT_EQ(lines[0].nodes, 1u);
  EXPECT_EQ(lines[0].inputs, (std::vector<std::uint32_t>{0, 1}));
}

TEST(ReportJson, ParsesAndHoldsEveryField) {
  Report r;
  r.version = "1";
  r.inputs.push_back({"caf\xe9.unv", "abc", 1, 2, 3, {{"triangle", 3}}, 1});  // Latin-1, not UTF-8
  r.junction.push_back({"crossing", true, 2.5, 10, 2, {0, 1}, {}});
  r.quality.worst.push_back({0.4, {1, 2, 3}, 57, "input angle of 9 degrees"});
  r.groups.push_back({"A \"quoted\"\n", "faces", 1, 2, 1.0 / 3, 0.25, 0, 0, "untouched"});
  r.labels.push_back({1, "node", 5, 100'005});
  r.moved.push_back({1, 7, {0, 0, 0}, {0, 0, 1}, 1});
  r.datasets.push_back({0, "58b", 12, 80, "kept"});
  r.timings.emplace_back("search", 0.5);
  r.warnings.push_back({"parts-apart", "text", {"a.unv", 3}});
  r.broken_promises.push_back({ErrorCode::kPromiseBroken, "what", "hint", {"a.unv", 4}});
  const auto json = nlohmann::json::parse(to_json(r));
  EXPECT_EQ(json["groups"][0]["area_before"].get<double>(), 1.0 / 3);
  EXPECT_EQ(json["groups"][0]["name"], "A \"quoted\"\n");
  EXPECT_EQ(json["junction"][0]["kind"], "crossing");
  EXPECT_EQ(json["junction"][0]["inputs"], nlohmann::json({0, 1}));
  EXPECT_EQ(json["quality"]["worst"][0]["element"], 57);
  EXPECT_EQ(json["labels"][0]["to"], 100'005);
  EXPECT_EQ(json["inputs"][0]["elements_by_kind"]["triangle"], 3);
  EXPECT_EQ(json["timings"]["search"], 0.5);
  EXPECT_EQ(json["broken_promises"][0]["name"], "promise-broken");
  EXPECT_EQ(json["warnings"][0]["place"]["line"], 3);
  for (const char* field : {"version", "inputs", "components", "junction", "zone", "quality", "fidelity", "groups",
                            "untouched", "labels", "removed_nodes", "removed_elements", "moved", "datasets", "timings",
                            "peak_memory_bytes", "warnings", "broken_promises"})
    EXPECT_TRUE(json.contains(field)) << field;
}

TEST(Faults, PartsJoinedThroughOtherPartsAreNotApart) {
  const Components inputs = one_for_each_input(4);
  using Pair = std::array<std::uint32_t, 2>;
  EXPECT_TRUE(parts_apart(inputs, std::vector<Pair>{{0, 3}, {1, 2}, {2, 3}}).empty());
  EXPECT_EQ(parts_apart(inputs, std::vector<Pair>{{0, 3}, {1, 2}}), (std::vector<std::uint32_t>{1, 2}));
}

TEST(Faults, PartsApartAreNamedWithTheirDistanceAndSoAreThoseThatMeet) {
  Model base = scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.5);
  Model far = scenes::plate({0, 0, 3}, {1, 0, 0}, {0, 1, 0}, 0.5), near = base;
  base.path = "base.unv", far.path = "far.unv", near.path = "near.unv";
  const std::array<const Model*, 3> inputs{&base, &far, &near};
  const Error e = apart_error(inputs, std::array{1u});
  EXPECT_EQ(e.code, ErrorCode::kPartsApart);
  EXPECT_EQ(e.what, "far.unv (3 away) does not meet base.unv; near.unv does");
}

TEST(Faults, AJunctionFaultNamesElementsByTheirLabels) {
  ModelBuilder b;
  for (int k = 0; k < 3; ++k) b.add_node({double(k == 1), double(k == 2), 0});
  ElementAttributes shell;
  shell.shape = Shape::kTriangle;
  const std::array<NodeId, 3> nodes{NodeId(std::size_t{0}), NodeId(std::size_t{1}), NodeId(std::size_t{2})};
  b.add_element(shell, nodes, 4711);
  const Model m = b.build("plate.unv");
  const std::array<const Model*, 1> inputs{&m};
  JunctionFault fault{ErrorCode::kOverlap, "faces overlap", {{0, ElementId(std::size_t{0})}}, {1, 2, 3}};
  const Error e = to_error(inputs, fault);
  EXPECT_EQ(e.code, ErrorCode::kOverlap);
  EXPECT_EQ(e.what, "faces overlap: element 4711 of plate.unv at (1, 2, 3)");
  EXPECT_FALSE(e.hint.empty());
  EXPECT_EQ(e.place.file, "plate.unv");
}

TEST(Faults, EachGapLeftOpenIsABrokenPromiseWithBothElements) {
  const Model base = scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  const std::array<const Model*, 2> inputs{&base, &base};
  const ElementId first(std::size_t{0}), second(std::size_t{1});
  const std::array gaps{Corefined::OpenGap{{ElementRef{0, first}, ElementRef{1, second}}, {1, 2, 3}, 0.25}};
  const std::vector<Error> errors = open_gap_errors(inputs, gaps);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].code, ErrorCode::kJunctionNotResolved);
  EXPECT_EQ(errors[0].what,
            "a gap of 0.25, less than the tolerance, is left open: element 1 of PLATE and element 2 of PLATE at "
            "(1, 2, 3)");
  EXPECT_FALSE(errors[0].hint.empty());
}

}  // namespace
}  // namespace meshgraft
