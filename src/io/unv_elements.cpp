#include "io/unv_elements.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>
#include <span>
#include <unordered_map>

#include "core/room.hpp"
#include "io/unv_element_columns.hpp"
#include "io/unv_pieces.hpp"
#include "io/unv_types.hpp"

namespace meshgraft::unv {
namespace {

/// Distinct attributes in order of first appearance.
class AttributesTable {
 public:
  explicit AttributesTable(std::vector<ElementAttributes> distinct = {}) : distinct_(std::move(distinct)) {
    for (std::size_t k = 0; k < distinct_.size(); ++k) by_hash_.emplace(hash(distinct_[k]), k);
  }
  std::uint32_t intern(const ElementAttributes& a) {
    if (last_ < distinct_.size() && distinct_[last_] == a) return last_;
    const auto [first, end] = by_hash_.equal_range(hash(a));
    for (auto it = first; it != end; ++it)
      if (distinct_[it->second] == a) return last_ = static_cast<std::uint32_t>(it->second);
    by_hash_.emplace(hash(a), distinct_.size());
    distinct_.push_back(a);
    return last_ = static_cast<std::uint32_t>(distinct_.size() - 1);
  }
  [[nodiscard]] const std::vector<ElementAttributes>& distinct() const { return distinct_; }

 private:
  static std::uint64_t hash(const ElementAttributes& a) {
    std::uint64_t h = static_cast<std::uint64_t>(a.shape);
    for (const std::int64_t v : {a.type, a.physical, a.material, a.colour, a.physical_bin, a.material_bin})
      h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15ull, h ^= h >> 29;
    return h;
  }
  std::vector<ElementAttributes> distinct_;
  std::unordered_multimap<std::uint64_t, std::size_t> by_hash_;
  std::uint32_t last_ = 0;
};

struct Findings {
  Irregular tokens, unusual_beams, orientation, negative, odd_counts;
  void add(const Findings& later) {
    tokens.add(later.tokens), unusual_beams.add(later.unusual_beams);
    orientation.add(later.orientation), negative.add(later.negative);
    odd_counts.add(later.odd_counts);
  }
};

/// The elements of one piece of a dataset.
struct Piece {
  std::size_t begin = 0, end = 0;  // what was parsed; end is the start of the next record
  std::vector<std::int64_t> label;
  std::vector<std::uint32_t> attributes, n_nodes;
  std::vector<std::uint64_t> place;
  std::vector<NodeId> nodes;
  std::vector<OrientationNode> orientation;
  AttributesTable table;
  Findings findings;
  std::optional<Fault> fault;

  /// As new, but with its memory.
  void clear() {
    label.clear(), attributes.clear(), n_nodes.clear(), place.clear(), nodes.clear(), orientation.clear();
    table = AttributesTable(), findings = Findings(), fault.reset();
  }
};

constexpr std::size_t kTriangleBytes = 90;  // of its record

/// Whether a node of an element may be 0, which stands for a middle node that is left out. Shapes
/// that are only carried along may have it anywhere.
bool may_be_left_out(Shape shape, std::size_t position) {
  switch (shape) {
    case Shape::kLine:
    case Shape::kTriangle:
    case Shape::kQuad:
      return false;
    case Shape::kLine3:
    case Shape::kTriangle6:
    case Shape::kQuad8:
      return position % 2 == 1;
    case Shape::kPoint:
    case Shape::kSolid:
    case Shape::kOther:
      break;
  }
  return true;
}

class PieceParser {
 public:
  PieceParser(const Document& d, const Dataset& dataset, const LabelIndex& nodes)
      : d_(d),
        limit_(dataset.body_end),
        layout_(element_layout_of(dataset.number)),
        columns_(d, dataset.body_end, layout_),
        nodes_(nodes) {}

  /// Parses the records that begin in [begin, border).
  void parse(std::size_t begin, std::size_t border, Piece& piece) {
    piece.clear();
    piece.begin = begin;
    reserve(border > begin ? border - begin : 0, piece);
    std::size_t at = skip_blank_lines(d_.lines, begin, limit_);
    bool of_columns = false;  // the attributes are those of the last record that columns_ read
    while (at < border && at < limit_ && !piece.fault) {
      if (const ElementRecord* usual = columns_.at(at)) {
        if (!of_columns || !columns_.repeats()) take_attributes(usual->header, piece);
        of_columns = true;
        take(at, *usual, piece);
        at = usual->end;
        continue;
      }
      piece.fault = element_record(d_.lines, at, limit_, layout_, record_);
      if (piece.fault) break;
      if (!record_.columns) piece.findings.tokens.add(at);
      if (record_.unusual_beam) piece.findings.unusual_beams.add(at);
      take_attributes(record_.header, piece);
      of_columns = false;
      take(at, record_, piece);
      at = skip_blank_lines(d_.lines, record_.end, limit_);
    }
    piece.end = at;
  }

  /// A likely start of a record at or after `border`: the first line from which a few records of
  /// known types can be read. A wrong guess costs time, not correctness.
  std::size_t likely_start(std::size_t border) {
    constexpr int kLinesTried = 16, kRecords = 3;
    std::size_t begin = border;
    for (int line = 0; line < kLinesTried && begin < limit_; ++line) {
      std::size_t at = skip_blank_lines(d_.lines, begin, limit_);
      int good = 0;
      for (; good < kRecords && at < limit_; ++good) {
        if (element_record(d_.lines, at, limit_, layout_, record_)) break;
        const ElementAttributes a = attributes_of(record_.header, layout_);
        if (!is_known_type(a.type, record_.header.back())) break;
        at = skip_blank_lines(d_.lines, record_.end, limit_);
      }
      if (good == kRecords || (good > 0 && at >= limit_)) return begin;
      begin = d_.lines.at(begin, limit_).next;
    }
    return border;
  }

 private:
  void reserve(std::size_t bytes, Piece& piece) const {
    const std::size_t n = bytes / kTriangleBytes + 1;
    piece.label.reserve(n), piece.attributes.reserve(n), piece.n_nodes.reserve(n), piece.place.reserve(n);
    piece.nodes.reserve(3 * n);
  }

  void take(std::size_t at, const ElementRecord& record, Piece& piece) {
    const std::int64_t label = record.label();
    piece.attributes.push_back(attributes_);
    if (negative_) piece.findings.negative.add(at);
    if (odd_count_) piece.findings.odd_counts.add(at);
    piece.label.push_back(label), piece.place.push_back(at);
    piece.n_nodes.push_back(static_cast<std::uint32_t>(record.nodes.size()));
    for (std::size_t k = 0; k < record.nodes.size(); ++k) {
      const std::int64_t node = record.nodes[k];
      NodeId id;
      id.value = nodes_.find(node);
      piece.nodes.push_back(id);
      if (!id.valid() && !(node == 0 && may_be_left_out(shape_, k)) && !piece.fault)
        piece.fault = Fault{ErrorCode::kUnknownNode, at,
                            "element " + std::to_string(label) + " refers to node " + std::to_string(node) +
                                ", which no node dataset defines",
                            "export the mesh together with its nodes, or remove element " + std::to_string(label)};
    }
    if (record.beam.empty() || record.beam[0] == 0) return;
    const std::uint32_t id = nodes_.find(record.beam[0]);
    if (id == LabelIndex::kNone)
      piece.findings.orientation.add(at);
    else
      piece.orientation.push_back({ElementId(piece.label.size() - 1), NodeId(std::size_t{id})});
  }

  /// The attributes of a header, for the elements to come.
  void take_attributes(const std::vector<std::int64_t>& header, Piece& piece) {
    const ElementAttributes a = attributes_of(header, layout_);
    negative_ = a.physical < 0 || a.material < 0;
    odd_count_ = is_odd_count(a.type, header.back());
    attributes_ = piece.table.intern(a);
    shape_ = a.shape;
  }

  const Document& d_;
  std::size_t limit_;
  ElementLayout layout_;
  ElementColumns columns_;
  const LabelIndex& nodes_;
  ElementRecord record_;
  std::uint32_t attributes_ = 0;  // in the table of the piece
  Shape shape_ = Shape::kOther;   // of these
  bool negative_ = false;         // a number among them
  bool odd_count_ = false;        // of nodes, for their type
};

void append(std::span<const Piece> pieces, Model& model) {
  AttributesTable table(std::move(model.attributes));
  const std::size_t n = pieces.size();
  std::vector<std::size_t> first_element(n + 1, model.element_label.size()), first_node(n + 1, model.nodes.size());
  std::vector<std::vector<std::uint32_t>> attributes(n);
  for (std::size_t k = 0; k < n; ++k) {
    first_element[k + 1] = first_element[k] + pieces[k].label.size();
    first_node[k + 1] = first_node[k] + pieces[k].nodes.size();
    for (const ElementAttributes& a : pieces[k].table.distinct()) attributes[k].push_back(table.intern(a));
    for (const OrientationNode& o : pieces[k].orientation)
      model.orientation_nodes.push_back({ElementId(first_element[k] + o.element.value), o.node});
  }
  model.attributes = table.distinct();
  const std::size_t m = first_element[n];
  tbb::parallel_invoke([&] { resize_all(m, model.element_label, model.element_place, model.element_attributes); },
                       [&] { model.first_node.resize(m + 1), model.nodes.resize(first_node[n]); });
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) {
    const Piece& piece = pieces[k];
    const std::size_t e = first_element[k];
    std::ranges::copy(piece.label, model.element_label.begin() + static_cast<std::ptrdiff_t>(e));
    std::ranges::copy(piece.place, model.element_place.begin() + static_cast<std::ptrdiff_t>(e));
    std::ranges::copy(piece.nodes, model.nodes.begin() + static_cast<std::ptrdiff_t>(first_node[k]));
    std::size_t node = first_node[k];
    for (std::size_t i = 0; i < piece.label.size(); ++i) {
      model.element_attributes[e + i].value = attributes[k][piece.attributes[i]];
      model.first_node[e + i + 1] = static_cast<std::uint32_t>(node += piece.n_nodes[i]);
    }
  });
}

/// Reads the elements of one dataset, a wave of pieces at a time, so that their memory is used again.
class WaveReader {
 public:
  WaveReader(const Document& d, const Dataset& dataset, const LabelIndex& nodes, Model& model)
      : d_(d),
        dataset_(dataset),
        nodes_(nodes),
        model_(model),
        borders_(piece_borders(d.lines, dataset.body, dataset.body_end)),
        at_(skip_blank_lines(d.lines, dataset.body, dataset.body_end)) {}

  /// Stops at the first fault in file order.
  std::optional<Fault> run(Findings& findings) {
    constexpr std::size_t kPiecesPerWave = 32;
    const std::size_t n = borders_.size() - 1;
    reserve();
    for (std::size_t first = 0; first < n; first += kPiecesPerWave) {
      pieces_.resize(std::min(kPiecesPerWave, n - first));
      if (auto fault = parse(first)) return fault;
      std::size_t n_nodes = model_.nodes.size();
      for (const Piece& piece : pieces_) findings.add(piece.findings), n_nodes += piece.nodes.size();
      if (n_nodes > std::numeric_limits<std::uint32_t>::max())
        return Fault{ErrorCode::kMalformed, dataset_.body, "more than 4294967295 node references in elements", {}};
      append(pieces_, model_);
    }
    return std::nullopt;
  }

 private:
  /// Room for triangles. What is not used costs nothing.
  void reserve() {
    const std::size_t n = model_.n_elements() + (dataset_.body_end - dataset_.body) / kTriangleBytes + 1;
    make_room(model_.element_label, n), make_room(model_.element_place, n), make_room(model_.element_attributes, n);
    make_room(model_.first_node, n + 1), make_room(model_.nodes, model_.nodes.size() + 3 * n);
  }

  /// Parses the pieces of a wave at once from guessed starts, then makes sure that each starts where the one before
  /// ended.
  std::optional<Fault> parse(std::size_t first) {
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t k) {
      PieceParser parser(d_, dataset_, nodes_);
      const std::size_t border = borders_[first + k];
      parser.parse(k == 0 ? at_ : parser.likely_start(border), borders_[first + k + 1], pieces_[k]);
    });
    PieceParser parser(d_, dataset_, nodes_);
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      Piece& piece = pieces_[k];
      if (skip_blank_lines(d_.lines, piece.begin, dataset_.body_end) != at_)
        parser.parse(at_, borders_[first + k + 1], piece);
      if (piece.fault) return piece.fault;
      at_ = skip_blank_lines(d_.lines, piece.end, dataset_.body_end);
    }
    return std::nullopt;
  }

  const Document& d_;
  const Dataset& dataset_;
  const LabelIndex& nodes_;
  Model& model_;
  std::vector<std::size_t> borders_;
  std::size_t at_;  // the next record
  std::vector<Piece> pieces_;
};

void warn(const Document& d, const Irregular& found, const char* name, const char* what,
          std::vector<Warning>& warnings) {
  if (found.count > 0) warnings.push_back(d.warning(name, std::to_string(found.count) + what, found.first));
}

}  // namespace

tl::expected<void, Fault> read_elements(const Document& d, const Dataset& dataset, const LabelIndex& nodes,
                                        Model& model, std::vector<Warning>& warnings) {
  Findings findings;
  if (auto fault = WaveReader(d, dataset, nodes, model).run(findings)) return tl::unexpected(std::move(*fault));
  warn(d, findings.tokens, "free-format", " element records are not in Fortran columns and were read by blanks",
       warnings);
  warn(d, findings.unusual_beams, "beam-record",
       " element records have a beam line where none belongs, or none where one does", warnings);
  warn(d, findings.orientation, "unknown-orientation-node", " beams name an orientation node that does not exist",
       warnings);
  warn(d, findings.negative, "negative-number",
       " elements have a negative property or material number, which some readers take for the end of the dataset",
       warnings);
  warn(d, findings.odd_counts, "node-count",
       " elements have a number of nodes that their type does not have; they are kept as they are and never joined",
       warnings);
  return {};
}

}  // namespace meshgraft::unv
