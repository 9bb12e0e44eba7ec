#include "io/unv_writer.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <unordered_set>

#include "io/units.hpp"
#include "io/unv_elements.hpp"
#include "io/unv_format.hpp"
#include "io/unv_types.hpp"

namespace meshgraft::unv {
namespace {

constexpr char kExponent = 'D';
constexpr std::string_view kLineEnd = "\n";
constexpr std::string_view kDelimiter = "    -1\n";
constexpr std::int64_t kSystem = 1, kNodeColour = 11;
constexpr std::size_t kRecordsPerPiece = 16384, kPiecesPerWave = 32;

std::string opening(std::int64_t number) {
  std::string digits = std::to_string(number);
  return std::string(kDelimiter) + std::string(6 - digits.size(), ' ') + digits + "\n";
}

std::string global_system() {
  std::string text = opening(2420);
  append_integer(1, text);
  text += "\nmeshgraft\n";
  append_integers(std::array<std::int64_t, 3>{kSystem, 0, 8}, kLineEnd, text);
  text += "GLOBAL\n";
  append_point({1, 0, 0}, kExponent, kLineEnd, text);
  append_point({0, 1, 0}, kExponent, kLineEnd, text);
  append_point({0, 0, 1}, kExponent, kLineEnd, text);
  append_point({0, 0, 0}, kExponent, kLineEnd, text);
  return text + std::string(kDelimiter);
}

/// Calls format(i, text) for 0 <= i < n in parallel and hands the texts to the sink in order.
template <class F>
Result<void> write_records(std::size_t n, const TextSink& sink, F&& format) {
  std::vector<std::string> texts(kPiecesPerWave);
  for (std::size_t wave = 0; wave < n; wave += kPiecesPerWave * kRecordsPerPiece) {
    tbb::parallel_for(std::size_t{0}, kPiecesPerWave, [&](std::size_t k) {
      texts[k].clear();
      const std::size_t first = wave + k * kRecordsPerPiece;
      for (std::size_t i = first; i < std::min(n, first + kRecordsPerPiece); ++i) format(i, texts[k]);
    });
    const std::vector<std::string_view> views(texts.begin(), texts.end());
    if (auto done = sink(views); !done) return done;
  }
  return {};
}

Result<void> put(const TextSink& sink, std::string_view text) { return sink({&text, 1}); }

class NewFile {
 public:
  NewFile(const Model& model, const TextSink& sink) : m_(model), sink_(sink) {}

  Result<void> write() {
    if (auto done = check_labels(); !done) return done;
    std::string head;
    if (m_.units) head += opening(164) + units_text(*m_.units) + std::string(kDelimiter);
    head += global_system();
    if (auto done = put(sink_, head + opening(2411)); !done) return done;
    if (auto done = write_nodes(); !done) return done;
    if (auto done = put(sink_, kDelimiter); !done || m_.n_elements() == 0) return done ? write_groups() : done;
    if (auto done = put(sink_, opening(2412)); !done) return done;
    if (auto done = write_elements(); !done) return done;
    if (auto done = put(sink_, kDelimiter); !done) return done;
    return write_groups();
  }

 private:
  Result<void> check_labels() const {
    for (const auto* labels : {&m_.node_label, &m_.element_label}) {
      const auto largest = std::ranges::max_element(*labels);
      if (largest != labels->end() && *largest > kLargestLabel)
        return failure(ErrorCode::kLabelOverflow,
                       "label " + std::to_string(*largest) + " does not fit into the ten columns of a universal file",
                       "renumber the model", {m_.path, 0});
    }
    return {};
  }

  Result<void> write_nodes() const {
    return write_records(m_.n_nodes(), sink_, [this](std::size_t i, std::string& text) {
      append_integers(std::array{m_.node_label[i], kSystem, kSystem, kNodeColour}, kLineEnd, text);
      append_point(m_.position[i], kExponent, kLineEnd, text);
    });
  }

  Result<void> write_elements() const {
    return write_records(m_.n_elements(), sink_, [this](std::size_t i, std::string& text) {
      const ElementId e(i);
      const auto nodes = m_.nodes_of(e);
      const auto header = header_of(m_.attributes_of(e), m_.element_label[i], nodes.size(), ElementLayout::k2412);
      append_integers(header, kLineEnd, text);
      if (has_beam_record(header[1]))
        append_integers(std::array<std::int64_t, 3>{orientation_label(e), 0, 0}, kLineEnd, text);
      std::vector<std::int64_t> labels;
      for (const NodeId v : nodes) labels.push_back(v.valid() ? m_.node_label[v.value] : 0);
      append_integers(labels, kLineEnd, text);
    });
  }

  [[nodiscard]] std::int64_t orientation_label(ElementId e) const {
    const auto at = std::ranges::lower_bound(m_.orientation_nodes, e, {}, &OrientationNode::element);
    return at != m_.orientation_nodes.end() && at->element == e ? m_.node_label[at->node.value] : 0;
  }

  Result<void> write_groups() const {
    if (m_.groups.empty()) return {};
    if (auto done = put(sink_, opening(2467)); !done) return done;
    const auto nodes = members(m_.node_groups), elements = members(m_.element_groups);
    const std::vector<std::int64_t> numbers = group_numbers();
    for (std::size_t g = 0; g < m_.groups.size(); ++g) {
      std::string text;
      append_integers(std::array<std::int64_t, 8>{numbers[g], 0, 0, 0, 0, 0, 0,
                                                  static_cast<std::int64_t>(nodes[g].size() + elements[g].size())},
                      kLineEnd, text);
      text += m_.groups[g].name + "\n";
      EntityWriter writer({8, 4}, kLineEnd, text);
      for (const std::uint32_t v : nodes[g]) writer.add({kNodeCode, m_.node_label[v], 0, 0});
      for (const std::uint32_t e : elements[g]) writer.add({kElementCode, m_.element_label[e], 0, 0});
      writer.finish();
      if (auto done = put(sink_, text); !done) return done;
    }
    return put(sink_, kDelimiter);
  }

  /// Members by group, ascending.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> members(const std::vector<GroupSetId>& sets) const {
    std::vector<std::vector<std::uint32_t>> of(m_.groups.size());
    for (std::uint32_t i = 0; i < sets.size(); ++i)
      for (const GroupId g : m_.group_sets.members(sets[i])) of[g.value].push_back(i);
    return of;
  }

  /// The numbers of the groups; those that are not positive or used before get new ones.
  [[nodiscard]] std::vector<std::int64_t> group_numbers() const {
    std::int64_t largest = 0;
    for (const Group& g : m_.groups) largest = std::max(largest, g.number);
    std::unordered_set<std::int64_t> used;
    std::vector<std::int64_t> numbers;
    for (const Group& g : m_.groups)
      numbers.push_back(g.number > 0 && used.insert(g.number).second ? g.number : ++largest);
    return numbers;
  }

  const Model& m_;
  const TextSink& sink_;
};

}  // namespace

Result<void> write_new(const Model& model, const TextSink& sink) { return NewFile(model, sink).write(); }

Result<std::string> new_text(const Model& model) {
  std::string text;
  const auto done = write_new(model, [&](std::span<const std::string_view> pieces) -> Result<void> {
    for (const std::string_view piece : pieces) text += piece;
    return {};
  });
  if (!done) return Failure(done.error());
  return text;
}

}  // namespace meshgraft::unv
