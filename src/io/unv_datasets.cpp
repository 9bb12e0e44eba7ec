#include "io/unv_datasets.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "io/unv_delimiters.hpp"
#include "io/unv_groups.hpp"
#include "io/unv_numbers.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::size_t kNumberColumns = 6;
constexpr std::int64_t kLargestDataset = 99'999;

struct Number {
  std::int64_t value = 0;
  bool binary = false;
};

/// A dataset number line: a positive integer in columns 1-6 (learned mode: the first token),
/// perhaps with a `b`; anything may follow.
std::optional<Number> number_of(const Document& d, const Line& line) {
  const std::string_view content = d.lines.view(line);
  std::string_view field;
  Number number;
  if (d.delimiter.empty()) {
    field = trimmed(content.substr(0, kNumberColumns));
    number.binary = content.size() > kNumberColumns && content[kNumberColumns] == 'b';
  } else {
    for_each_token(content, [&](std::string_view token) { return field = token, false; });
  }
  if (field.ends_with('b')) field.remove_suffix(1), number.binary = true;
  const auto value = parse_integer(field);
  if (!value || *value <= 0 || *value > kLargestDataset) return std::nullopt;
  number.value = *value;
  return number;
}

/// What follows the `b` in the number line of a binary dataset: byte order, float format, lines of text, bytes. In
/// columns (2I6, 2I12) numbers may touch.
std::vector<std::int64_t> binary_fields(std::string_view number_line) {
  constexpr std::array<std::size_t, 4> kWidths{6, 6, 12, 12};
  const std::size_t b = number_line.find('b');
  std::string_view rest = b == std::string_view::npos ? std::string_view{} : number_line.substr(b + 1);
  const std::string_view tokens = rest;
  std::vector<std::int64_t> fields;
  for (const std::size_t width : kWidths) {
    const auto value = parse_integer(trimmed(rest.substr(0, width)));
    if (!value) break;
    fields.push_back(*value);
    rest.remove_prefix(std::min(width, rest.size()));
  }
  if (fields.size() == kWidths.size()) return fields;
  fields.clear();
  for_each_token(tokens, [&](std::string_view token) {
    const auto value = parse_integer(token);
    if (value) fields.push_back(*value);
    return value.has_value();
  });
  return fields;
}

/// End of the data of a binary dataset: lines of text, then a known number of bytes.
tl::expected<std::size_t, Fault> end_of_binary(const Document& d, const Dataset& dataset) {
  const Line number_line = d.lines.at(dataset.number_line);
  const std::vector<std::int64_t> fields = binary_fields(d.lines.view(number_line));
  constexpr std::size_t kTextLines = 2, kBytes = 3;
  if (fields.size() <= kBytes || fields[kTextLines] < 0 || fields[kBytes] < 0)
    return tl::unexpected(Fault{ErrorCode::kMalformed, dataset.number_line,
                                "the number line of a binary dataset does not say how many bytes follow",
                                "remove the dataset if it is not needed"});
  std::size_t at = number_line.next;
  for (std::int64_t k = 0; k < fields[kTextLines] && at < d.lines.text.size(); ++k) at = d.lines.at(at).next;
  if (static_cast<std::uint64_t>(fields[kBytes]) > d.lines.text.size() - at)
    return tl::unexpected(Fault{ErrorCode::kTruncated, dataset.number_line,
                                "the file ends inside a binary dataset of " + std::to_string(fields[kBytes]) + " bytes",
                                kExportAgain});
  return at + static_cast<std::size_t>(fields[kBytes]);
}

/// First line at or after `at` that is not blank.
std::optional<Line> first_text(const Document& d, std::size_t at, std::size_t limit) {
  while (at < limit) {
    const Line line = d.lines.at(at, limit);
    if (!trimmed(d.lines.view(line)).empty()) return line;
    at = line.next;
  }
  return std::nullopt;
}

class StateMachine {
 public:
  StateMachine(Document& d, LikeRecords like_records, std::vector<Warning>& warnings)
      : d_(d), like_records_(like_records), warnings_(warnings) {}

  tl::expected<void, Fault> run() {
    if (auto done = start_without_delimiter(); !done) return done;
    Delimiters delimiters(d_);
    std::size_t from = 0;  // delimiters before this offset are data
    for (std::size_t at = delimiters.next(from); at < d_.lines.text.size(); at = delimiters.next(from)) {
      const Line line = d_.lines.at(at);
      from = line.next;
      if (auto done = delimiter(line); !done) return done;
      if (inside_ && current().open == at) from = std::max(from, pass_over());
      // The delimiter after binary data need not be at the start of a line.
      while (resume_ > 0 && inside_) {
        const std::size_t end = std::exchange(resume_, 0);
        from = end;
        if (end >= d_.lines.text.size() || !d_.is_delimiter(d_.lines.at(end))) break;
        const Line closing = d_.lines.at(end);
        if (auto done = delimiter(closing); !done) return done;
        from = closing.next;
      }
    }
    if (inside_) leave_unclosed();
    warn_about_text_outside();
    return {};
  }

 private:
  Dataset& current() { return d_.datasets.back(); }

  void warn(std::string name, std::string what, std::size_t offset) {
    warnings_.push_back(d_.warning(std::move(name), std::move(what), offset));
  }

  tl::expected<void, Fault> start(std::size_t open, const Line& line, Number number) {
    Dataset dataset;
    dataset.number = number.value, dataset.binary = number.binary;
    dataset.open = open, dataset.number_line = line.begin, dataset.body = line.next;
    d_.datasets.push_back(dataset);
    inside_ = true;
    if (number.binary) {
      const auto end = end_of_binary(d_, dataset);
      if (!end) return tl::unexpected(end.error());
      resume_ = *end;
    }
    return {};
  }

  /// Where to look for the end of the current dataset, which has just begun.
  std::size_t pass_over() {
    const Dataset& dataset = current();
    if (like_records_ == LikeRecords::kLookedAt || !d_.delimiter.empty()) return dataset.body;
    const std::size_t end = end_of_like_records(d_, dataset);
    d_.passed_over = d_.passed_over || end > dataset.body;
    return end;
  }

  void close(std::size_t body_end, std::size_t end, bool closed) {
    current().body_end = body_end, current().end = end, current().closed = closed;
    inside_ = false;
  }

  /// No record of nodes, elements or groups is a lone -1 (the name of a group apart): as last line
  /// of such a dataset it is the closing delimiter, put into other columns by hand.
  bool close_at_misplaced(std::size_t body_end) {
    if (current().kind() == DatasetKind::kOther || body_end <= current().body) return false;
    std::size_t begin = body_end - 1;
    while (begin > current().body && d_.lines.text[begin - 1] != d_.lines.terminator) --begin;
    if (trimmed(d_.lines.view(d_.lines.at(begin, body_end))) != "-1") return false;
    if (current().kind() == DatasetKind::kGroups && is_group_name_place(d_, current(), begin)) return false;
    warn("misplaced-delimiter",
         "the closing delimiter of dataset " + std::to_string(current().number) + " is not in columns 5-6", begin);
    close(begin, body_end, true);
    return true;
  }

  tl::expected<void, Fault> delimiter(const Line& line) {
    const bool last = line.next >= d_.lines.text.size();
    const Line next = last ? Line{} : d_.lines.at(line.next);
    if (const auto number = last ? std::nullopt : number_of(d_, next)) {
      if (inside_ && !close_at_misplaced(line.begin)) {
        warn("missing-delimiter",
             "dataset " + std::to_string(current().number) + " and dataset " + std::to_string(number->value) +
                 " have one delimiter between them",
             line.begin);
        close(line.begin, line.begin, false);
      }
      return start(line.begin, next, *number);
    }
    if (!inside_) return {};
    if (!last && !d_.is_delimiter(next) && current().kind() == DatasetKind::kGroups &&
        is_group_name_place(d_, current(), line.begin))
      return {};
    if (!close_at_misplaced(line.begin)) close(line.begin, line.next, true);
    return {};
  }

  /// A file whose very first delimiter is missing begins with a number line.
  tl::expected<void, Fault> start_without_delimiter() {
    const auto line = first_text(d_, d_.first, d_.lines.text.size());
    if (!line || d_.is_delimiter(*line)) return {};
    const auto number = number_of(d_, *line);
    constexpr std::array<std::int64_t, 6> kUsualFirst{151, 164, 2420, 2400, 18, 775};
    if (!number || (kind_of(number->value) == DatasetKind::kOther && !std::ranges::count(kUsualFirst, number->value)))
      return {};
    const std::string_view rest = d_.lines.view(*line).substr(std::min(kNumberColumns, line->end - line->begin));
    if (!trimmed(rest).empty()) return {};
    warn("missing-delimiter", "the first dataset has no opening delimiter", line->begin);
    return start(line->begin, *line, *number);
  }

  void leave_unclosed() {
    const std::size_t end = d_.lines.text.size();
    if (close_at_misplaced(end)) return;
    warn("missing-delimiter",
         "the file ends inside dataset " + std::to_string(current().number) + ", which has no closing delimiter",
         current().number_line);
    close(end, end, false);
  }

  void warn_about_text_outside() {
    std::size_t at = d_.first;
    for (std::size_t k = 0; k <= d_.datasets.size(); ++k) {
      const std::size_t limit = k < d_.datasets.size() ? d_.datasets[k].open : d_.lines.text.size();
      for (auto line = first_text(d_, at, limit); line; line = first_text(d_, line->next, limit)) {
        if (d_.is_delimiter(*line)) continue;
        warn("text-outside", "text outside of any dataset is kept but means nothing", line->begin);
        break;
      }
      if (k < d_.datasets.size()) at = d_.datasets[k].end;
    }
  }

  Document& d_;
  LikeRecords like_records_;
  std::vector<Warning>& warnings_;
  bool inside_ = false;
  std::size_t resume_ = 0;
};

tl::expected<void, Fault> unknown_format(const Document& d) {
  const std::string_view format = likely_format(d.lines.text.substr(d.first));
  return tl::unexpected(Fault{ErrorCode::kUnknownFormat, d.first,
                              format.empty()
                                  ? std::string("this is not a universal file: it has no dataset between -1 lines")
                                  : "this is not a universal file, it looks like " + std::string(format),
                              "export the mesh as I-DEAS universal file (.unv)"});
}

}  // namespace

tl::expected<void, Fault> find_datasets(Document& d, LikeRecords like_records, std::vector<Warning>& warnings) {
  const auto line = first_text(d, d.first, d.lines.text.size());
  if (!line) return tl::unexpected(Fault{ErrorCode::kEmptyFile, 0, "the file is empty", "export the mesh again"});
  const std::string_view content = right_trimmed(d.lines.view(*line));
  if (trimmed(content) == "-1" && !d.is_delimiter(*line)) {
    d.delimiter = content;
    warnings.push_back(d.warning("learned-delimiter",
                                 "delimiters are not in columns 5-6; lines spelled like this one are taken as such",
                                 line->begin));
  } else if (!d.is_delimiter(*line) && !likely_format(d.lines.text.substr(d.first)).empty()) {
    return unknown_format(d);
  }
  if (auto done = StateMachine(d, like_records, warnings).run(); !done) return done;
  if (d.datasets.empty()) return unknown_format(d);
  return {};
}

}  // namespace meshgraft::unv
