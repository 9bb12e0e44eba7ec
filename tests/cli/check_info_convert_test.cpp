#include <gtest/gtest.h>

#include <array>

#include "program.hpp"
#include "support/scenes.hpp"

namespace meshgraft::cli_tests {
namespace {

bool says(const Outcome& outcome, const std::string& text) { return outcome.out.find(text) != std::string::npos; }

/// Two triangles side by side, a third one across both if wanted.
Model folded(bool with_intersection) {
  ModelBuilder b;
  const NodeId p = b.add_node({0, 0, 0}, 10), q = b.add_node({1, 0, 0}, 20), r = b.add_node({1, 1, 0}, 30),
               s = b.add_node({0, 1, 0}, 40);
  b.add_to_group("PLATE", b.add_face(p, q, r));
  b.add_to_group("PLATE", b.add_face(p, r, s));
  b.add_to_group("RIM", b.add_line(p, q));
  b.add_to_group("RIM", b.add_line(q, r));
  b.add_to_group("N_CORNER", p);
  if (with_intersection)
    b.add_face(b.add_node({0.2, 0.3, -1}, 50), b.add_node({0.9, 0.3, 1}, 60), b.add_node({0.5, 0.4, 1}, 70));
  return b.build();
}

TEST(Check, AcceptsASoundMesh) {
  const Folder folder;
  folder.put("plate.unv", folded(false));
  const Outcome outcome = folder.run({"check", "plate.unv"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(says(outcome, "triangles     2, area 1")) << outcome.out;
  EXPECT_TRUE(says(outcome, "4 free, 0 non-manifold")) << outcome.out;
  EXPECT_TRUE(says(outcome, "verdict       sound")) << outcome.out;
}

TEST(Check, SaysThatItFoundNothingToCheck) {
  const Folder folder;
  ModelBuilder b;
  b.add_line(b.add_node({0, 0, 0}), b.add_node({1, 0, 0}));
  folder.put("beam.unv", b.build());
  const Outcome outcome = folder.run({"check", "beam.unv"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(says(outcome, "not checked: 1 element of other kinds")) << outcome.out;
  EXPECT_TRUE(says(outcome, "verdict       nothing to check")) << outcome.out;
}

TEST(Check, NamesFacesThatIntersectByLabelAndLine) {
  const Folder folder;
  folder.put("plate.unv", folded(true));
  const Outcome outcome = folder.run({"check", "plate.unv"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(says(outcome, "element 1 (line ")) << outcome.out;
  EXPECT_TRUE(says(outcome, "element 5 (line ")) << outcome.out;
  EXPECT_TRUE(says(outcome, "verdict       not sound")) << outcome.out;
}

TEST(Check, ListsAllPlacesWhenVerbose) {
  const Folder folder;
  folder.put("crossed.unv", scenes::together(std::array{scenes::plate({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 1),
                                                        scenes::plate({0.3, 2.1, -1}, {3, 0.2, 0}, {0, 0, 2}, 0.5)}));
  const auto pairs = [](const std::string& out) {
    std::size_t n = 0;
    for (std::size_t at = out.find(" and element "); at != std::string::npos; at = out.find(" and element ", at + 1))
      ++n;
    return n;
  };
  const Outcome some = folder.run({"check", "crossed.unv"}), all = folder.run({"check", "-v", "crossed.unv"});
  EXPECT_EQ(pairs(some.out), 10u);
  const std::size_t more = some.out.find("... and ");
  ASSERT_NE(more, std::string::npos);
  EXPECT_EQ(pairs(all.out), 10 + std::stoul(some.out.substr(more + 8)));
  EXPECT_EQ(all.out.find("... and "), std::string::npos);
}

TEST(Check, AnswersByExitCodeAloneWhenQuiet) {
  const Folder folder;
  folder.put("good.unv", folded(false));
  folder.put("bad.unv", folded(true));
  const Outcome good = folder.run({"check", "-q", "good.unv"}), bad = folder.run({"check", "--quiet", "bad.unv"});
  EXPECT_EQ(good.code, 0);
  EXPECT_EQ(bad.code, 1);
  EXPECT_EQ(good.out + good.err + bad.out + bad.err, "");
}

TEST(Check, ListsFacesBelowTheQualityAskedFor) {
  const Folder folder;
  folder.put("plate.unv", folded(false));
  EXPECT_TRUE(says(folder.run({"check", "plate.unv"}), "0 of 2 below 0.5"));
  const Outcome strict = folder.run({"check", "plate.unv", "--min-quality", "0.9"});
  EXPECT_TRUE(says(strict, "2 of 2 below 0.9")) << strict.out;
  EXPECT_TRUE(says(strict, "element 2 (line ")) << strict.out;
  EXPECT_EQ(strict.code, 0);  // poor is not unsound
}

TEST(Info, TellsWhatIsInTheFile) {
  const Folder folder;
  folder.put("plate.unv", folded(false));
  const Outcome outcome = folder.run({"info", "plate.unv"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* text : {"nodes         4", "elements      4: 2 lines, 2 triangles", "x 0 to 1, y 0 to 1, z 0 to 0",
                           "groups        3", "PLATE     2 elements", "RIM       2 elements", "N_CORNER  1 node"})
    EXPECT_TRUE(says(outcome, text)) << text << "\n" << outcome.out;
}

TEST(Info, ListsThirtyGroupsUnlessVerbose) {
  const Folder folder;
  ModelBuilder b;
  const NodeId p = b.add_node({0, 0, 0});
  for (int g = 1; g <= 33; ++g) {
    std::string name = "G";
    name += std::to_string(g);
    b.add_to_group(name, p);
  }
  folder.put("groups.unv", b.build());
  const Outcome brief = folder.run({"info", "groups.unv"}), full = folder.run({"info", "-v", "groups.unv"});
  EXPECT_TRUE(says(brief, "G30 ")) << brief.out;
  EXPECT_FALSE(says(brief, "G31 "));
  EXPECT_TRUE(says(brief, "and 3 more"));
  EXPECT_TRUE(says(full, "G33 "));
  EXPECT_FALSE(says(full, "more"));
}

TEST(Info, ListsDatasetsItDoesNotInterpret) {
  const Folder folder;
  folder.put("plate.unv", folded(false));
  folder.put("more.unv", folder.text("plate.unv") + "    -1\n  9999\nsomething\n    -1\n");
  EXPECT_TRUE(says(folder.run({"info", "more.unv"}), "9999: 1 dataset from line "));
}

TEST(Info, TakesAFileNamedLikeACommand) {
  const Folder folder;
  folder.put("check", folded(false));
  EXPECT_EQ(folder.run({"info", "check"}).code, 0);
}

TEST(Convert, GivesTheSameBytes) {
  const Folder folder;
  folder.put("plate.unv", folded(false));
  const std::string strange = folder.text("plate.unv") + "    -1\n  9999\n \t kept as it is  \r\n    -1\n";
  folder.put("strange.unv", strange);
  const Outcome outcome = folder.run({"convert", "strange.unv", "copy.UNV"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(folder.text("copy.UNV"), strange);
}

}  // namespace
}  // namespace meshgraft::cli_tests
