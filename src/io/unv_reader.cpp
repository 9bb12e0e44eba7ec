#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>

#include "core/room.hpp"
#include "core/text.hpp"
#include "io/coordinate_systems.hpp"
#include "io/label_index.hpp"
#include "io/units.hpp"
#include "io/unv_datasets.hpp"
#include "io/unv_document.hpp"
#include "io/unv_elements.hpp"
#include "io/unv_groups.hpp"
#include "io/unv_nodes.hpp"
#include "io/unv_pieces.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft {
namespace unv {
namespace {

constexpr std::int64_t kModelHeader = 2400, kUnits = 164;

class Reader {
 public:
  Reader(Document& document, bool unclosed) : d_(document), unclosed_(unclosed) {}

  tl::expected<Model, Fault> read(LikeRecords like_records) {
    model_.path = d_.path();
    model_.first_node.push_back(0);
    if (auto done = find_datasets(d_, like_records, model_.warnings); !done) return tl::unexpected(done.error());
    read_headers();
    for (const Dataset& dataset : d_.datasets)
      if (dataset.kind() == DatasetKind::kNodes)
        if (auto done = checked(dataset, read_nodes(d_, dataset, model_, named_systems_, model_.warnings)); !done)
          return tl::unexpected(done.error());
    if (auto fault = index_nodes()) return tl::unexpected(std::move(*fault));
    if (auto fault = too_small()) return tl::unexpected(std::move(*fault));
    for (const Dataset& dataset : d_.datasets)
      if (dataset.kind() == DatasetKind::kElements)
        if (auto done = checked(dataset, read_elements(d_, dataset, nodes_, model_, model_.warnings)); !done)
          return tl::unexpected(done.error());
    if (auto fault = index_elements()) return tl::unexpected(std::move(*fault));
    make_room(model_.node_groups, model_.n_nodes()), make_room(model_.element_groups, model_.n_elements());
    tbb::parallel_invoke([&] { model_.node_groups.assign(model_.n_nodes(), GroupSets::kEmpty); },
                         [&] { model_.element_groups.assign(model_.n_elements(), GroupSets::kEmpty); });
    for (std::uint32_t k = 0; k < d_.datasets.size(); ++k)
      if (d_.datasets[k].kind() == DatasetKind::kGroups)
        if (auto done = checked(d_.datasets[k], read_groups(d_, k, nodes_, elements_, model_, model_.warnings)); !done)
          return tl::unexpected(done.error());
    if (!unclosed_ && !d_.datasets.back().closed) return tl::unexpected(without_end());
    warn_about_labels(nodes_, model_.node_place, "node");
    warn_about_labels(elements_, model_.element_place, "element");
    collect_systems();
    warn_about_systems();
    return std::move(model_);
  }

 private:
  [[nodiscard]] std::optional<Fault> too_small() const {
    Box box;
    for (const Vec3& p : model_.position) box.add(p);
    if (box.empty()) return std::nullopt;
    const Vec3 extent = box.high - box.low;
    const double most = std::max({extent.x, extent.y, extent.z});
    if (most == 0 || most >= kLeastExtent) return std::nullopt;
    return Fault{ErrorCode::kBadNumber, model_.node_place.front(),
                 "all nodes are within " + text_of(most) + " of each other, which is too small to be calculated with",
                 "choose another unit of length: a mesh must be " + text_of(kLeastExtent) + " across at least"};
  }

  /// Some programs leave out the last delimiter, but a file that was cut between two records looks the same.
  [[nodiscard]] Fault without_end() const {
    return {ErrorCode::kTruncated, d_.lines.text.size() - 1,
            "the file ends inside dataset " + std::to_string(d_.datasets.back().number) +
                ", which has no closing delimiter; whether more followed cannot be known",
            std::string(kExportAgain) + "; if it is known to be whole, add a line '    -1' at its end"};
  }

  /// A fault in the last line of a file without its last delimiter means that the file was cut; and
  /// a last line without line end must at least be as long as such lines are.
  tl::expected<void, Fault> checked(const Dataset& dataset, tl::expected<void, Fault> done) const {
    const std::size_t end = d_.lines.text.size();
    if (!done) {
      Fault fault = done.error();
      const bool last_line = fault.offset < end && d_.lines.at(fault.offset).next >= end;
      if (!dataset.closed && dataset.body_end == end && last_line) {
        fault.code = ErrorCode::kTruncated;
        fault.what = "the file ends inside a record: " + fault.what;
        fault.hint = kExportAgain;
      }
      if (dataset.closed && fault.code == ErrorCode::kTruncated) fault.code = ErrorCode::kMalformed;
      return tl::unexpected(std::move(fault));
    }
    if (dataset.closed || dataset.body_end != end || dataset.body == end || d_.lines.text.back() == d_.lines.terminator)
      return {};
    return last_line_complete(dataset)
               ? done
               : tl::unexpected(Fault{ErrorCode::kTruncated, end - 1,
                                      "the file ends inside a line of dataset " + std::to_string(dataset.number),
                                      kExportAgain});
  }

  [[nodiscard]] bool last_line_complete(const Dataset& dataset) const {
    const std::string_view text = d_.lines.text;
    const std::size_t before = text.rfind(d_.lines.terminator);
    if (before == std::string_view::npos) return false;
    const std::size_t length = text.size() - before - 1;
    if (dataset.kind() != DatasetKind::kNodes) return length % kIntegerWidth == 0;
    if (dataset.number == 15) return length >= 4 * kIntegerWidth + 3 * kShortRealWidth;
    return length >= 3 * kRealWidth;
  }

  void read_headers() {
    for (const Dataset& dataset : d_.datasets) {
      if (dataset.binary || dataset.number != kUnits || model_.units) continue;
      if (const auto units = read_units(d_.lines, dataset))
        model_.units = *units;
      else
        model_.warnings.push_back(
            d_.warning("units", units.error().what + "; units are taken as unknown", units.error().offset));
    }
  }

  [[nodiscard]] std::string list_of_models() const {
    std::string list;
    for (const Dataset& dataset : d_.datasets) {
      if (dataset.number != kModelHeader || dataset.body >= dataset.body_end) continue;
      const Line header = d_.lines.at(dataset.body, dataset.body_end);
      std::string name;
      if (header.next < dataset.body_end) name = trimmed(d_.lines.view(d_.lines.at(header.next, dataset.body_end)));
      list += (list.empty() ? "" : ", ") + ("'" + name + "'") + " (line " +
              std::to_string(d_.line_of(dataset.number_line)) + ")";
    }
    return list;
  }

  Fault duplicate(const char* kind, std::int64_t label, std::size_t first, std::size_t later,
                  std::size_t how_many) const {
    const std::string both = std::string(kind) + " " + std::to_string(label) + " is defined twice, first in line " +
                             std::to_string(d_.line_of(first));
    const auto models =
        std::ranges::count_if(d_.datasets, [](const Dataset& x) { return !x.binary && x.number == kModelHeader; });
    if (models > 1 || (how_many > 1 && d_.dataset_at(first) != d_.dataset_at(later)))
      return {ErrorCode::kSeveralModels, later,
              "the file holds several FE models" + (models > 1 ? ": " + list_of_models() : std::string()) + "; " + both,
              "export each model to a file of its own"};
    return {ErrorCode::kDuplicateLabel, later, both + ", as another " + kind,
            "renumber one of them in the program that wrote the file"};
  }

  std::optional<Fault> index_nodes() {
    nodes_ = LabelIndex(model_.node_label);
    if (nodes_.duplicates().empty()) return std::nullopt;
    const auto doubles = nodes_.duplicates();
    for (const auto [first, later] : doubles)
      if (model_.position[first] != model_.position[later])
        return duplicate("node", model_.node_label[later], model_.node_place[first], model_.node_place[later],
                         doubles.size());
    std::vector<std::uint32_t> kept = remember("node", doubles, model_.node_place, d_.double_nodes);
    keep(kept, model_.position), keep(kept, model_.node_label), keep(kept, model_.node_place);
    nodes_ = LabelIndex(model_.node_label);
    return std::nullopt;
  }

  std::optional<Fault> index_elements() {
    elements_ = LabelIndex(model_.element_label);
    if (elements_.duplicates().empty()) return std::nullopt;
    const auto doubles = elements_.duplicates();
    for (const auto [first, later] : doubles) {
      const ElementId a(std::size_t{first}), b(std::size_t{later});
      if (model_.element_attributes[first] != model_.element_attributes[later] ||
          !std::ranges::equal(model_.nodes_of(a), model_.nodes_of(b)))
        return duplicate("element", model_.element_label[later], model_.element_place[first],
                         model_.element_place[later], doubles.size());
    }
    const std::vector<std::uint32_t> kept = remember("element", doubles, model_.element_place, d_.double_elements);
    drop_elements(kept);
    elements_ = LabelIndex(model_.element_label);
    return std::nullopt;
  }

  /// Warns, notes where the further records are, and returns the positions that stay.
  std::vector<std::uint32_t> remember(const char* kind, const std::vector<LabelIndex::Duplicate>& doubles,
                                      const std::vector<std::uint64_t>& places, std::vector<DuplicateRecord>& records) {
    model_.warnings.push_back(d_.warning("repeated-record",
                                         std::to_string(doubles.size()) + " " + kind +
                                             " records repeat a label and everything else; the first one counts",
                                         places[doubles.front().later]));
    std::vector<std::uint32_t> kept;
    std::vector<std::uint32_t> new_position(places.size());
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      if (next < doubles.size() && doubles[next].later == i) {
        records.push_back({places[i], new_position[doubles[next].first]});
        ++next;
        continue;
      }
      new_position[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(i);
    }
    return kept;
  }

  template <class T>
  static void keep(const std::vector<std::uint32_t>& kept, std::vector<T>& values) {
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
  }

  void drop_elements(const std::vector<std::uint32_t>& kept) {
    std::vector<OrientationNode> orientation;
    std::vector<std::uint32_t> first_node{0};
    std::vector<NodeId> nodes;
    auto o = model_.orientation_nodes.begin();
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const ElementId old(std::size_t{kept[i]});
      std::ranges::copy(model_.nodes_of(old), std::back_inserter(nodes));
      first_node.push_back(static_cast<std::uint32_t>(nodes.size()));
      for (; o != model_.orientation_nodes.end() && o->element <= old; ++o)
        if (o->element == old) orientation.push_back({ElementId(i), o->node});
    }
    model_.first_node = std::move(first_node), model_.nodes = std::move(nodes);
    model_.orientation_nodes = std::move(orientation);
    keep(kept, model_.element_label), keep(kept, model_.element_place), keep(kept, model_.element_attributes);
  }

  void warn_about_labels(const LabelIndex& labels, const std::vector<std::uint64_t>& places, const char* kind) {
    constexpr std::int64_t kLargestElsewhere = std::numeric_limits<std::int32_t>::max();
    const std::int64_t largest = labels.largest();
    if (largest <= kLargestElsewhere) return;
    model_.warnings.push_back(d_.warning(
        "large-label", std::string(kind) + " label " + std::to_string(largest) + " does not fit into most programs",
        places[labels.find(largest)]));
  }

  /// The systems that are defined, the first definition of a label, and those that nodes name.
  void collect_systems() {
    std::map<std::int64_t, CoordinateSystem> systems;
    for (const Dataset& dataset : d_.datasets) {
      if (!holds_systems(dataset)) continue;
      const auto defined = coordinate_systems(d_.lines, dataset);
      if (!defined)
        model_.warnings.push_back(d_.warning("coordinate-system",
                                             "dataset " + std::to_string(dataset.number) +
                                                 " cannot be understood; its systems are taken as the global one",
                                             dataset.number_line));
      else
        for (const CoordinateSystem& system : *defined) systems.try_emplace(system.label, system);
    }
    for (std::size_t use = 0; use < kSystemUses; ++use)
      for (const auto& [label, at] : named_systems_[use]) {
        CoordinateSystem& system = systems[label];
        system.label = label;
        const NodeId node = node_at(at);
        if (!system.first_node.valid() || node < system.first_node) system.first_node = node;
        if (use == kPlacing) system.first_placed = node;
      }
    for (const auto& [label, system] : systems) model_.coordinate_systems.push_back(system);
  }

  /// The node whose record begins there.
  [[nodiscard]] NodeId node_at(std::size_t offset) const {
    const auto after = std::ranges::upper_bound(model_.node_place, offset);
    return NodeId(static_cast<std::size_t>(after - model_.node_place.begin()) - 1);
  }

  void warn_about_systems() {
    constexpr std::array kSays{"has its coordinates in system ", "shall be shown in coordinate system "};
    constexpr std::array kThen{"; they are used as they are", "; its coordinates are used as global ones"};
    for (const SystemUse use : {kPlacing, kExport})
      for (const auto& [label, at] : named_systems_[use]) {
        if (model_.coordinate_system(label).is_global()) continue;
        const std::uint32_t node = node_at(at).value;
        model_.warnings.push_back(d_.warning("coordinate-system",
                                             "node " + std::to_string(model_.node_label[node]) + " " + kSays[use] +
                                                 std::to_string(label) + ", which is not the global one" + kThen[use],
                                             model_.node_place[node]));
      }
  }

  Document& d_;
  bool unclosed_;
  Model model_;
  LabelIndex nodes_, elements_;
  NamedSystems named_systems_;
};

Result<Model> read_document(std::shared_ptr<Document> document, const ReadOptions& options) {
  tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : static_cast<int>(options.threads));
  auto model = arena.execute([&] {
    auto read = Reader(*document, options.unclosed).read(LikeRecords::kPassedOver);
    if (read || !document->passed_over) return read;
    document->forget_datasets();
    return Reader(*document, options.unclosed).read(LikeRecords::kLookedAt);
  });
  if (!model) return Failure(document->error(model.error()));
  std::ranges::stable_sort(model->warnings, {}, [](const Warning& w) { return w.place.line; });
  model->source = std::move(document);
  return std::move(*model);
}

}  // namespace
}  // namespace unv

Result<Model> read_unv(const std::string& path, const ReadOptions& options) {
  auto file = MappedFile::open(path);
  if (!file) return Failure(file.error());
  return unv::read_document(std::make_shared<unv::Document>(std::move(*file), path), options);
}

Result<Model> read_unv_text(std::string text, const std::string& name, const ReadOptions& options) {
  return unv::read_document(std::make_shared<unv::Document>(std::move(text), name), options);
}

}  // namespace meshgraft
