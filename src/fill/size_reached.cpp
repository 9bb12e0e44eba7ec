#include "fill/size_reached.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include "core/text.hpp"
#include "core/union_find.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kNoticed = 1.5;  // of an edge length to that asked for

/// An edge between two faces of a filling, which count from the first new face.
struct InnerEdge {
  std::array<std::uint32_t, 2> faces;
  double length;
};

std::vector<InnerEdge> inner_edges(const Complex& complex, std::size_t first) {
  std::map<std::array<VertexId, 2>, std::uint32_t> one_side;
  std::vector<InnerEdge> inner;
  for (std::size_t f = first; f < complex.n_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(complex.face[f][k], complex.face[f][(k + 1) % 3]);
      const auto own = static_cast<std::uint32_t>(f - first);
      const auto [it, is_first] = one_side.try_emplace({a, b}, own);
      if (!is_first)
        inner.push_back({{it->second, own}, distance(complex.position[a.value], complex.position[b.value])});
    }
  return inner;
}

/// Of the edges inside one filling.
struct Lengths {
  double least = std::numeric_limits<double>::infinity(), most = 0;

  /// How many times the nearest of them is as long, or as short, as `size`; 1 if some are longer and some shorter.
  [[nodiscard]] double off(double size) const { return std::max({1.0, least / size, size / most}); }
  [[nodiscard]] double nearest(double size) const { return least > size ? least : most; }
};

}  // namespace

std::optional<Warning> size_not_reached(const Complex& complex, std::size_t first, double size, Place place) {
  const std::vector<InnerEdge> inner = inner_edges(complex, first);
  UnionFind filling(complex.n_faces() - first);
  for (const InnerEdge& e : inner) filling.unite(e.faces[0], e.faces[1]);
  std::map<std::uint32_t, Lengths> of_filling;
  for (const InnerEdge& e : inner) {
    Lengths& lengths = of_filling[filling.find(e.faces[0])];
    lengths.least = std::min(lengths.least, e.length), lengths.most = std::max(lengths.most, e.length);
  }
  std::erase_if(of_filling, [&](const auto& entry) { return entry.second.off(size) <= kNoticed; });
  if (of_filling.empty()) return std::nullopt;
  const auto& [face, lengths] =
      *std::ranges::max_element(of_filling, {}, [&](const auto& entry) { return entry.second.off(size); });
  const std::string others =
      of_filling.size() > 1 ? ", and so in " + std::to_string(of_filling.size() - 1) + " other fillings" : "";
  return Warning{"size-not-reached",
                 "the edges inside the filling at " + text_of(centroid(complex.corners(FaceId(first + face)))) +
                     " are " + text_of(lengths.nearest(size)) + (lengths.least > size ? " or more" : " or less") +
                     " long, while " + text_of(size) +
                     " is asked for: they change gradually from the sides of the rim, which stay" + others,
                 std::move(place)};
}

}  // namespace meshgraft
