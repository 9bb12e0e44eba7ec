// Property and material numbers of two files that do not mean the same.
#include "io/grafts.hpp"
#include "io/unv_samples.hpp"

namespace meshgraft {
namespace {

using namespace samples;

std::string materials(const std::string& name) { return dataset("1703", line({1, 1}) + name + "\n   2.1D+11\n"); }
std::string properties(std::int64_t number, const std::string& name) {
  return dataset("2437", line({number, 10}) + name + "\n   1.0D+01\n");
}

struct Written {
  std::string text;
  Report report;
  [[nodiscard]] std::vector<std::string> fates() const {  // of the part
    std::vector<std::string> all;
    for (const DatasetEntry& d : report.datasets)
      if (d.input == 1) all.push_back(d.fate);
    return all;
  }
};

/// Base and part with all labels of the part moved, as they are when both count from 1.
Written written(const std::string& base_text, const std::string& part_text) {
  const Model base = read(base_text), part = read(part_text);
  Merged merged = nothing(base, {&part, 1});
  shift_all(merged, 1, part, 100);
  Written w;
  const auto text = unv_text(base, {&part, 1}, merged, w.report);
  EXPECT_TRUE(text);
  w.text = text ? *text : std::string();
  return w;
}

using Fates = std::vector<std::string>;

TEST(PropertyTables, ThatDifferAreWarnedAboutWithNumbersElementsAndBothTables) {
  const std::string own = materials("STEEL") + properties(1, "10 MM");
  const Written w = written(own + mesh(), mesh() + materials("ALUMINIUM") + properties(1, "3 MM"));
  EXPECT_TRUE(w.text.starts_with(own));
  EXPECT_EQ(w.text.find("ALUMINIUM"), std::string::npos);
  EXPECT_EQ(w.fates(), (Fates{"side file", "side file"}));
  ASSERT_EQ(w.report.warnings.size(), 1u);
  const Warning& warning = w.report.warnings[0];
  EXPECT_EQ(warning.name, "property-tables");
  for (const char* said : {"property 1", "material 1", "5 elements (the first is 1)", "dataset 1703 (sample.unv:41)",
                           "2437 (sample.unv:47)", "dataset 1703 (sample.unv:2)", "2437 (sample.unv:8)"})
    EXPECT_NE(warning.what.find(said), std::string::npos) << said << " is not in " << warning.what;
  EXPECT_EQ(warning.what.find("property 2"), std::string::npos) << "no table speaks of it";
  EXPECT_EQ(warning.place.line, 41u);
}

TEST(PropertyTables, OfOneTextStandOnceInTheOutput) {
  const std::string one = properties(1, "10 MM"), two = properties(1, "10 MM") + properties(2, "3 MM");
  for (const std::string end : {"\n", "\r\n"}) {
    const Written w = written(mesh() + two, replaced(mesh() + one, "\n", end));
    EXPECT_EQ(w.fates(), (Fates{"same as base"}));
    EXPECT_TRUE(w.report.warnings.empty());
    EXPECT_TRUE(w.text.ends_with(two));
  }
}

TEST(PropertyTables, ThatOnlyAPartHasGoIntoTheOutputWhateverItsLabels) {
  const std::string own = properties(1, "3 MM");
  const Written other = written(replaced(mesh(), line({1, 91, 1, 1, 7, 3}), line({1, 91, 2, 1, 7, 3})), mesh() + own);
  EXPECT_TRUE(other.text.ends_with("    -1\n" + own));
  EXPECT_EQ(other.fates(), (Fates{"kept"}));
}

TEST(PropertyTables, ThatOnlyAPartHasMustNotSilentlyDefineNumbersOfTheBase) {
  const std::string own = properties(1, "3 MM");
  const Written same = written(mesh(), mesh() + own);
  ASSERT_EQ(same.report.warnings.size(), 1u);
  EXPECT_NE(same.report.warnings[0].what.find("property 1 of 2 elements (the first is 1)"), std::string::npos)
      << same.report.warnings[0].what;
  std::string renumbered = kElements;
  for (const int e : {1, 2}) renumbered = replaced(renumbered, line({e, 91, 1, 1, 7, 3}), line({e, 91, 8, 1, 7, 3}));
  const Written other = written(dataset("2411", kNodes) + dataset("2412", renumbered), mesh() + own);
  EXPECT_TRUE(other.report.warnings.empty());
}

TEST(PropertyTables, ThatOnlyTheBaseHasAreNoClash) {
  const Written w = written(mesh() + properties(1, "10 MM"), mesh());
  EXPECT_TRUE(w.report.warnings.empty());
}

}  // namespace
}  // namespace meshgraft
