// Group records: nine dataset numbers, four layouts (unv.md 3.6, rules 10 to 13).
#pragma once

#include <cstdint>
#include <vector>

#include "io/label_index.hpp"
#include "io/unv_document.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::unv {

inline constexpr std::int64_t kNodeCode = 7, kElementCode = 8;

/// An entry of a group; leaf and component exist in the layouts with four integers per entity.
struct Entity {
  std::int64_t code = 0, tag = 0, leaf = 0, component = 0;
};

/// One group; reused from call to call.
struct GroupRecord {
  std::vector<std::int64_t> header;  // the last one is the number of entities as declared
  std::vector<Entity> entities;
  Line header_line, name_line;
  std::size_t end = 0;
  bool columns = true;
  [[nodiscard]] bool count_is_right() const { return static_cast<std::int64_t>(entities.size()) == header.back(); }
};

/// The group that begins at `begin`, which is not a blank line. Entities are a stream: lines may be
/// short. A declared number that does not match what is there is left to the caller.
[[nodiscard]] tl::expected<void, Fault> group_record(const LineScanner& lines, std::size_t begin, std::size_t limit,
                                                     GroupLayout layout, GroupRecord& record);

/// A group of which every line is full and in columns; nothing but its header and name was read.
struct RegularGroup {
  std::size_t begin = 0, entities = 0, end = 0;
  std::uint64_t count = 0;
  std::int64_t number = 0;
  Line name_line;
};
/// The same for a group that looks regular; false otherwise. The entity lines are not looked at.
[[nodiscard]] bool regular_group(const Document& document, std::size_t begin, std::size_t limit, GroupLayout layout,
                                 RegularGroup& group);
/// Whether a line holds whole entities with codes that exist, and nothing else.
[[nodiscard]] bool looks_like_entities(const LineScanner& lines, const Line& line, GroupLayout layout);
/// Columns of a full line of entities: 80.
[[nodiscard]] std::size_t entities_per_line(GroupLayout layout);

/// Whether the line at `at`, which looks like a delimiter, stands where a group has its name.
[[nodiscard]] bool is_group_name_place(const Document& document, const Dataset& dataset, std::size_t at);

/// Appends the groups of dataset `dataset` (position in document.datasets) to the model and their
/// places to the document, and puts their members into model.node_groups and element_groups.
[[nodiscard]] tl::expected<void, Fault> read_groups(Document& document, std::uint32_t dataset, const LabelIndex& nodes,
                                                    const LabelIndex& elements, Model& model,
                                                    std::vector<Warning>& warnings);

}  // namespace meshgraft::unv
