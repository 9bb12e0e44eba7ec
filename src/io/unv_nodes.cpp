#include "io/unv_nodes.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "core/room.hpp"
#include "core/text.hpp"
#include "io/unv_pieces.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::size_t kHeaderFields = 4;
constexpr std::size_t kHeaderColumns = kHeaderFields * kIntegerWidth;
constexpr std::size_t kRealColumns = 3 * kRealWidth;

/// Whether a record can go on with these coordinates; if not, bad_real() says why.
bool are_good(Cut cut, const Reals& reals) {
  return cut != Cut::kNone && reals.count >= 2 && std::ranges::all_of(reals.value, is_coordinate);
}

Fault bad_real(const LineScanner& lines, const Line& line, const Reals& reals, std::int64_t label) {
  const std::string where = "coordinates of node " + std::to_string(label) + ": ";
  if (const auto far = std::ranges::find_if_not(reals.value, is_coordinate); far != reals.value.end())
    return {ErrorCode::kBadNumber, line.begin, where + text_of(*far) + " is too large to be calculated with",
            "correct the node, or choose another unit: no coordinate may be beyond " + text_of(kLargestCoordinate)};
  if (reals.bad.empty())
    return {ErrorCode::kMalformed, line.begin,
            where + "expected 3 reals (or 2), found '" + std::string(trimmed(lines.view(line))) + "'", kLookHere};
  const bool comma = reals.bad.find(',') != std::string_view::npos;
  return {ErrorCode::kBadNumber, line.begin,
          where + "'" + std::string(reals.bad) + "' " + std::string(number_fault(reals.bad)),
          comma ? "export the file with a decimal point" : "correct the node in the program that wrote the file"};
}

Fault truncated(std::size_t offset, std::int64_t label) {
  return {ErrorCode::kTruncated, offset, "the record of node " + std::to_string(label) + " is not complete",
          kExportAgain};
}

void take_reals(const Reals& reals, NodeRecord& record) {
  record.position = {reals.value[0], reals.value[1], reals.value[2]};
  record.two_reals = reals.count == 2;
}

/// Dataset 15: four integers and three reals of 13 columns in one line, or the reals in the next.
tl::expected<NodeRecord, Fault> one_line_record(const LineScanner& lines, const Line& line, std::size_t limit,
                                                std::vector<std::int64_t>& scratch) {
  const std::string_view content = right_trimmed(lines.view(line));
  NodeRecord record;
  Reals reals;
  const std::string_view rest = content.size() > kHeaderColumns ? content.substr(kHeaderColumns) : std::string_view{};
  std::string_view reals_text = rest;
  Cut cut = parse_integers(content.substr(0, kHeaderColumns), scratch);
  if (cut != Cut::kColumns || scratch.size() != kHeaderFields) {
    // Tokens: the first four are integers, what follows are the reals.
    scratch.clear();
    reals_text = {};
    for_each_token(content, [&](std::string_view token) {
      const auto value = scratch.size() < kHeaderFields ? parse_integer(token) : std::nullopt;
      if (value) return scratch.push_back(*value), true;
      reals_text = content.substr(static_cast<std::size_t>(token.data() - content.data()));
      return false;
    });
    cut = Cut::kTokens;
    record.columns = false;
  }
  if (scratch.size() != kHeaderFields)
    return tl::unexpected(Fault{ErrorCode::kMalformed, line.begin,
                                "expected the 4 integers of a node, found '" + std::string(trimmed(content)) + "'",
                                kLookHere});
  record.label = scratch[0];
  std::copy_n(scratch.begin() + 1, 3, record.fields.begin());
  record.end = line.next;
  Line reals_line = line;
  std::size_t width = kShortRealWidth;
  if (trimmed(reals_text).empty()) {
    if (line.next >= limit) return tl::unexpected(truncated(line.begin, record.label));
    reals_line = lines.at(line.next, limit);
    reals_text = lines.view(reals_line), width = kRealWidth, record.end = reals_line.next;
  }
  const Cut reals_cut = parse_reals(reals_text, cut == Cut::kColumns ? width : reals_text.size() + 1, reals);
  if (!are_good(reals_cut, reals)) return tl::unexpected(bad_real(lines, reals_line, reals, record.label));
  record.columns = record.columns && reals_cut == Cut::kColumns;
  take_reals(reals, record);
  return record;
}

tl::expected<NodeRecord, Fault> two_line_record(const LineScanner& lines, const Line& line, std::size_t limit,
                                                std::vector<std::int64_t>& scratch) {
  NodeRecord record;
  const Cut cut = parse_integers(lines.view(line), scratch);
  if (cut == Cut::kNone || scratch.size() != kHeaderFields)
    return tl::unexpected(
        Fault{ErrorCode::kMalformed, line.begin,
              "expected the 4 integers of a node, found '" + std::string(trimmed(lines.view(line))) + "'", kLookHere});
  record.label = scratch[0];
  std::copy_n(scratch.begin() + 1, 3, record.fields.begin());
  if (line.next >= limit) return tl::unexpected(truncated(line.begin, record.label));
  const Line second = lines.at(line.next, limit);
  Reals reals;
  const Cut reals_cut = parse_reals(lines.view(second), kRealWidth, reals);
  if (!are_good(reals_cut, reals)) return tl::unexpected(bad_real(lines, second, reals, record.label));
  record.columns = cut == Cut::kColumns && reals_cut == Cut::kColumns;
  record.end = second.next;
  take_reals(reals, record);
  return record;
}

/// The usual record, in columns and with nothing else on its lines. `like`: a record with the fields of `record`, or
/// null; becomes this one.
bool fast_record(const Document& d, std::size_t begin, std::size_t limit, NodeRecord& record, const char*& like) {
  const std::size_t feed = d.line_end.size();
  if (limit - begin < kHeaderColumns + kRealColumns + 2 * feed) return false;
  const char* header = d.lines.text.data() + begin;
  const char* reals = header + kHeaderColumns + feed;
  if (!d.ends_line(begin + kHeaderColumns) || !d.ends_line(begin + kHeaderColumns + feed + kRealColumns)) return false;
  if (!fast_integer(header, record.label)) return false;
  if (like == nullptr || !same_fields(header + kIntegerWidth, like + kIntegerWidth, record.fields.size())) {
    like = nullptr;
    for (std::size_t k = 0; k < record.fields.size(); ++k)
      if (!fast_integer(header + (k + 1) * kIntegerWidth, record.fields[k])) return false;
    like = header;
  }
  if (!fast_real(reals, record.position.x) || !fast_real(reals + kRealWidth, record.position.y) ||
      !fast_real(reals + 2 * kRealWidth, record.position.z) || !is_place(record.position))
    return false;
  record.end = begin + kHeaderColumns + kRealColumns + 2 * feed;
  return true;
}

/// What a dataset has that deserves a warning, and the systems its nodes name.
class Findings {
 public:
  explicit Findings(std::int64_t dataset_number)
      : uses_{dataset_number == kCurrentNodes ? kExport : kPlacing, kDisplacement} {}

  Irregular tokens, two_reals;
  NamedSystems systems;

  /// Systems seldom change from one node to the next.
  void add_systems(const NodeRecord& record, std::size_t at) {
    const bool is_first = systems[kDisplacement].empty();
    for (std::size_t k = 0; k < last_.size(); ++k)
      if (is_first || record.fields[k] != last_[k]) systems[uses_[k]].try_emplace(record.fields[k], at);
    last_ = {record.fields[0], record.fields[1]};
  }
  void add(const Findings& later) {
    tokens.add(later.tokens), two_reals.add(later.two_reals);
    for (std::size_t use = 0; use < kSystemUses; ++use)
      systems[use].insert(later.systems[use].begin(), later.systems[use].end());
  }

 private:
  static constexpr std::int64_t kCurrentNodes = 2411;
  std::array<SystemUse, 2> uses_;
  std::array<std::int64_t, 2> last_{};  // of fields 2 and 3
};

std::size_t count_lines(std::string_view text, char terminator) {
  return count_of(terminator, text) + (!text.empty() && text.back() != terminator ? 1 : 0);
}

/// The records of a dataset, cut for parallel parsing.
struct Pieces {
  std::vector<std::size_t> borders;     // line starts, from the first one to the end of the dataset
  std::vector<std::size_t> first_line;  // of each piece and behind the last one, counted from the first line
  [[nodiscard]] std::size_t size() const { return borders.size() - 1; }
};

/// As if all records were as long as the first one, which is mostly so; no pieces if they cannot be.
Pieces equal_pieces(const Document& d, const Dataset& dataset) {
  Pieces pieces{{dataset.body}, {0}};
  const std::size_t size = dataset.body_end - dataset.body;
  if (size == 0) return pieces;
  const Line header = d.lines.at(dataset.body, dataset.body_end);
  if (header.next == dataset.body_end) return pieces;
  const std::size_t length = d.lines.at(header.next, dataset.body_end).next - dataset.body;
  if (size % length != 0) return pieces;
  const std::size_t records = std::max<std::size_t>(1, kPieceBytes / length);
  for (std::size_t done = 0, n = size / length; done < n;) {
    done = std::min(n, done + records);
    pieces.borders.push_back(dataset.body + done * length), pieces.first_line.push_back(2 * done);
  }
  return pieces;
}

Pieces counted_pieces(const Document& d, const Dataset& dataset) {
  Pieces pieces{piece_borders(d.lines, dataset.body, dataset.body_end), {}};
  pieces.first_line.resize(pieces.borders.size());
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t k) {
    const std::size_t begin = pieces.borders[k], end = pieces.borders[k + 1];
    pieces.first_line[k + 1] = count_lines(d.lines.text.substr(begin, end - begin), d.lines.terminator);
  });
  for (std::size_t k = 0; k < pieces.size(); ++k) pieces.first_line[k + 1] += pieces.first_line[k];
  return pieces;
}

/// Parses records of exactly two lines in parallel; false, with the model as it was, if some
/// record is not like that, or the pieces are not cut between lines.
bool read_regular(const Document& d, const Dataset& dataset, const Pieces& pieces, Model& model, Findings& findings) {
  const std::size_t n = pieces.size(), n_lines = pieces.first_line.back();
  if (n_lines % 2 != 0 || pieces.borders.back() != dataset.body_end) return false;
  const std::size_t before = model.position.size();
  resize_all(before + n_lines / 2, model.position, model.node_label, model.node_place);
  // A piece that begins inside a record leaves its second line to the piece before.
  const auto start = [&](std::size_t k) {
    return pieces.first_line[k] % 2 == 0 ? pieces.borders[k] : d.lines.at(pieces.borders[k], dataset.body_end).next;
  };
  const auto first_record = [&](std::size_t k) { return before + (pieces.first_line[k] + 1) / 2; };
  std::vector<Findings> found(n, Findings(dataset.number));
  std::atomic<bool> good = true;
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) {
    std::vector<std::int64_t> scratch;
    NodeRecord fast;
    const char* like = nullptr;
    std::size_t at = start(k), i = first_record(k);
    const std::size_t last = first_record(k + 1);
    for (; i < last && at < dataset.body_end && good; ++i) {
      model.node_place[i] = at;
      if (fast_record(d, at, dataset.body_end, fast, like)) {
        found[k].add_systems(fast, at);
        model.node_label[i] = fast.label, model.position[i] = fast.position, at = fast.end;
        continue;
      }
      const auto record = node_record(d.lines, at, dataset.body_end, NodeLayout::kTwoLines, scratch);
      if (!record || record->label < 0) {
        good = false;
        return;
      }
      found[k].add_systems(*record, at);
      if (!record->columns) found[k].tokens.add(at);
      if (record->two_reals) found[k].two_reals.add(at);
      model.node_label[i] = record->label, model.position[i] = record->position, at = record->end;
    }
    if (i != last || at != start(k + 1)) good = false;
  });
  if (!good) {
    model.position.resize(before), model.node_label.resize(before), model.node_place.resize(before);
    return false;
  }
  for (const Findings& f : found) findings.add(f);
  return true;
}

tl::expected<void, Fault> read_one_by_one(const Document& d, const Dataset& dataset, Model& model, Findings& findings) {
  std::vector<std::int64_t> scratch;
  const NodeLayout layout = node_layout_of(dataset.number);
  std::size_t at = skip_blank_lines(d.lines, dataset.body, dataset.body_end);
  while (at < dataset.body_end) {
    const auto record = node_record(d.lines, at, dataset.body_end, layout, scratch);
    if (!record) return tl::unexpected(record.error());
    if (record->label < 0)
      return tl::unexpected(
          Fault{ErrorCode::kMalformed, at, "node label " + std::to_string(record->label) + " is negative", kLookHere});
    findings.add_systems(*record, at);
    if (!record->columns) findings.tokens.add(at);
    if (record->two_reals) findings.two_reals.add(at);
    model.node_place.push_back(at);
    model.node_label.push_back(record->label), model.position.push_back(record->position);
    at = skip_blank_lines(d.lines, record->end, dataset.body_end);
  }
  return {};
}

}  // namespace

tl::expected<NodeRecord, Fault> node_record(const LineScanner& lines, std::size_t begin, std::size_t limit,
                                            NodeLayout layout, std::vector<std::int64_t>& scratch) {
  const Line line = lines.at(begin, limit);
  return layout == NodeLayout::kOneLine ? one_line_record(lines, line, limit, scratch)
                                        : two_line_record(lines, line, limit, scratch);
}

tl::expected<void, Fault> read_nodes(const Document& d, const Dataset& dataset, Model& model, NamedSystems& systems,
                                     std::vector<Warning>& warnings) {
  Findings findings(dataset.number);
  const bool regular = node_layout_of(dataset.number) == NodeLayout::kTwoLines &&
                       (read_regular(d, dataset, equal_pieces(d, dataset), model, findings) ||
                        read_regular(d, dataset, counted_pieces(d, dataset), model, findings));
  if (!regular) {
    findings = Findings(dataset.number);
    if (auto done = read_one_by_one(d, dataset, model, findings); !done) return done;
  }
  for (std::size_t use = 0; use < kSystemUses; ++use)
    systems[use].insert(findings.systems[use].begin(), findings.systems[use].end());
  if (findings.tokens.count > 0)
    warnings.push_back(d.warning(
        "free-format",
        std::to_string(findings.tokens.count) + " node records are not in Fortran columns and were read by blanks",
        findings.tokens.first));
  if (findings.two_reals.count > 0)
    warnings.push_back(d.warning("two-coordinates",
                                 std::to_string(findings.two_reals.count) + " nodes have two coordinates; z is 0",
                                 findings.two_reals.first));
  return {};
}

}  // namespace meshgraft::unv
