#include "cut/entries.hpp"

#include <algorithm>

#include "geometry/quality.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

struct Sum {
  DroppedEntry entry;
  Vec3 moment;
  ElementId last;                     // counted already
  std::vector<std::uint8_t> has_set;  // by group set of the base

  void add(const Triangle& t) { entry.area += area(t), moment += area(t) * centroid(t); }
  void count(ElementId e, GroupSetId set) {
    if (e == last) return;
    last = e;
    ++entry.faces;
    has_set[set.value] = 1;
  }
};

/// Names of the groups in the marked sets, in the order of the model.
std::vector<std::string> names_of(const Model& base, const std::vector<std::uint8_t>& has_set) {
  std::vector<std::uint8_t> named(base.groups.size());
  for (std::size_t s = 0; s < has_set.size(); ++s)
    if (has_set[s] != 0)
      for (const GroupId g : base.group_sets.members(GroupSetId(s))) named[g.value] = 1;
  std::vector<std::string> names;
  for (std::size_t g = 0; g < named.size(); ++g)
    if (named[g] != 0) names.push_back(base.groups[g].name);
  return names;
}

}  // namespace

std::vector<DroppedEntry> entries_of(const Model& base, const Complex& complex, std::span<const Vec3> position,
                                     const BasePieces& pieces, std::span<const std::uint8_t> goes) {
  std::vector<std::uint32_t> number(goes.size(), BasePieces::kNone);
  std::vector<Sum> sums;
  for (std::size_t p = 0; p < goes.size(); ++p)
    if (goes[p] != 0) {
      number[p] = static_cast<std::uint32_t>(sums.size());
      sums.emplace_back().has_set.resize(base.group_sets.size());
    }
  const auto sum_of = [&](std::uint32_t piece) {
    return piece == BasePieces::kNone || goes[piece] == 0 ? nullptr : &sums[number[piece]];
  };
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    Sum* sum = sum_of(pieces.of_face[f]);
    if (sum == nullptr) continue;
    const auto& v = complex.face[f];
    sum->add({position[v[0].value], position[v[1].value], position[v[2].value]});
    const ElementId e = complex.parent[f].element;
    sum->count(e, base.element_groups[e.value]);
  }
  for (std::size_t e = 0; e < base.n_elements(); ++e) {
    Sum* sum = sum_of(pieces.of_element[e]);
    if (sum == nullptr) continue;
    const Corners c = corners_of(base.shape(ElementId(e)), base.nodes_of(ElementId(e)));
    const auto at = [&](std::size_t k) { return base.position[c.node[k].value]; };
    for (std::size_t k = 2; k < c.n; ++k) sum->add({at(0), at(k - 1), at(k)});
    sum->count(ElementId(e), base.element_groups[e]);
  }
  std::vector<DroppedEntry> entries;
  for (Sum& sum : sums) {
    sum.entry.cause = "cut";
    if (sum.entry.area > 0) sum.entry.at = sum.moment / sum.entry.area;
    sum.entry.groups = names_of(base, sum.has_set);
    entries.push_back(std::move(sum.entry));
  }
  return entries;
}

}  // namespace meshgraft
