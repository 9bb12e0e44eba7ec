// A file joined with itself, through the program.
#include <gtest/gtest.h>

#include <array>

#include "meshgraft/unv.hpp"
#include "program.hpp"
#include "support/scenes.hpp"

namespace meshgraft::cli_tests {
namespace {

/// A wall, and a rib that stops a little short of it.
Model assembly() {
  return scenes::together(std::array{scenes::plate({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.1, "WALL"),
                                     scenes::plate({0.33, 0.97, 0.0005}, {1.28, 0, 0}, {0, 0, 0.4}, 0.1, "RIB", 0.15)});
}

TEST(SelfMerge, NodesOfTheFileThatMoveAreWrittenWithTheirLabels) {
  const Folder folder;
  ASSERT_TRUE(write_unv(assembly(), folder / "in.unv"));
  const auto run = folder.run({"merge", "in.unv", "-o", "out.unv", "--report", "r.json"});
  EXPECT_EQ(run.code, 0) << run.err;
  const auto before = read_unv(folder / "in.unv"), after = read_unv(folder / "out.unv");
  ASSERT_TRUE(before && after);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before->n_nodes(); ++i)
    for (std::size_t j = 0; j < after->n_nodes(); ++j)
      if (before->node_label[i] == after->node_label[j] && before->position[i] != after->position[j]) {
        ++moved;
        EXPECT_EQ(after->position[j].z, 0);
      }
  EXPECT_GT(moved, 0u);
  EXPECT_NE(run.out.find("2 of 2 connected meshes met"), std::string::npos) << run.out;
}

TEST(SelfMerge, OneConnectedMeshIsExitCode4) {
  const Folder folder;
  ASSERT_TRUE(write_unv(scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1), folder / "in.unv"));
  const auto run = folder.run({"merge", "in.unv", "-o", "out.unv"});
  EXPECT_EQ(run.code, 4);
  EXPECT_NE(run.err.find("hang together already"), std::string::npos) << run.err;
}

TEST(SelfMerge, JoinLimitsItToTwoGroups) {
  const Folder folder;
  ASSERT_TRUE(write_unv(assembly(), folder / "in.unv"));
  EXPECT_EQ(folder.run({"merge", "in.unv", "-o", "out.unv", "--join", "RIB:WALL"}).code, 0);
  const auto run = folder.run({"merge", "in.unv", "-o", "none.unv", "--join", "RIB:DECK"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("DECK"), std::string::npos) << run.err;
}

TEST(SelfMerge, OnlyMeshesOfTheNamedGroupsAreCounted) {
  const Folder folder;
  const Model other = scenes::plate({0, 0, 5}, {2, 0, 0}, {0, 2, 0}, 0.1, "OTHER");
  ASSERT_TRUE(write_unv(scenes::together(std::array{assembly(), other}), folder / "in.unv"));
  const auto run = folder.run({"merge", "in.unv", "-o", "out.unv", "--join", "RIB:WALL"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("2 of 2 connected meshes of the groups to be joined met"), std::string::npos) << run.out;
}

}  // namespace
}  // namespace meshgraft::cli_tests
