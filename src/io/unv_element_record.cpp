#include <algorithm>
#include <array>

#include "io/unv_elements.hpp"
#include "io/unv_numbers.hpp"
#include "io/unv_pieces.hpp"
#include "io/unv_types.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::int64_t kMostNodes = 1 << 24;  // of one element; more is a damaged number

std::string list_of(ElementLayout layout) {
  return "expected the " + std::to_string(header_fields(layout)) + " integers of an element";
}

std::int64_t type_of(const std::vector<std::int64_t>& header, ElementLayout layout) {
  return layout == ElementLayout::k71 ? descriptor_of_graphical(header[1]) : header[1];
}

/// 2: a header of a known type begins at `begin` (or nothing follows); 1: a line that has the form
/// of a header; 0: neither.
int header_plausibility(const LineScanner& lines, std::size_t begin, std::size_t limit, ElementLayout layout) {
  begin = skip_blank_lines(lines, begin, limit);
  if (begin >= limit) return 2;
  std::vector<std::int64_t> header;
  if (parse_integers(lines.view(lines.at(begin, limit)), header) == Cut::kNone ||
      header.size() != header_fields(layout) || header.front() < 0 || header.back() < 0 || header.back() > kMostNodes)
    return 0;
  return is_known_type(type_of(header, layout), header.back()) ? 2 : 1;
}

struct Attempt {
  int score = 0;  // 0: the lines cannot be read like this
  Fault fault;
};

/// Reads what follows the header with or without a beam line.
Attempt attempt(const LineScanner& lines, const Line& header_line, std::size_t limit, ElementLayout layout,
                bool with_beam, ElementRecord& record) {
  record.beam.clear(), record.nodes.clear();
  const std::string element = "element " + std::to_string(record.label());
  const auto n = static_cast<std::size_t>(record.header.back());
  std::size_t at = header_line.next;
  int score = 2;
  bool columns = true;
  if (with_beam) {
    if (at >= limit)
      return {
          0, {ErrorCode::kTruncated, header_line.begin, "the record of " + element + " is not complete", kExportAgain}};
    const Line line = lines.at(at, limit);
    const Cut cut = parse_integers(lines.view(line), record.beam);
    if (cut == Cut::kNone || right_trimmed(lines.view(line)) == kUsualDelimiter)
      return {
          0,
          {ErrorCode::kMalformed, line.begin,
           element + ": expected its beam record, found '" + std::string(trimmed(lines.view(line))) + "'", kLookHere}};
    columns = cut == Cut::kColumns;
    constexpr std::size_t kBeamFields = 3;
    score += layout == ElementLayout::k780 || record.beam.size() == kBeamFields ? 1 : 0;
    record.beam_line = at, at = line.next;
  } else {
    score += 1;
  }
  record.node_lines = at;
  std::vector<std::int64_t> values;
  while (record.nodes.size() < n) {
    if (at >= limit)
      return {
          0, {ErrorCode::kTruncated, header_line.begin, "the record of " + element + " is not complete", kExportAgain}};
    const Line line = lines.at(at, limit);
    const Cut cut = parse_integers(lines.view(line), values);
    if (cut == Cut::kNone || values.size() > n - record.nodes.size())
      return {0,
              {ErrorCode::kMalformed, line.begin,
               element + ": expected " + std::to_string(n - record.nodes.size()) + " more node labels, found '" +
                   std::string(trimmed(lines.view(line))) + "'",
               kLookHere}};
    columns = columns && cut == Cut::kColumns;
    record.nodes.insert(record.nodes.end(), values.begin(), values.end());
    at = line.next;
  }
  record.columns = columns, record.end = at;
  return {score + 2 * header_plausibility(lines, at, limit, layout), {}};
}

constexpr int kFullScore = 7;

}  // namespace

ElementLayout element_layout_of(std::int64_t number) {
  return number == 71 ? ElementLayout::k71 : number == 780 ? ElementLayout::k780 : ElementLayout::k2412;
}

std::size_t header_fields(ElementLayout layout) {
  return layout == ElementLayout::k71 ? 7 : layout == ElementLayout::k780 ? 8 : 6;
}

std::optional<Fault> element_record(const LineScanner& lines, std::size_t begin, std::size_t limit,
                                    ElementLayout layout, ElementRecord& record) {
  const Line line = lines.at(begin, limit);
  const Cut cut = parse_integers(lines.view(line), record.header);
  if (cut == Cut::kNone || record.header.size() != header_fields(layout))
    return Fault{ErrorCode::kMalformed, begin,
                 list_of(layout) + ", found '" + std::string(trimmed(lines.view(line))) + "'", kLookHere};
  const std::int64_t n = record.header.back();
  if (record.label() < 0 || n < 0 || n > kMostNodes)
    return Fault{ErrorCode::kMalformed, begin,
                 record.label() < 0
                     ? "element label " + std::to_string(record.label()) + " is negative"
                     : "element " + std::to_string(record.label()) + " cannot have " + std::to_string(n) + " nodes",
                 kLookHere};
  const std::int64_t id = type_of(record.header, layout);
  const bool usual = layout != ElementLayout::k71 && has_beam_record(id);
  Attempt first = attempt(lines, line, limit, layout, usual, record);
  record.unusual_beam = false;
  // At the end of a file that was cut, what is missing must not be explained away.
  const bool cut_short = first.score == 0 && first.fault.code == ErrorCode::kTruncated && limit >= lines.text.size();
  if (first.score < kFullScore && !cut_short) {
    ElementRecord other;
    other.header = record.header;
    const Attempt second = attempt(lines, line, limit, layout, !usual, other);
    if (second.score > first.score) {
      std::swap(record, other);
      record.unusual_beam = !may_have_beam_record(id);
      first = second;
    }
  }
  if (first.score == 0) return first.fault;
  record.columns = record.columns && cut == Cut::kColumns;
  return std::nullopt;
}

ElementAttributes attributes_of(const std::vector<std::int64_t>& h, ElementLayout layout) {
  ElementAttributes a;
  a.type = type_of(h, layout);
  switch (layout) {
    case ElementLayout::k2412:
      a.physical = h[2], a.material = h[3], a.colour = h[4];
      break;
    case ElementLayout::k780:
      a.physical_bin = h[2], a.physical = h[3], a.material_bin = h[4], a.material = h[5], a.colour = h[6];
      break;
    case ElementLayout::k71:
      a.physical_bin = h[2], a.physical = h[3], a.material = h[4], a.colour = h[5];
      break;
  }
  a.shape = shape_of(a.type, h.back());
  return a;
}

std::vector<std::int64_t> header_of(const ElementAttributes& a, std::int64_t label, std::size_t n,
                                    ElementLayout layout) {
  const std::int64_t type = a.type != 0 ? a.type : default_descriptor(a.shape, n);
  const auto count = static_cast<std::int64_t>(n);
  switch (layout) {
    case ElementLayout::k780:
      return {label, type, a.physical_bin, a.physical, a.material_bin, a.material, a.colour, count};
    case ElementLayout::k71:
      return {label, graphical_of_descriptor(type), a.physical_bin, a.physical, a.material, a.colour, count};
    case ElementLayout::k2412:
      break;
  }
  return {label, type, a.physical, a.material, a.colour, count};
}

}  // namespace meshgraft::unv
