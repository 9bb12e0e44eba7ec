// Element records: datasets 2412, 780 and 71 (unv.md 3.3, rules 8 and 9).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/label_index.hpp"
#include "io/unv_document.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::unv {

enum class ElementLayout : std::uint8_t { k2412, k780, k71 };
[[nodiscard]] ElementLayout element_layout_of(std::int64_t dataset_number);
/// Number of integers in record 1: 6, 8, 7; the last one is the number of nodes.
[[nodiscard]] std::size_t header_fields(ElementLayout layout);

/// One record; reused from call to call so that parsing needs no memory per record.
struct ElementRecord {
  std::vector<std::int64_t> header;                    // as in the file
  std::vector<std::int64_t> beam;                      // empty if there is no such line
  std::vector<std::int64_t> nodes;                     // labels
  bool columns = true;                                 // all fields stand in their columns
  bool unusual_beam = false;                           // beam line where none belongs, or none where one does
  std::size_t beam_line = 0, node_lines = 0, end = 0;  // offsets; beam_line only if there is one
  [[nodiscard]] std::int64_t label() const { return header[0]; }
};

/// The record that begins at `begin`, which is not a blank line. Whether there is a beam line is
/// decided by the id, checked by what follows.
[[nodiscard]] std::optional<Fault> element_record(const LineScanner& lines, std::size_t begin, std::size_t limit,
                                                  ElementLayout layout, ElementRecord& record);

/// What a header says besides label and number of nodes.
[[nodiscard]] ElementAttributes attributes_of(const std::vector<std::int64_t>& header, ElementLayout layout);
/// A header of the given layout; kinds of numbers that the layout lacks are left out.
[[nodiscard]] std::vector<std::int64_t> header_of(const ElementAttributes& attributes, std::int64_t label,
                                                  std::size_t n, ElementLayout layout);

/// Appends the elements of one dataset, in parallel pieces; the result does not depend on them.
/// `nodes` finds all nodes of the file.
[[nodiscard]] tl::expected<void, Fault> read_elements(const Document& document, const Dataset& dataset,
                                                      const LabelIndex& nodes, Model& model,
                                                      std::vector<Warning>& warnings);

}  // namespace meshgraft::unv
