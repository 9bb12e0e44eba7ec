// Decks for CalculiX, and its results.
#include "calculix.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace meshgraft::validation {
namespace {

/// Two faces of a square, a beam on the diagonal, one side held.
Structure square() {
  Structure s;
  s.position = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  s.faces = {{0, 1, 2}, {0, 2, 3}};
  s.thickness = {5, 8};
  s.pressed = {true, false};
  s.beams = {{0, 2}};
  s.clamped = {0, 1};
  return s;
}

Study steel() {
  Study study;
  study.young = 210000, study.poisson = 0.3, study.density = 7.85e-9;
  study.beam_width = 2, study.beam_normal = {0, 0, 1};
  study.pressure = 0.5;
  study.n_modes = 2, study.spare_modes = 1;
  return study;
}

TEST(Quadratic, FacesAndBeamsShareTheMiddlesOfEdges) {
  const QuadraticMesh mesh = quadratic(square());
  ASSERT_EQ(mesh.position.size(), 4U + 5U);
  EXPECT_EQ(mesh.faces[0][5], mesh.faces[1][3]);
  EXPECT_EQ(mesh.beams[0][1], mesh.faces[0][5]);
  EXPECT_EQ(mesh.position[mesh.beams[0][1]], (Vec3{1, 1, 0}));
}

TEST(Quadratic, TheMiddleOfAHeldEdgeIsHeld) {
  const QuadraticMesh mesh = quadratic(square());
  ASSERT_EQ(mesh.clamped.size(), 3U);
  EXPECT_EQ(mesh.position[mesh.clamped[2]], (Vec3{1, 0, 0}));
}

TEST(Deck, HasASectionForEachThicknessAndTheLoadOnTheFacesThatBearIt) {
  std::ostringstream out;
  write_deck(out, square(), steel());
  const std::string deck = out.str();
  for (const char* text : {"*ELSET, ELSET=SECTION_1\n1,\n*SHELL SECTION, ELSET=SECTION_1, MATERIAL=STEEL\n5\n",
                           "*ELSET, ELSET=SECTION_2\n2,\n*SHELL SECTION, ELSET=SECTION_2, MATERIAL=STEEL\n8\n",
                           "*ELSET, ELSET=PRESSED\n1,\n", "PRESSED,P,0.5\n", "*FREQUENCY\n3\n",
                           "*ELEMENT, TYPE=B32, ELSET=BEAMS\n3,1,7,3\n", "*NSET, NSET=CLAMPED\n1,2,5,\n"})
    EXPECT_NE(deck.find(text), std::string::npos) << text << "\nis not in\n" << deck;
}

/// Files as ccx 2.20 writes them for `square`.
class Results : public testing::Test {
 protected:
  void SetUp() override {
    job_ = (std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name())
               .string();
    frd_ =
        "    1C\n    2C                             9                                     1\n"
        " -1         1 0.00000E+00 0.00000E+00 0.00000E+00\n -3\n" +
        field("  100CL  101 96.34437937           9                     0    1MODAL      1", 1) +
        field("  100CL  102 110.6727880           9                     2    2MODAL      1", 2) +
        field("  100CL  103 1.000000000           9                     0    1           1", 3);
    dat_ =
        "\n     E I G E N V A L U E   O U T P U T\n\n      1   0.36E+06   0.60E+03   0.96E+02   0.0E+00\n\n"
        " stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) for set SHELLS and time  0.1000000E+01\n\n";
    for (int element = 1; element <= 2; ++element)
      for (int point = 1; point <= 9; ++point)
        dat_ += "         " + std::to_string(element) + "   " + std::to_string(point) + "  " + sxx(element, point) +
                "  0.000000E+00  0.000000E+00  0.000000E+00  0.000000E+00  0.000000E+00 _shell_0000000001   \n";
  }

  Result<Response> read() const {
    std::ofstream(job_ + ".frd") << frd_;
    std::ofstream(job_ + ".dat") << dat_;
    return read_calculix(job_, square());
  }

  /// Nine nodes that move against y by `scale` times their number.
  static std::string field(const std::string& head, int scale) {
    std::string text = head + "\n -4  DISP        4    1\n -5  D1          1    2    1    0\n";
    for (int n = 1; n <= 9; ++n)
      text += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", n, 0.0, -1.0 * n * scale, 0.0);
    return text + " -3\n";
  }

  /// Element 1 is stretched by 30; element 2 is bent, by +-60 at its outer points.
  static std::string sxx(int element, int point) {
    if (element == 1) return "3.000000E+01";
    return point <= 3 ? "-6.000000E+01" : point <= 6 ? "0.000000E+00" : "6.000000E+01";
  }

  std::string job_, frd_, dat_;
};

TEST_F(Results, GiveModesStaticsAndTheStressAtTheSurface) {
  const auto response = read();
  ASSERT_TRUE(response) << to_string(response.error());
  EXPECT_EQ(response->frequency, (std::vector<double>{96.34437937, 110.672788}));
  EXPECT_EQ(response->shape[1][2], (Vec3{0, -6, 0}));
  EXPECT_EQ(response->displacement.size(), 4U);
  EXPECT_EQ(response->displacement[3], (Vec3{0, -12, 0}));
  EXPECT_NEAR(response->von_mises[0], 30, 1e-9);
  EXPECT_NEAR(response->von_mises[1], 60 / std::sqrt(0.6), 1e-9);
}

TEST_F(Results, OfARunThatStoppedEarlyAreAnError) {
  dat_.resize(dat_.size() - 200);
  EXPECT_FALSE(read());
}

TEST_F(Results, WithANodeMissingAreAnError) {
  const std::size_t at = frd_.rfind(" -1         2");
  frd_.erase(at, frd_.find('\n', at) + 1 - at);
  const auto response = read();
  ASSERT_FALSE(response);
  EXPECT_NE(response.error().what.find("3 nodes of 4"), std::string::npos);
}

TEST_F(Results, ThatAreNotThereAreAnError) {
  const auto response = read_calculix(job_, square());
  ASSERT_FALSE(response);
  EXPECT_EQ(response.error().code, ErrorCode::kCannotRead);
}

}  // namespace
}  // namespace meshgraft::validation
