// New files, and files that appear whole or not at all.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/digest.hpp"
#include "io/unv_samples.hpp"
#include "support/scenes.hpp"

namespace meshgraft {
namespace {

using namespace samples;
namespace fs = std::filesystem;

class Folder {
 public:
  Folder()
      : path_(fs::temp_directory_path() / ("meshgraft-" + std::to_string(::getpid()) + "-" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] std::size_t n_files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
  }

 private:
  fs::path path_;
};

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(UnvWrite, NewFileReadsBackEqual) {
  ModelBuilder b;
  const NodeId n0 = b.add_node({1.0 / 3.0, -0.1, 1e-30}, 7), n1 = b.add_node({1e20, 2.0 / 3.0, -1e-98}, 3),
               n2 = b.add_node({0.1 + 0.2, -0.0, 5e-324}, 900);
  const ElementId face = b.add_face(n0, n1, n2, 4, 5), beam = b.add_line(n2, n0);
  ElementAttributes hex;
  hex.shape = Shape::kOther, hex.type = 122;
  b.add_element(hex, std::vector<NodeId>(11, n1), 55);
  b.add_to_group("BOTH", n1), b.add_to_group("BOTH", face), b.add_to_group("BEAM", beam);
  Model made = b.build();
  made.groups.push_back({"EMPTY", 3});
  made.units = Units{5, 1000, 1000, 1, 273.15};
  made.orientation_nodes.push_back({beam, n1});

  const auto text = unv_text(made);
  ASSERT_TRUE(text);
  const Model m = read(*text);
  EXPECT_EQ(m.node_label, made.node_label);
  EXPECT_EQ(m.element_label, made.element_label);
  EXPECT_EQ(m.nodes, made.nodes);
  EXPECT_EQ(m.first_node, made.first_node);
  EXPECT_EQ(m.position[0], made.position[0]);
  EXPECT_EQ(m.position[1], made.position[1]);
  EXPECT_EQ(m.position[2], (Vec3{0.1 + 0.2, 0, 0})) << "what is nearer to zero than 1e-99 becomes zero";
  EXPECT_EQ(m.units, made.units);
  ASSERT_EQ(m.orientation_nodes.size(), 1u);
  EXPECT_EQ(m.orientation_nodes[0].node, n1);
  for (std::size_t e = 0; e < 3; ++e) EXPECT_EQ(m.attributes_of(ElementId(e)), made.attributes_of(ElementId(e)));
  ASSERT_EQ(m.groups.size(), 3u);
  for (std::size_t g = 0; g < 3; ++g) {
    EXPECT_EQ(m.groups[g].name, made.groups[g].name);
    EXPECT_EQ(m.groups[g].number, made.groups[g].number);
    EXPECT_EQ(nodes_in(m, g), nodes_in(made, g));
    EXPECT_EQ(elements_in(m, g), elements_in(made, g));
  }
}

TEST(UnvWrite, NumberOfThreadsChangesNothing) {
  const auto text = unv_text(scenes::plate({0, 0, 1.0 / 3.0}, {1, 0, 0}, {0, 1, 0}, 0.006));
  ASSERT_TRUE(text);
  ASSERT_GT(text->size(), std::size_t{4} << 20) << "more than one piece";
  const auto one = read_unv_text(*text, "a", {1}), four = read_unv_text(*text, "a", {4});
  ASSERT_TRUE(one);
  ASSERT_TRUE(four);
  EXPECT_EQ(one->position, four->position);
  EXPECT_EQ(one->nodes, four->nodes);
  EXPECT_EQ(one->element_place, four->element_place);
  EXPECT_EQ(one->element_groups, four->element_groups);
  EXPECT_EQ(one->node_place, four->node_place);
}

TEST(UnvWrite, LabelsOfElevenDigitsAreRefused) {
  ModelBuilder b;
  b.add_node({}, 10'000'000'000);
  const auto text = unv_text(b.build());
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::kLabelOverflow);
}

TEST(UnvWrite, FileIsReplacedWhole) {
  const Folder folder;
  const std::string path = folder.file("out.unv");
  const Model m = read(mesh());
  ASSERT_TRUE(write_unv(m, path));
  EXPECT_EQ(content(path), mesh());
  // Over the file that is mapped.
  const auto mapped = read_unv(path);
  ASSERT_TRUE(mapped);
  ASSERT_TRUE(write_unv(*mapped, path));
  EXPECT_EQ(content(path), mesh());
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(UnvWrite, FailureLeavesNothingBehind) {
  const Folder folder;
  const Model m = read(mesh());
  const auto missing = write_unv(m, folder.file("no-folder/out.unv"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kCannotWrite);
  const auto is_folder = write_unv(m, folder.file(""));
  ASSERT_FALSE(is_folder);
  EXPECT_EQ(is_folder.error().code, ErrorCode::kCannotWrite);
  ModelBuilder b;
  b.add_node({}, 10'000'000'000);
  EXPECT_FALSE(write_unv(b.build(), folder.file("out.unv")));
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST(UnvWrite, DigestAndCountsOfAnInput) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const InputSummary s = input_summary(read(mesh()));
  EXPECT_EQ(s.path, "sample.unv");
  EXPECT_EQ(s.bytes, mesh().size());
  EXPECT_EQ(s.nodes, 6u);
  EXPECT_EQ(s.elements_by_kind.at("triangle"), 4u);
  EXPECT_EQ(s.elements_by_kind.at("line"), 1u);
  EXPECT_EQ(s.groups, 2u);
}

}  // namespace
}  // namespace meshgraft
