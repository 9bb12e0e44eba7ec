#include "cut/grazed.hpp"

#include <algorithm>

#include "core/text.hpp"
#include "geometry/quality.hpp"
#include "intersect/pockets.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {

std::vector<Warning> leave_grazed(const Model& base, std::uint32_t tool, Tolerance tolerance, Corefined& corefined) {
  const Complex& complex = corefined.complex;
  std::array<std::vector<FaceId>, 2> sides;  // of the tool, of the base
  std::vector<double> size(complex.n_faces());
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    const bool of_base = complex.component[f] != tool;
    if (of_base) size[f] = mean_edge_length(base.corners(complex.parent[f].element));
    sides[of_base ? 1 : 0].emplace_back(f);
  }

  std::size_t n_deep = 0;
  const Pocket* deepest = nullptr;
  const std::vector<Pocket> pockets = find_pockets(complex, sides, size);
  for (const Pocket& pocket : pockets) {
    std::erase_if(corefined.junction_edges,
                  [&](const auto& edge) { return std::ranges::binary_search(pocket.walls, edge); });
    if (pocket.depth <= tolerance.at(size[pocket.faces[1].front().value])) continue;
    ++n_deep;
    if (deepest == nullptr || deepest->depth < pocket.depth) deepest = &pocket;
  }
  if (deepest == nullptr) return {};
  const FaceId face = deepest->faces[1].front();
  std::string text = "the tool only grazes the base at " + text_of(centroid(complex.corners(face))) + ", in a spot " +
                     text_of(deepest->width) + " wide and " + text_of(deepest->depth) +
                     " deep, narrower than the faces there";
  if (n_deep > 1) text += ", and in " + std::to_string(n_deep - 1) + (n_deep > 2 ? " others" : " other");
  text += n_deep > 1 ? "; they are not cut there" : "; it is not cut there";
  return {Warning{"tool-grazes", text, place_of(base, complex.parent[face.value].element)}};
}

}  // namespace meshgraft
