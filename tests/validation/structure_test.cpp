// What the groups of a model become in an analysis.
#include "structure.hpp"

#include <gtest/gtest.h>

namespace meshgraft::validation {
namespace {

Study two_plates() {
  Study study;
  study.thickness = {{"WALL", 5}, {"THICK", 3}};
  study.beams = "RIM", study.clamp = "CLAMP", study.pressed = "PRESSURE";
  study.reported = {"THICK"};
  return study;
}

/// Two triangles, the second in both groups of thickness, a beam on their common edge, a node held.
struct TwoFaces {
  ModelBuilder builder;
  std::array<NodeId, 4> n;
  std::array<ElementId, 2> face;
  TwoFaces() {
    builder.add_node({9, 9, 9});  // without a face
    n = {builder.add_node({0, 0, 0}), builder.add_node({1, 0, 0}), builder.add_node({0, 1, 0}),
         builder.add_node({1, 1, 0})};
    face = {builder.add_face(n[0], n[1], n[2]), builder.add_face(n[1], n[3], n[2])};
    for (const ElementId f : face) builder.add_to_group("WALL", f);
    builder.add_to_group("THICK", face[1]);
    builder.add_to_group("PRESSURE", face[0]);
    builder.add_to_group("RIM", builder.add_line(n[1], n[2]));
    builder.add_line(n[0], n[1]);  // in no group: not a beam
    builder.add_to_group("CLAMP", n[3]);
  }
};

TEST(Structure, ThicknessesAddUpOverGroups) {
  const auto structure = structure_of(TwoFaces().builder.build(), two_plates());
  ASSERT_TRUE(structure) << to_string(structure.error());
  EXPECT_EQ(structure->thickness, (std::vector<double>{5, 8}));
  EXPECT_EQ(structure->pressed, (std::vector<bool>{true, false}));
  EXPECT_EQ(structure->reported_faces, (std::vector<std::vector<std::uint32_t>>{{1}}));
}

TEST(Structure, HasTheNodesOfFacesOnly) {
  const auto structure = structure_of(TwoFaces().builder.build(), two_plates());
  ASSERT_TRUE(structure) << to_string(structure.error());
  EXPECT_EQ(structure->position, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(structure->beams, (std::vector<std::array<std::uint32_t, 2>>{{1, 2}}));
  EXPECT_EQ(structure->clamped, (std::vector<std::uint32_t>{3}));
}

TEST(Structure, AFaceWithoutThicknessIsAnError) {
  TwoFaces model;
  model.builder.add_face(model.n[0], model.n[1], model.n[3]);
  const auto structure = structure_of(model.builder.build(), two_plates());
  ASSERT_FALSE(structure);
  EXPECT_NE(structure.error().what.find("no thickness"), std::string::npos);
}

TEST(Structure, AGroupThatIsGoneIsAnError) {
  Study study = two_plates();
  study.reported.emplace_back("STIFFENER");
  EXPECT_FALSE(structure_of(TwoFaces().builder.build(), study));
  study = two_plates();
  study.clamp = "HELD";
  EXPECT_FALSE(structure_of(TwoFaces().builder.build(), study));
}

}  // namespace
}  // namespace meshgraft::validation
