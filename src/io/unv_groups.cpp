#include "io/unv_groups.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "io/unv_numbers.hpp"
#include "io/unv_pieces.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::int64_t kLargestCode = 99;

enum class Member : std::uint8_t { kNode, kElement, kOther, kDanglingNode, kDanglingElement };

/// Members of groups as positions; two arrays side by side.
struct Members {
  std::vector<Member> kind;
  std::vector<std::uint32_t> position;
  void resize(std::size_t n) { kind.resize(n), position.resize(n); }
};

class Resolver {
 public:
  Resolver(const LabelIndex& nodes, const LabelIndex& elements) : nodes_(nodes), elements_(elements) {}
  Member operator()(std::int64_t code, std::int64_t tag, std::uint32_t& position) const {
    if (code == kNodeCode) {
      position = nodes_.find(tag);
      return position == LabelIndex::kNone ? Member::kDanglingNode : Member::kNode;
    }
    if (code == kElementCode) {
      position = elements_.find(tag);
      return position == LabelIndex::kNone ? Member::kDanglingElement : Member::kElement;
    }
    return Member::kOther;
  }

 private:
  const LabelIndex& nodes_;
  const LabelIndex& elements_;
};

/// Puts members into group sets, group by group; for each group every distinct old set is looked up
/// once.
class Membership {
 public:
  explicit Membership(Model& model) : model_(model) {}

  void begin(GroupId group) {
    for (const std::uint32_t set : used_) with_[set] = GroupSetId::kNone;
    used_.clear();
    group_ = group;
  }
  void add(Member kind, std::uint32_t position) {
    Group& group = model_.groups[group_.value];
    switch (kind) {
      case Member::kNode:
        ++group.n_nodes, join(model_.node_groups[position]);
        break;
      case Member::kElement:
        ++group.n_elements, join(model_.element_groups[position]);
        break;
      case Member::kOther:
        ++group.n_other;
        break;
      case Member::kDanglingNode:
      case Member::kDanglingElement:
        ++group.n_dangling;
        break;
    }
  }

 private:
  void join(GroupSetId& set) {
    if (set.value >= with_.size()) with_.resize(model_.group_sets.size(), GroupSetId::kNone);
    std::uint32_t& with = with_[set.value];
    if (with == GroupSetId::kNone) {
      used_.push_back(set.value);
      with = model_.group_sets.with(set, group_).value;
    }
    set.value = with;
  }

  Model& model_;
  GroupId group_;
  std::vector<std::uint32_t> with_;  // by old set
  std::vector<std::uint32_t> used_;  // entries of with_ that are set
};

GroupId add_group(Document& d, Model& model, std::int64_t number, const Line& name, const GroupPlace& place) {
  Group group;
  std::string_view text = d.lines.view(name);
  while (text.ends_with(' ')) text.remove_suffix(1);
  group.name = text, group.number = number, group.place = place.begin;
  model.groups.push_back(std::move(group));
  d.groups.push_back(place);
  return GroupId(model.groups.size() - 1);
}

/// Groups whose lines are all full and in columns, read in parallel.
class RegularReader {
 public:
  RegularReader(Document& d, std::uint32_t dataset, const Resolver& resolve)
      : d_(d), dataset_(d.datasets[dataset]), layout_(group_layout_of(dataset_.number)), resolve_(resolve) {
    place_.dataset = dataset, place_.layout = layout_, place_.regular = true;
  }

  /// False, with nothing changed, if a group is not regular or has entries that make the layout
  /// doubtful.
  bool read(Model& model) {
    if (!find_groups()) return false;
    if (!check()) return false;
    Membership membership(model);
    std::size_t piece = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      place_.begin = groups_[g].begin, place_.end = groups_[g].end;
      const GroupId id = add_group(d_, model, groups_[g].number, groups_[g].name_line, place_);
      membership.begin(id);
      for (; piece < pieces_.size() && pieces_[piece].group == g; ++piece) {
        if (piece >= parsed_) parse_wave(piece);
        const Members& members = wave_[piece - wave_begin_];
        for (std::size_t k = 0; k < members.kind.size(); ++k) membership.add(members.kind[k], members.position[k]);
      }
    }
    return true;
  }

 private:
  struct Lines {  // of entities of one group
    std::size_t group, begin;
    std::uint64_t count;
  };
  static constexpr std::size_t kLinesPerPiece = 8192;
  static constexpr std::size_t kPiecesPerWave = 64;  // about a million entities in memory at a time

  bool find_groups() {
    std::size_t at = skip_blank_lines(d_.lines, dataset_.body, dataset_.body_end);
    const std::size_t per_line = entities_per_line(layout_), step = 8 * kIntegerWidth + d_.line_end.size();
    while (at < dataset_.body_end) {
      RegularGroup group;
      if (!regular_group(d_, at, dataset_.body_end, layout_, group)) return false;
      for (std::uint64_t done = 0; done < group.count; done += kLinesPerPiece * per_line)
        pieces_.push_back({groups_.size(), group.entities + done / per_line * step,
                           std::min<std::uint64_t>(kLinesPerPiece * per_line, group.count - done)});
      groups_.push_back(group);
      at = skip_blank_lines(d_.lines, group.end, dataset_.body_end);
    }
    return true;
  }

  /// Calls f(code, tag) for each entity of a piece; false if one is not plainly in this layout.
  template <class F>
  bool entities(const Lines& piece, F&& f) const {
    const std::size_t per_line = entities_per_line(layout_), width = layout_.entity_size * kIntegerWidth;
    const char* at = d_.lines.text.data() + piece.begin;
    const char* last = nullptr;  // an entity with this code
    std::int64_t code = 0, tag = 0;
    for (std::uint64_t done = 0; done < piece.count;) {
      for (std::size_t k = 0; k < per_line && done < piece.count; ++k, ++done, at += width) {
        if (last == nullptr || !same_fields(at, last)) {
          if (!fast_integer(at, code) || code < 1 || code > kLargestCode) return false;
          last = at;
        }
        if (!fast_integer(at + kIntegerWidth, tag) || !(layout_.entity_size == 2 || has_usual_leaf(code, at)))
          return false;
        f(code, tag);
      }
      if (!d_.ends_line(static_cast<std::size_t>(at - d_.lines.text.data()))) return false;
      at += d_.line_end.size();
    }
    return true;
  }

  /// Whether leaf and component of an entity of four integers are 0, as those of nodes and elements must be.
  static bool has_usual_leaf(std::int64_t code, const char* entity) {
    constexpr const char* kZeros = "         0         0";
    return (code != kNodeCode && code != kElementCode) || same_fields(entity + 2 * kIntegerWidth, kZeros, 2);
  }

  /// Whether all entities can be read like this. A separate pass, so that nothing has to be undone
  /// and no entity has to be stored.
  bool check() const {
    std::atomic<bool> good = true;
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t k) {
      if (good && !entities(pieces_[k], [](std::int64_t, std::int64_t) {})) good = false;
    });
    return good;
  }

  void parse_wave(std::size_t first) {
    wave_begin_ = first, parsed_ = std::min(first + kPiecesPerWave, pieces_.size());
    wave_.resize(kPiecesPerWave);
    tbb::parallel_for(first, parsed_, [&](std::size_t k) {
      Members& members = wave_[k - first];
      members.resize(pieces_[k].count);
      std::size_t i = 0;
      (void)entities(pieces_[k], [&](std::int64_t code, std::int64_t tag) {
        members.kind[i] = resolve_(code, tag, members.position[i]);
        ++i;
      });
    });
  }

  Document& d_;
  const Dataset& dataset_;
  GroupLayout layout_;
  const Resolver& resolve_;
  GroupPlace place_;
  std::vector<RegularGroup> groups_;
  std::vector<Lines> pieces_;
  std::vector<Members> wave_;
  std::size_t wave_begin_ = 0, parsed_ = 0;
};

/// How many things are wrong with a dataset when it is read in `layout`; stops at `enough`. A
/// layout that is not its own is out of the question if a number of entities does not fit.
std::size_t oddities(const Document& d, const Dataset& dataset, GroupLayout layout, const Resolver& resolve,
                     std::size_t enough) {
  const bool own = layout == group_layout_of(dataset.number);
  constexpr std::size_t kBroken = std::numeric_limits<std::size_t>::max();
  std::size_t found = 0;
  GroupRecord record;
  std::size_t at = skip_blank_lines(d.lines, dataset.body, dataset.body_end);
  while (at < dataset.body_end && found < enough) {
    if (!group_record(d.lines, at, dataset.body_end, layout, record)) return kBroken;
    if (!record.count_is_right() && !own) return kBroken;
    found += (record.count_is_right() ? 0 : 1) + (record.header.size() == layout.header_fields ? 0 : 1);
    // In another layout, entities of a group that declares too few would pass for empty groups.
    found += looks_like_entities(d.lines, record.name_line, group_layout_of(dataset.number)) ? 1 : 0;
    for (const Entity& e : record.entities) {
      std::uint32_t position = 0;
      const Member kind = resolve(e.code, e.tag, position);
      const bool known_code = e.code >= 1 && e.code <= kLargestCode;
      const bool leaf = kind != Member::kOther && (e.leaf != 0 || e.component != 0);
      const bool dangling = kind == Member::kDanglingNode || kind == Member::kDanglingElement;
      found += (known_code ? 0 : 1) + (leaf ? 1 : 0) + (dangling ? 1 : 0);
    }
    at = skip_blank_lines(d.lines, record.end, dataset.body_end);
  }
  return found;
}

/// The layout in which a dataset makes most sense; its own one if that is no worse than others.
GroupLayout best_layout(const Document& d, const Dataset& dataset, const Resolver& resolve) {
  GroupLayout best = group_layout_of(dataset.number);
  std::size_t fewest = oddities(d, dataset, best, resolve, std::numeric_limits<std::size_t>::max());
  for (const GroupLayout other : {GroupLayout{8, 4}, GroupLayout{8, 2}, GroupLayout{7, 2}, GroupLayout{6, 2}}) {
    if (fewest == 0) break;
    const std::size_t found = oddities(d, dataset, other, resolve, fewest);
    if (found < fewest) best = other, fewest = found;
  }
  return best;
}

tl::expected<void, Fault> read_one_by_one(Document& d, std::uint32_t dataset_position, const Resolver& resolve,
                                          Model& model, std::vector<Warning>& warnings) {
  const Dataset& dataset = d.datasets[dataset_position];
  GroupPlace place;
  place.dataset = dataset_position, place.layout = best_layout(d, dataset, resolve);
  if (place.layout != group_layout_of(dataset.number))
    warnings.push_back(d.warning("group-layout",
                                 "the groups of dataset " + std::to_string(dataset.number) + " were read with " +
                                     std::to_string(place.layout.header_fields) + " header fields and " +
                                     std::to_string(place.layout.entity_size) +
                                     " integers per entity, which is not its own layout but the one that fits",
                                 dataset.number_line));
  Membership membership(model);
  GroupRecord record;
  Irregular tokens;
  std::size_t at = skip_blank_lines(d.lines, dataset.body, dataset.body_end);
  while (at < dataset.body_end) {
    if (auto done = group_record(d.lines, at, dataset.body_end, place.layout, record); !done) return done;
    const auto declared = record.header.back();
    const auto found = static_cast<std::int64_t>(record.entities.size());
    if (found < declared && !dataset.closed && record.end >= d.lines.text.size())
      return tl::unexpected(Fault{ErrorCode::kTruncated, at,
                                  "the file ends after " + std::to_string(found) + " of " + std::to_string(declared) +
                                      " entities of group " + std::to_string(record.header[0]),
                                  kExportAgain});
    if (found != declared)
      warnings.push_back(d.warning("group-count",
                                   "group " + std::to_string(record.header[0]) + " declares " +
                                       std::to_string(declared) + " entities and has " + std::to_string(found),
                                   at));
    if (!record.columns) tokens.add(at);
    place.begin = at, place.end = record.end;
    membership.begin(add_group(d, model, record.header[0], record.name_line, place));
    for (const Entity& e : record.entities) {
      std::uint32_t position = 0;
      const Member kind = resolve(e.code, e.tag, position);
      membership.add(kind, position);
    }
    at = skip_blank_lines(d.lines, record.end, dataset.body_end);
  }
  if (tokens.count > 0)
    warnings.push_back(d.warning(
        "free-format", std::to_string(tokens.count) + " groups are not in Fortran columns and were read by blanks",
        tokens.first));
  return {};
}

}  // namespace

tl::expected<void, Fault> read_groups(Document& d, std::uint32_t dataset, const LabelIndex& nodes,
                                      const LabelIndex& elements, Model& model, std::vector<Warning>& warnings) {
  const Resolver resolve(nodes, elements);
  const std::size_t first = model.groups.size();
  if (!RegularReader(d, dataset, resolve).read(model)) {
    if (auto done = read_one_by_one(d, dataset, resolve, model, warnings); !done) return done;
  }
  for (std::size_t g = first; g < model.groups.size(); ++g)
    if (const Group& group = model.groups[g]; group.n_dangling > 0)
      warnings.push_back(d.warning("dangling-members",
                                   "group " + group.name + " has " + std::to_string(group.n_dangling) +
                                       " entries that name nodes or elements which do not exist; they are kept",
                                   group.place));
  return {};
}

}  // namespace meshgraft::unv
