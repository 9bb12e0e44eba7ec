// Universal files made by hand, line by line.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "meshgraft/unv.hpp"

namespace meshgraft::samples {

/// A line of integers, ten columns each.
inline std::string line(std::initializer_list<std::int64_t> values) {
  std::string text;
  for (const std::int64_t v : values) {
    const std::string digits = std::to_string(v);
    text.append(10 - std::min<std::size_t>(10, digits.size()), ' ').append(digits);
  }
  return text + "\n";
}

inline std::string opening(const std::string& number) {
  std::string text = "    -1\n";
  text.append(6 - number.size(), ' ');
  return text.append(number).append("\n");
}

inline std::string dataset(const std::string& number, const std::string& records) {
  return opening(number) + records + "    -1\n";
}

/// A record of dataset 2411; the reals are given as text of three fields of 25 columns.
inline std::string node(std::int64_t label, const std::string& reals) { return line({label, 1, 1, 11}) + reals + "\n"; }

/// Six nodes: a strip of two unit squares in the plane z = 1/3.
inline const std::string kNodes =
    node(1, "   0.0000000000000000D+00   0.0000000000000000D+00   3.3333333333333331D-01") +
    node(2, "   1.0000000000000000D+00   0.0000000000000000D+00   3.3333333333333331D-01") +
    node(3, "   2.0000000000000000D+00   0.0000000000000000D+00   3.3333333333333331D-01") +
    node(4, "   0.0000000000000000D+00   1.0000000000000000D+00   3.3333333333333331D-01") +
    node(5, "   1.0000000000000000D+00   1.0000000000000000D+00   3.3333333333333331D-01") +
    node(6, "   2.0000000000000000D+00   1.0000000000000000D+00   3.3333333333333331D-01");

/// Four triangles and a beam along the lower side of the first square.
inline const std::string kElements = line({1, 91, 1, 1, 7, 3}) + line({1, 2, 5}) + line({2, 91, 1, 1, 7, 3}) +
                                     line({1, 5, 4}) + line({3, 91, 2, 1, 7, 3}) + line({2, 3, 6}) +
                                     line({4, 91, 2, 1, 7, 3}) + line({2, 6, 5}) + line({5, 21, 3, 1, 8, 2}) +
                                     line({0, 1, 1}) + line({1, 2});

/// Groups in the layout of 2467: LEFT has faces 1, 2; ENDS has nodes 3, 6 and the beam.
inline const std::string kGroups = line({1, 0, 0, 0, 0, 0, 0, 2}) + "LEFT\n" + line({8, 1, 0, 0, 8, 2, 0, 0}) +
                                   line({2, 0, 0, 0, 0, 0, 0, 3}) + "ENDS\n" + line({7, 3, 0, 0, 7, 6, 0, 0}) +
                                   line({8, 5, 0, 0});

inline std::string mesh(const std::string& groups = dataset("2467", kGroups)) {
  return dataset("2411", kNodes) + dataset("2412", kElements) + groups;
}

inline std::string replaced(const std::string& text, std::string_view what, std::string_view by) {
  std::string result;
  std::size_t at = 0;
  for (std::size_t found = text.find(what); found != std::string::npos; found = text.find(what, at)) {
    result.append(text, at, found - at).append(by);
    at = found + what.size();
  }
  return result.append(text, at, std::string::npos);
}

/// Reads and insists that writing gives the same bytes.
inline Model read(const std::string& text, const ReadOptions& options = {}) {
  auto model = read_unv_text(text, "sample.unv", options);
  EXPECT_TRUE(model) << (model ? "" : to_string(model.error()));
  if (!model) return {};
  EXPECT_EQ(unv_text(*model), text);
  return std::move(*model);
}

inline Error error_of(const std::string& text) {
  const auto model = read_unv_text(text, "sample.unv");
  EXPECT_FALSE(model);
  return model ? Error{} : model.error();
}

inline bool warns(const Model& model, std::string_view name) {
  for (const Warning& w : model.warnings)
    if (w.name == name) return true;
  return false;
}

/// Labels of the members of a group.
inline std::vector<std::int64_t> nodes_in(const Model& m, std::size_t group) {
  std::vector<std::int64_t> labels;
  for (std::size_t i = 0; i < m.n_nodes(); ++i)
    if (m.group_sets.contains(m.node_groups[i], GroupId(group))) labels.push_back(m.node_label[i]);
  return labels;
}
inline std::vector<std::int64_t> elements_in(const Model& m, std::size_t group) {
  std::vector<std::int64_t> labels;
  for (std::size_t i = 0; i < m.n_elements(); ++i)
    if (m.group_sets.contains(m.element_groups[i], GroupId(group))) labels.push_back(m.element_label[i]);
  return labels;
}

}  // namespace meshgraft::samples
