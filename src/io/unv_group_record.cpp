#include <algorithm>

#include "io/unv_groups.hpp"
#include "io/unv_numbers.hpp"
#include "io/unv_pieces.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::size_t kFewestHeaderFields = 6, kMostHeaderFields = 8;
constexpr std::int64_t kLargestCode = 99;
constexpr std::size_t kLineColumns = 80;

bool is_header_shape(const std::vector<std::int64_t>& values) {
  return values.size() >= kFewestHeaderFields && values.size() <= kMostHeaderFields && values.back() >= 0;
}

/// Whole entities with codes that exist.
bool is_entity_line(const std::vector<std::int64_t>& values, GroupLayout layout) {
  if (values.empty() || values.size() % layout.entity_size != 0) return false;
  for (std::size_t k = 0; k < values.size(); k += layout.entity_size)
    if (values[k] < 1 || values[k] > kLargestCode) return false;
  return true;
}

/// No entity has code 0, and most headers have zeros where entities have codes.
bool has_code_zero(const std::vector<std::int64_t>& values, GroupLayout layout) {
  for (std::size_t k = 0; k < values.size(); k += layout.entity_size)
    if (values[k] == 0) return true;
  return false;
}

void take(const std::vector<std::int64_t>& values, GroupLayout layout, std::vector<Entity>& entities) {
  for (std::size_t k = 0; k + layout.entity_size <= values.size(); k += layout.entity_size) {
    Entity e{values[k], values[k + 1], 0, 0};
    if (layout.entity_size == 4) e.leaf = values[k + 2], e.component = values[k + 3];
    entities.push_back(e);
  }
}

/// Whether the line at `at` continues a group that should have ended: it holds entities, and cannot
/// be the header of the next group because what follows cannot be a name.
bool continues_group(const LineScanner& lines, std::size_t at, std::size_t limit, GroupLayout layout,
                     std::vector<std::int64_t>& values) {
  std::vector<std::int64_t> next;
  const Line line = lines.at(at, limit);
  if (parse_integers(lines.view(line), values) == Cut::kNone || !is_entity_line(values, layout)) return false;
  if (values.size() != layout.header_fields) return !is_header_shape(values);
  if (line.next >= limit) return true;
  return parse_integers(lines.view(lines.at(line.next, limit)), next) != Cut::kNone &&
         (is_entity_line(next, layout) || is_header_shape(next));
}

}  // namespace

bool looks_like_entities(const LineScanner& lines, const Line& line, GroupLayout layout) {
  std::vector<std::int64_t> values;
  return parse_integers(lines.view(line), values) != Cut::kNone && is_entity_line(values, layout);
}

std::size_t entities_per_line(GroupLayout layout) { return kLineColumns / kIntegerWidth / layout.entity_size; }

tl::expected<void, Fault> group_record(const LineScanner& lines, std::size_t begin, std::size_t limit,
                                       GroupLayout layout, GroupRecord& record) {
  record.header_line = lines.at(begin, limit);
  record.entities.clear();
  const Cut cut = parse_integers(lines.view(record.header_line), record.header);
  record.columns = cut == Cut::kColumns;
  if (cut == Cut::kNone || !is_header_shape(record.header))
    return tl::unexpected(Fault{ErrorCode::kMalformed, begin,
                                "expected the " + std::to_string(layout.header_fields) +
                                    " integers of a group, found '" +
                                    std::string(trimmed(lines.view(record.header_line))) + "'",
                                kLookHere});
  std::size_t at = record.header_line.next;
  if (at >= limit)
    return tl::unexpected(Fault{ErrorCode::kTruncated, begin,
                                "group " + std::to_string(record.header[0]) + " has no name line", kExportAgain});
  record.name_line = lines.at(at, limit);
  at = record.name_line.next;

  const auto declared = static_cast<std::uint64_t>(record.header.back());
  std::vector<std::int64_t> values;
  std::size_t last_line = at, before_last = 0;  // start of the last entity line, entities before it
  std::size_t last_fields = 0;
  while (record.entities.size() < declared) {
    const std::size_t line_begin = skip_blank_lines(lines, at, limit);
    if (line_begin >= limit) break;
    const Line line = lines.at(line_begin, limit);
    const Cut line_cut = parse_integers(lines.view(line), values);
    if (line_cut != Cut::kNone && values.size() == layout.header_fields && has_code_zero(values, layout)) break;
    if (line_cut == Cut::kNone || values.size() % layout.entity_size != 0) {
      if (line.next >= lines.text.size()) {  // the file was cut here
        at = line.next;
        break;
      }
      // Too few entities: this is a name, and the line before it was the header of its group.
      if (last_fields == layout.header_fields) record.entities.resize(before_last), at = last_line;
      break;
    }
    record.columns = record.columns && line_cut == Cut::kColumns;
    last_line = line_begin, before_last = record.entities.size(), last_fields = values.size();
    take(values, layout, record.entities);
    at = line.next;
  }
  if (record.entities.size() >= declared) {
    for (std::size_t next = skip_blank_lines(lines, at, limit);
         next < limit && continues_group(lines, next, limit, layout, values);
         next = skip_blank_lines(lines, at, limit)) {
      take(values, layout, record.entities);
      at = lines.at(next, limit).next;
    }
  }
  record.end = at;
  return {};
}

bool regular_group(const Document& d, std::size_t begin, std::size_t limit, GroupLayout layout, RegularGroup& group) {
  const std::string_view text = d.lines.text;
  const std::size_t width = layout.header_fields * kIntegerWidth, feed = d.line_end.size();
  if (limit - begin < width + feed || text.compare(begin + width, feed, d.line_end) != 0) return false;
  std::int64_t value = 0;
  bool entity_like = true;
  for (std::size_t k = 0; k < layout.header_fields; ++k) {
    if (!fast_integer(text.data() + begin + k * kIntegerWidth, value)) return false;
    if (k == 0) group.number = value;
    if (k % layout.entity_size == 0 && (value < 1 || value > kLargestCode)) entity_like = false;
  }
  if (entity_like) return false;  // perhaps more entities of the group before
  group.begin = begin, group.count = static_cast<std::uint64_t>(value);
  if (begin + width + feed >= limit) return false;
  group.name_line = d.lines.at(begin + width + feed, limit);
  group.entities = group.name_line.next;
  const std::size_t per_line = entities_per_line(layout);
  const std::uint64_t full = group.count / per_line, rest = group.count % per_line;
  const std::size_t bytes =
      full * (kLineColumns + feed) + (rest > 0 ? rest * layout.entity_size * kIntegerWidth + feed : 0);
  if (bytes > limit - group.entities) return false;
  group.end = group.entities + bytes;
  return text.substr(0, group.end).ends_with(d.line_end);
}

bool is_group_name_place(const Document& d, const Dataset& dataset, std::size_t at) {
  const GroupLayout layout = group_layout_of(dataset.number);
  std::vector<std::int64_t> values;
  std::size_t begin = skip_blank_lines(d.lines, dataset.body, at);
  while (begin < at) {
    const Line header = d.lines.at(begin, at);
    if (parse_integers(d.lines.view(header), values) == Cut::kNone || !is_header_shape(values)) return false;
    if (header.next == at) return true;
    const auto declared = static_cast<std::uint64_t>(values.back());
    begin = d.lines.at(header.next, at).next;
    for (std::uint64_t have = 0; have < declared && begin < at; have += values.size() / layout.entity_size) {
      begin = skip_blank_lines(d.lines, begin, at);
      if (begin >= at) return false;
      const Line line = d.lines.at(begin, at);
      if (parse_integers(d.lines.view(line), values) == Cut::kNone) return false;
      begin = line.next;
    }
    begin = skip_blank_lines(d.lines, begin, at);
  }
  return false;
}

}  // namespace meshgraft::unv
