// Input that is refused, with a line, a value and advice.
#include <filesystem>

#include "io/unv_samples.hpp"

namespace meshgraft {
namespace {

using namespace samples;

TEST(UnvErrors, UnknownNodeNamesElementNodeAndLine) {
  const Error e = error_of(replaced(mesh(), line({2, 3, 6}), line({2, 3, 904})));
  EXPECT_EQ(e.code, ErrorCode::kUnknownNode);
  EXPECT_EQ(e.place.line, 22u);
  EXPECT_EQ(e.what, "element 3 refers to node 904, which no node dataset defines");
  EXPECT_EQ(e.hint, "export the mesh together with its nodes, or remove element 3");
}

TEST(UnvErrors, OnlyMiddleNodesMayBeLeftOut) {
  const auto code_of = [](std::int64_t id, std::initializer_list<std::int64_t> nodes) {
    const auto n = static_cast<std::int64_t>(nodes.size());
    const auto model =
        read_unv_text(dataset("2411", kNodes) + dataset("2412", line({9, id, 1, 1, 7, n}) + line(nodes)), "sample.unv");
    return model ? std::optional<ErrorCode>() : model.error().code;
  };
  EXPECT_EQ(code_of(91, {0, 2, 5}), ErrorCode::kUnknownNode);
  EXPECT_EQ(code_of(94, {1, 2, 5, 0}), ErrorCode::kUnknownNode);
  EXPECT_EQ(code_of(92, {1, 2, 0, 0, 5, 0}), ErrorCode::kUnknownNode);
  EXPECT_EQ(code_of(92, {1, 0, 2, 0, 5, 0}), std::nullopt);
  EXPECT_EQ(code_of(122, {1, 0, 2}), std::nullopt);
  const Error beam = error_of(replaced(mesh(), line({0, 1, 1}) + line({1, 2}), line({0, 1, 1}) + line({1, 0})));
  EXPECT_EQ(beam.code, ErrorCode::kUnknownNode);
}

TEST(UnvErrors, CoordinatesThatAreNoNumbers) {
  for (const std::string bad :
       {"NaN", "Infinity", "-inf", "*********", "1,5", "abc", "1.0D+999", "1.0.0", "--1", "1D"}) {
    const Error e = error_of(dataset("2411", node(7, "   1.0000000000000000D+00" + std::string(25 - bad.size(), ' ') +
                                                         bad + "   1.0000000000000000D+00")));
    EXPECT_EQ(e.code, ErrorCode::kBadNumber) << bad;
    EXPECT_EQ(e.place.line, 4u);
    EXPECT_NE(e.what.find(bad), std::string::npos) << e.what;
    EXPECT_NE(e.what.find("node 7"), std::string::npos) << e.what;
  }
}

TEST(UnvErrors, CoordinatesThatCannotBeCalculatedWith) {
  const auto coordinate = [](const std::string& x) { return std::string(25 - x.size(), ' ') + x; };
  for (const std::string far : {"1.0000000000000000D+51", "-9.999999999999999D+307", "1.7D+308", "1e60"})
    for (int axis = 0; axis < 3; ++axis) {
      std::string reals;
      for (int k = 0; k < 3; ++k) reals += coordinate(k == axis ? far : "1.0000000000000000D+00");
      const Error e = error_of(dataset("2411", node(7, reals)));
      EXPECT_EQ(e.code, ErrorCode::kBadNumber) << far;
      EXPECT_EQ(e.place.line, 4u);
      EXPECT_NE(e.what.find("node 7"), std::string::npos) << e.what;
      EXPECT_NE(e.what.find("too large"), std::string::npos) << e.what;
    }
  const std::string largest = coordinate("1.0000000000000000D+50");
  EXPECT_EQ(read(dataset("2411", node(7, largest + largest + largest))).position.front().x, 1e50);
}

TEST(UnvErrors, MeshesTooSmallToBeCalculatedWith) {
  const auto nodes = [](const std::string& x) {
    const std::string zero = "   0.0000000000000000D+00", other = std::string(25 - x.size(), ' ') + x;
    return dataset("2411", node(7, zero + zero + zero) + node(8, zero + other + zero));
  };
  const Error e = error_of(nodes("1.0000000000000000D-51"));
  EXPECT_EQ(e.code, ErrorCode::kBadNumber);
  EXPECT_NE(e.what.find("1e-51"), std::string::npos) << e.what;
  EXPECT_GT(e.place.line, 0u);
  EXPECT_EQ(read(nodes("1.0000000000000001D-50")).n_nodes(), 2u);
  EXPECT_EQ(read(nodes("0.0000000000000000D+00")).n_nodes(), 2u);  // degenerate, not small
}

TEST(UnvErrors, EveryCutInsideTheMeshIsNoticed) {
  const std::string text = mesh();
  const Model whole = read(text);
  for (std::size_t n = 0; n < text.size(); ++n) {
    const auto model = read_unv_text(text.substr(0, n), "cut.unv", {.unclosed = true});
    if (!model) continue;
    EXPECT_FALSE(model->warnings.empty() && n + 1 < text.size() && model->groups.size() == 2) << n;
    // What is there is whole: no record was cut.
    for (std::size_t i = 0; i < model->n_nodes(); ++i) EXPECT_EQ(model->position[i], whole.position[i]) << n;
    for (std::size_t i = 0; i < model->nodes.size(); ++i) EXPECT_EQ(model->nodes[i], whole.nodes[i]) << n;
    ASSERT_LE(model->groups.size(), whole.groups.size()) << n;
    for (std::size_t g = 0; g < model->groups.size(); ++g)
      EXPECT_EQ(model->groups[g].n_elements + model->groups[g].n_nodes,
                whole.groups[g].n_elements + whole.groups[g].n_nodes)
          << n;
  }
}

TEST(UnvErrors, EveryCutInsideADatasetIsAnErrorUnlessUnclosedFilesAreTaken) {
  std::string before;
  for (const auto& [number, records] : {std::pair{"2411", kNodes}, {"2412", kElements}, {"2467", kGroups}}) {
    const std::string open = before + opening(number), whole = before + dataset(number, records);
    const std::size_t line_end = 1;
    for (std::size_t n = open.size(); n + line_end < whole.size(); ++n)
      EXPECT_FALSE(read_unv_text(whole.substr(0, n), "cut.unv")) << number << ", " << n;
    EXPECT_TRUE(read_unv_text(whole, "cut.unv")) << number;
    before = whole;
  }
}

TEST(UnvErrors, CutInsideARecordIsTruncated) {
  const std::string nodes = opening("2411") + kNodes;
  EXPECT_EQ(error_of(nodes.substr(0, nodes.size() - 40)).code, ErrorCode::kTruncated);
  EXPECT_EQ(error_of(nodes.substr(0, nodes.size() - 76)).code, ErrorCode::kTruncated);
  const std::string groups = mesh(opening("2467") + kGroups);
  EXPECT_EQ(error_of(groups.substr(0, groups.size() - 41)).code, ErrorCode::kTruncated);
  EXPECT_EQ(error_of(groups.substr(0, groups.size() - 23)).code, ErrorCode::kTruncated);
}

TEST(UnvErrors, OneLabelForTwoThings) {
  const Error node_error = error_of(dataset("2411", kNodes + node(3, "   9.0D+00   9.0D+00   9.0D+00")));
  EXPECT_EQ(node_error.code, ErrorCode::kDuplicateLabel);
  EXPECT_EQ(node_error.place.line, 15u);
  const Error element_error =
      error_of(dataset("2411", kNodes) + dataset("2412", kElements + line({3, 91, 1, 1, 7, 3}) + line({1, 2, 6})));
  EXPECT_EQ(element_error.code, ErrorCode::kDuplicateLabel);
}

TEST(UnvErrors, MalformedRecords) {
  EXPECT_EQ(error_of(dataset("2411", "some text\nand more\n")).code, ErrorCode::kMalformed);
  EXPECT_EQ(error_of(dataset("2411", kNodes + line({9, 1, 1, 11}))).code, ErrorCode::kMalformed);
  EXPECT_EQ(error_of(dataset("2411", node(-5, "   9.0D+00   9.0D+00   9.0D+00"))).code, ErrorCode::kMalformed);
  EXPECT_EQ(error_of(dataset("2411", kNodes) + dataset("2412", line({1, 91, 1, 1, 7, 3}) + line({1, 2, 5, 4}))).code,
            ErrorCode::kMalformed);
  EXPECT_EQ(error_of(dataset("2411", kNodes) + dataset("2412", line({1, 91, 1, 1, 7, -3}) + line({1}))).code,
            ErrorCode::kMalformed);
  EXPECT_EQ(error_of(mesh(dataset("2467", "no header\n"))).code, ErrorCode::kMalformed);
}

TEST(UnvErrors, FilesThatAreSomethingElse) {
  const auto what = [](const std::string& text) {
    const Error e = error_of(text);
    EXPECT_EQ(e.code, ErrorCode::kUnknownFormat) << text;
    return e.what;
  };
  EXPECT_NE(what("\x89HDF\r\n\x1a\nxxxx").find("MED"), std::string::npos);
  EXPECT_NE(what("*HEADING\n*NODE\n1, 0., 0., 0.\n").find("Abaqus"), std::string::npos);
  EXPECT_NE(what("$MeshFormat\n2.2 0 8\n").find("Gmsh"), std::string::npos);
  EXPECT_NE(what("# vtk DataFile Version 3.0\n").find("VTK"), std::string::npos);
  std::string wide = "\xFF\xFE";
  for (const char c : mesh()) wide += c, wide += '\0';
  EXPECT_NE(what(wide).find("UTF-16"), std::string::npos);
  EXPECT_NE(what("solid cube\nfacet normal 0 0 1\n").find("STL"), std::string::npos);
  EXPECT_NE(what("$ deck\nSOL 101\nCEND\nBEGIN BULK\n").find("Nastran"), std::string::npos);
  EXPECT_NE(what("INTERSPECTRE\nDIM = 1\n").find("Code_Aster"), std::string::npos);
  what("just a text\n");
  what("    -1\n");
}

TEST(UnvErrors, NothingInTheFile) {
  EXPECT_EQ(error_of("").code, ErrorCode::kEmptyFile);
  EXPECT_EQ(error_of("\n  \n\n").code, ErrorCode::kEmptyFile);
}

TEST(UnvErrors, FilesThatCannotBeRead) {
  const auto missing = read_unv("no-such-folder/no-such-file.unv");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kCannotRead);
  EXPECT_EQ(missing.error().place.file, "no-such-folder/no-such-file.unv");
  const auto folder = read_unv(std::filesystem::temp_directory_path().string());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, ErrorCode::kCannotRead);
}

}  // namespace
}  // namespace meshgraft
