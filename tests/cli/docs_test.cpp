// The documentation names what the program has, no more and no less.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "cli/exit_codes.hpp"
#include "meshgraft/report.hpp"
#include "program.hpp"

namespace meshgraft::cli_tests {
namespace {

std::vector<std::string> lines_of(const std::string& document) {
  std::istringstream in(read_text(std::filesystem::path(MESHGRAFT_DOCS) / document));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<ErrorCode> all_codes() {
  std::vector<ErrorCode> codes;
  for (int k = 0; std::string(name(static_cast<ErrorCode>(k))) != "unknown"; ++k)
    codes.push_back(static_cast<ErrorCode>(k));
  return codes;
}

TEST(ErrorsDocument, HasOneEntryForEveryCodeInTheirOrder) {
  std::vector<std::string> documented, expected;
  for (const std::string& line : lines_of("errors.md"))
    if (line.starts_with("## ")) documented.push_back(line.substr(3));
  for (const ErrorCode code : all_codes()) expected.emplace_back(name(code));
  EXPECT_EQ(documented, expected);
  EXPECT_EQ(expected.back(), name(ErrorCode::kCannotHold));
}

TEST(ErrorsDocument, TellsTheExitCodeOfEveryCode) {
  const std::vector<std::string> lines = lines_of("errors.md");
  for (const ErrorCode code : all_codes()) {
    const auto heading = std::ranges::find(lines, std::string("## ") + name(code));
    ASSERT_NE(heading, lines.end());
    EXPECT_TRUE((heading + 2)->starts_with("Exit code " + std::to_string(cli::exit_code(code)) + ". ")) << name(code);
  }
}

/// Names in the first column of the table of warnings.
std::set<std::string> documented_warnings() {
  const std::vector<std::string> lines = lines_of("errors.md");
  std::set<std::string> names;
  const std::regex name("`([a-z-]+)`");
  for (auto line = std::ranges::find(lines, "# Warnings"); line != lines.end(); ++line) {
    if (!line->starts_with("| `")) continue;
    const std::string column = line->substr(0, line->find('|', 1));
    for (std::sregex_iterator at(column.begin(), column.end(), name), end; at != end; ++at) names.insert((*at)[1]);
  }
  return names;
}

/// Names that the sources give to warnings: `warn(..., "name",`, `warning("name",`, `warnings.push_back({"name",` and
/// `Warning{"name",`.
std::set<std::string> warnings_of_sources() {
  const std::regex made(R"re(\bwarn(?:ing)?\(\s*(?:[^()"]*,\s*)?"([a-z-]+)",)re"
                        R"re(|\bwarnings?(?:\.push_back\(|\s*=)\s*\{\s*"([a-z-]+)",)re"
                        R"re(|\bWarning\{\s*"([a-z-]+)",)re");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(MESHGRAFT_SOURCES)) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = read_text(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), made), end; at != end; ++at)
      for (std::size_t k = 1; k < at->size(); ++k)
        if ((*at)[k].matched) names.insert((*at)[k]);
  }
  return names;
}

TEST(ErrorsDocument, NamesEveryWarning) {
  std::set<std::string> codes;  // an error that was allowed is a warning of that name
  for (const ErrorCode code : all_codes()) codes.insert(name(code));
  const std::set<std::string> documented = documented_warnings(), made = warnings_of_sources();
  for (const std::string& warning : made) EXPECT_TRUE(documented.contains(warning)) << warning << " has no entry";
  for (const std::string& warning : documented)
    EXPECT_TRUE(made.contains(warning) || codes.contains(warning)) << warning << " is made nowhere";
}

/// Fields whose inner names are data, or are told elsewhere.
const std::set<std::string> kWhole{"inputs[].elements_by_kind", "timings", "warnings[].place",
                                   "broken_promises[].place"};

void collect(const nlohmann::json& value, const std::string& prefix, std::set<std::string>& names) {
  for (const auto& [key, inner] : value.items()) {
    std::string field = prefix + key;
    const bool list = inner.is_array() && (inner.empty() || inner.front().is_object());
    if (list) field += "[]";
    names.insert(field);
    if (kWhole.contains(field)) continue;
    if (inner.is_object()) collect(inner, field + ".", names);
    if (!list) continue;
    for (const auto& item : inner) collect(item, field + ".", names);
  }
}

std::set<std::string> fields_of(const std::string& text) {
  std::set<std::string> names;
  collect(nlohmann::json::parse(text), "", names);
  return names;
}

std::set<std::string> documented_fields() {
  std::set<std::string> names;
  for (const std::string& line : lines_of("report.md"))
    if (line.starts_with("| `")) names.insert(line.substr(3, line.find('`', 3) - 3));
  return names;
}

TEST(ReportDocument, NamesEveryFieldThatThereIs) {
  Report full;
  full.inputs.resize(1);
  full.components.resize(1);
  full.components[0].groups = {"WALL"};
  full.junction.resize(1);
  full.junction[0].inputs = full.junction[0].components = {0, 1};
  full.overlaps.resize(1);
  full.overlaps[0].inputs = full.overlaps[0].components = {0, 1};
  full.zone.bandwidth = {1};
  full.quality.worst.resize(1);
  full.groups.resize(1);
  full.dropped.resize(1);
  full.dropped[0].groups = {"RIB"};
  full.labels.resize(1);
  full.removed_nodes = full.removed_elements = {1};
  full.moved.resize(1);
  full.datasets.resize(1);
  full.warnings.resize(1);
  full.broken_promises.resize(1);
  EXPECT_EQ(fields_of(to_json(full)), documented_fields());
}

TEST(ReportDocument, HoldsForARealReport) {
  const Folder folder;
  folder.put_plates();
  ASSERT_EQ(folder.run({"merge", "base.unv", "part.unv", "-o", "out.unv", "--report", "r.json"}).code, 0);
  const std::string text = folder.text("r.json");
  const std::set<std::string> documented = documented_fields();
  // Empty lists cannot tell lists of numbers from lists of objects.
  for (const std::string& field : fields_of(text))
    EXPECT_TRUE(documented.contains(field) || documented.contains(field.substr(0, field.rfind("[]")))) << field;

  const auto report = nlohmann::json::parse(text);
  EXPECT_EQ(report["version"], MESHGRAFT_VERSION);
  ASSERT_EQ(report["inputs"].size(), 2u);
  EXPECT_EQ(report["inputs"][0]["path"], "base.unv");
  EXPECT_EQ(report["inputs"][0]["sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(report["inputs"][1]["bytes"], folder.text("part.unv").size());
  EXPECT_GT(report["inputs"][0]["elements_by_kind"]["triangle"], 0);
  ASSERT_EQ(report["junction"].size(), 1u);
  EXPECT_FALSE(report["junction"][0]["closed"]);
  EXPECT_NEAR(report["junction"][0]["length"].get<double>(), std::hypot(0.5, 0.02), 1e-12);
  EXPECT_GT(report["zone"]["faces_removed"], 0);
  EXPECT_EQ(report["zone"]["bandwidth"].size(), 2u);
  EXPECT_EQ(report["quality"]["faces"], report["zone"]["faces_created"]);
  EXPECT_GE(report["quality"]["min"], 0.5);
  EXPECT_EQ(report["quality"]["below"], 0);
  EXPECT_LT(report["fidelity"]["max_distance"], 1e-12);
  EXPECT_EQ(report["groups"].size(), 2u);
  EXPECT_GT(report["untouched"]["bytes"], 0);
  EXPECT_GT(report["labels"].size(), 0u);
  EXPECT_GT(report["timings"].size(), 1u);
  EXPECT_GT(report["peak_memory_bytes"], 0);
  EXPECT_TRUE(report["warnings"].empty());
  EXPECT_TRUE(report["broken_promises"].empty());
}

}  // namespace
}  // namespace meshgraft::cli_tests
