#include "merge/overlaps.hpp"

#include <algorithm>
#include <map>

#include "geometry/quality.hpp"

namespace meshgraft {

Complex both_layers(const Complex& complex, Inputs inputs, SetTranslation& translated) {
  Complex both = complex;
  for (std::size_t k = 0; k < complex.n_faces(); ++k) {
    const Complex::Layer layer = complex.layer_of(FaceId(k));
    if (!layer.parent.valid()) continue;
    both.face_groups[k] = translated.of(complex.parent[k]);
    const FaceId f = both.add_face(complex.face[k], both, FaceId(k));
    both.parent[f.value] = layer.parent;
    both.component[f.value] = layer.component;
    both.face_groups[f.value] = translated.of(layer.parent);
    both.face_attributes[f.value] = layer.attributes;
    both.layer[f.value] = {complex.parent[k], complex.component[k], both.face_groups[k], complex.face_attributes[k]};
    const Triangle beneath = inputs[layer.parent.input]->corners(layer.parent.element);
    if (dot(area_vector(both.corners(f)), area_vector(beneath)) < 0)
      std::swap(both.face[f.value][1], both.face[f.value][2]);
  }
  return both;
}

void add_losses(const Corefined& corefined, const Complex& final_complex, bool two_layers, SetTranslation& translated,
                Graft& graft, Dropped& dropped) {
  const auto lose = [&](GroupSetId groups, double area) {
    dropped.area.resize(graft.groups.size()), dropped.touched.resize(graft.groups.size());
    for (const GroupId g : graft.group_sets.members(groups))
      dropped.area[g.value] += area, dropped.touched[g.value] = 1;
  };
  for (const Corefined::Covered& covered : corefined.covered)
    if (!covered.has_heir) lose(translated.of(covered.face), covered.area);
  if (two_layers) return;
  for (std::size_t f = 0; f < final_complex.n_faces(); ++f) {
    const Complex::Layer layer = final_complex.layer_of(FaceId(f));
    if (!layer.parent.valid()) continue;
    const GroupSetId own = translated.of(final_complex.parent[f]), other = translated.of(layer.parent);
    lose(graft.group_sets.intersect(own, other), area(final_complex.corners(FaceId(f))));
  }
}

Result<void> check_something_left(Inputs inputs, const Complex& original, const Corefined& corefined) {
  std::vector<std::uint64_t> before(inputs.size()), after(inputs.size());
  for (const ElementRef parent : original.parent) ++before[parent.input];
  for (const ElementRef parent : corefined.complex.parent) ++after[parent.input];
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const Model& model = *inputs[k];
    const auto deleted = [&](const Corefined::Covered& c) { return c.face.input == k && !c.has_heir; };
    if (before[k] == 0 || after[k] > 0 || std::ranges::none_of(corefined.covered, deleted)) continue;
    std::uint64_t all = 0;
    for (std::size_t e = 0; e < model.n_elements(); ++e) all += model.is_face(ElementId(e)) ? 1 : 0;
    if (before[k] == all)
      return failure(
          ErrorCode::kOverlap,
          "all " + std::to_string(all) + " faces of " + model.path + " lie on another mesh and would be deleted",
          "use --overlap fuse or project, or keep the other side", {model.path, 0});
  }
  return {};
}

std::vector<Warning> attribute_warnings(Inputs inputs, const Complex& final_complex) {
  const auto of = [&](ElementRef e) -> const ElementAttributes& { return inputs[e.input]->attributes_of(e.element); };
  std::map<std::array<std::int64_t, 4>, std::uint64_t> differ;  // physical and material of both: faces
  for (std::size_t f = 0; f < final_complex.n_faces(); ++f) {
    const Complex::Layer layer = final_complex.layer_of(FaceId(f));
    if (!layer.parent.valid()) continue;
    const ElementAttributes &a = of(final_complex.parent[f]), &b = of(layer.parent);
    if (a.physical != b.physical || a.material != b.material)
      ++differ[{a.physical, a.material, b.physical, b.material}];
  }
  std::vector<Warning> warnings;
  for (const auto& [ids, n] : differ)
    warnings.push_back({"fused-attributes",
                        std::to_string(n) + " fused faces have physical property " + std::to_string(ids[0]) +
                            " and material " + std::to_string(ids[1]) + "; the faces that lay on them had " +
                            std::to_string(ids[2]) + " and " + std::to_string(ids[3]) +
                            "; they are in the groups of both, so that the common area can be given its thickness",
                        {}});
  return warnings;
}

}  // namespace meshgraft
