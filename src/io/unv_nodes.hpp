// Node records: datasets 2411, 781 and 15 (unv.md 3.2).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "io/unv_document.hpp"
#include "io/unv_numbers.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::unv {

enum class NodeLayout : std::uint8_t { kTwoLines, kOneLine };
[[nodiscard]] constexpr NodeLayout node_layout_of(std::int64_t dataset_number) {
  return dataset_number == 15 ? NodeLayout::kOneLine : NodeLayout::kTwoLines;
}

struct NodeRecord {
  std::int64_t label = 0;
  std::array<std::int64_t, 3> fields{};  // system of coordinates or for export, of displacements; colour
  Vec3 position;
  bool columns = true;     // all fields stand in their columns
  bool two_reals = false;  // z was not given
  std::size_t end = 0;     // offset after the record
};

/// The record that begins at `begin`, which is not a blank line. Faults: kMalformed, kBadNumber,
/// kTruncated when `limit` comes before the end of the record.
[[nodiscard]] tl::expected<NodeRecord, Fault> node_record(const LineScanner& lines, std::size_t begin,
                                                          std::size_t limit, NodeLayout layout,
                                                          std::vector<std::int64_t>& scratch);

/// What nodes name a coordinate system for. In datasets 15 and 781 the second field says in which one
/// the coordinates are; in 2411 they are global, and it says in which one they shall be shown.
enum SystemUse : std::size_t { kPlacing, kExport, kDisplacement, kSystemUses };

/// Coordinate systems that nodes name, with the offset of the first record that does, by use.
using NamedSystems = std::array<std::map<std::int64_t, std::size_t>, kSystemUses>;

/// Appends the nodes of one dataset: position, label, place, and the systems they name. Parses in parallel when all
/// records have the same number of lines, which the result does not depend on.
[[nodiscard]] tl::expected<void, Fault> read_nodes(const Document& document, const Dataset& dataset, Model& model,
                                                   NamedSystems& systems, std::vector<Warning>& warnings);

}  // namespace meshgraft::unv
