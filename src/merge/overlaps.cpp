#include "merge/overlaps.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/distinct.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {

LaidOut with_layers(const Complex& complex, Inputs inputs, SetTranslation& translated) {
  LaidOut out{complex, {}};
  Complex& all = out.complex;
  for (std::size_t k = 0; k < complex.n_faces(); ++k) {
    if (complex.layers_of(FaceId(k)).empty()) continue;
    all.face_groups[k] = translated.of(complex.parent[k]);
    const Complex::Layer lowest{complex.component[k], complex.parent[k], all.face_groups[k],
                                complex.face_attributes[k]};
    for (const Complex::Layer& layer : complex.layers_of(FaceId(k))) {
      const FaceId f = all.add_face(complex.face[k], complex, FaceId(k));
      out.beneath.emplace_back(k);
      all.parent[f.value] = layer.parent;
      all.component[f.value] = layer.component;
      all.face_groups[f.value] = translated.of(layer.parent);
      all.face_attributes[f.value] = layer.attributes;
      Complex::Layers& others = all.layers[f.value];
      *std::ranges::find(others, layer) = lowest;
      std::ranges::sort(others);
      const Triangle beneath = inputs[layer.parent.input]->corners(layer.parent.element);
      if (dot(area_vector(all.corners(f)), area_vector(beneath)) < 0)
        std::swap(all.face[f.value][1], all.face[f.value][2]);
    }
  }
  return out;
}

void add_losses(Inputs inputs, const Corefined& corefined, const Complex& final_complex, bool all_layers,
                SetTranslation& translated, Graft& graft, Dropped& dropped) {
  const auto lose = [&](GroupSetId groups, double area) {
    dropped.area.resize(graft.groups.size()), dropped.touched.resize(graft.groups.size());
    for (const GroupId g : graft.group_sets.members(groups))
      dropped.area[g.value] += area, dropped.touched[g.value] = 1;
  };
  for (const Corefined::Covered& covered : corefined.covered) {
    if (covered.has_heir) continue;
    lose(translated.of(covered.face), covered.area);
    for (const NodeId n : inputs[covered.face.input]->nodes_of(covered.face.element))
      lose(translated.of(NodeRef{covered.face.input, n}), 0);
  }
  if (all_layers) return;
  for (std::size_t f = 0; f < final_complex.n_faces(); ++f) {
    GroupSetId so_far = translated.of(final_complex.parent[f]);
    for (const Complex::Layer& layer : final_complex.layers_of(FaceId(f))) {
      const GroupSetId other = translated.of(layer.parent);
      lose(graft.group_sets.intersect(so_far, other), area(final_complex.corners(FaceId(f))));
      so_far = translated.unite(so_far, other);
    }
  }
}

std::vector<OverlapEntry> overlap_entries(Inputs inputs, const Components& components, const Corefined& corefined,
                                          const Complex& final_complex, bool all_layers) {
  struct Sum {
    std::uint64_t n = 0;
    ElementRef last;  // counted
    double area = 0;
    Vec3 moment;
    void add(double a, Vec3 at) { area += a, moment += a * at; }
  };
  using Stack = std::vector<std::uint32_t>;    // components, the one that stays first
  std::map<std::pair<bool, Stack>, Sum> sums;  // by whether they were deleted, and stack
  for (std::size_t f = 0; f < final_complex.n_faces(); ++f) {
    if (final_complex.layers_of(FaceId(f)).empty()) continue;
    const Triangle t = final_complex.corners(FaceId(f));
    Sum& sum = sums[{false, final_complex.components_of(FaceId(f))}];
    sum.add(area(t), centroid(t)), ++sum.n;
  }
  for (const Corefined::Covered& c : corefined.covered) {
    if (c.has_heir) continue;
    Sum& sum = sums[{true, {c.on, c.component}}];
    sum.add(c.area, centroid(inputs[c.face.input]->corners(c.face.element)));
    if (sum.last != c.face) sum.last = c.face, ++sum.n;
  }
  std::vector<OverlapEntry> entries;
  for (const auto& [key, sum] : sums) {
    const auto& [deleted, stack] = key;
    OverlapEntry& entry = entries.emplace_back();
    entry.rule = deleted ? "deleted" : all_layers ? "projected" : "fused";
    for (const std::uint32_t c : stack) entry.inputs.push_back(components.input[c]);
    if (components.are_parted()) entry.components = stack;
    entry.faces = sum.n, entry.area = sum.area;
    if (sum.area > 0) entry.at = sum.moment / sum.area;
  }
  return entries;
}

std::size_t gaps_in_a_row(const Corefined& corefined) {
  using Drawn = std::pair<std::array<std::uint32_t, 2>, std::size_t>;  // a component and what it was drawn onto; gaps
  std::vector<Drawn> drawn;
  for (const Corefined::Covered& face : corefined.covered)
    if (!face.has_heir) drawn.push_back({{face.component, face.on}, face.gaps});
  make_distinct(drawn);
  std::size_t all = 0;
  for (const auto& [pair, n] : drawn) all += n;
  // One that is kept has a rank above all that are drawn onto it: longest chains, one link more in each round.
  std::map<std::uint32_t, std::size_t> gaps;
  std::size_t most = 1;
  for (std::size_t round = 0; round < drawn.size(); ++round)
    for (const auto& [pair, n] : drawn) {
      gaps[pair[1]] = std::max(gaps[pair[1]], std::min(gaps[pair[0]] + n, all));
      most = std::max(most, gaps[pair[1]]);
    }
  return most;
}

Result<void> check_something_left(Inputs inputs, const Components& components, const Complex& original,
                                  const Corefined& corefined) {
  std::vector<std::uint64_t> before(components.size()), after(components.size());
  for (const std::uint32_t c : original.component) ++before[c];
  for (const std::uint32_t c : corefined.complex.component) ++after[c];
  std::vector<std::uint8_t> deleted(components.size());
  for (const Corefined::Covered& face : corefined.covered)
    if (!face.has_heir) deleted[face.component] = 1;
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    if (deleted[c] == 0 || after[c] > 0) continue;
    const std::uint32_t k = components.input[c];
    const Model& model = *inputs[k];
    std::uint64_t all = 0;
    ElementId first;
    for (std::size_t e = model.n_elements(); e-- > 0;)
      if (model.is_face(ElementId(e)) && components.of({k, ElementId(e)}) == c) ++all, first = ElementId(e);
    if (before[c] != all) continue;
    const bool is_whole = !components.are_parted();
    return failure(ErrorCode::kOverlap,
                   "all " + std::to_string(all) + " faces of " +
                       (is_whole ? model.path : "the mesh of " + text_of(inputs, {k, first})) +
                       " lie on another mesh and would be deleted",
                   "use --overlap fuse or project, or keep the other side",
                   is_whole ? Place{model.path, 0} : place_of(model, first));
  }
  return {};
}

std::vector<Warning> attribute_warnings(Inputs inputs, const Complex& final_complex) {
  const auto of = [&](ElementRef e) -> const ElementAttributes& { return inputs[e.input]->attributes_of(e.element); };
  std::map<std::array<std::int64_t, 4>, std::uint64_t> differ;  // physical and material of both: faces
  for (std::size_t f = 0; f < final_complex.n_faces(); ++f) {
    std::set<std::array<std::int64_t, 4>> of_face;
    for (const Complex::Layer& layer : final_complex.layers_of(FaceId(f))) {
      const ElementAttributes &a = of(final_complex.parent[f]), &b = of(layer.parent);
      if (a.physical != b.physical || a.material != b.material)
        of_face.insert({a.physical, a.material, b.physical, b.material});
    }
    for (const auto& ids : of_face) ++differ[ids];
  }
  std::vector<Warning> warnings;
  for (const auto& [ids, n] : differ)
    warnings.push_back({"fused-attributes",
                        std::to_string(n) + " fused faces have physical property " + std::to_string(ids[0]) +
                            " and material " + std::to_string(ids[1]) + "; the faces that lay on them had " +
                            std::to_string(ids[2]) + " and " + std::to_string(ids[3]) +
                            "; they are in the groups of all, so that the common area can be given its thickness",
                        {}});
  return warnings;
}

}  // namespace meshgraft
