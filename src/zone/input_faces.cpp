#include "zone/input_faces.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/distinct.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr int kReleased = 3;       // neighbourhoods, the cut face itself counted: as many as are remeshed elsewhere
constexpr double kSpoiled = 0.99;  // of its Q that a face has kept, at most; rounding takes less

}  // namespace

InputFaces::InputFaces(const Corefined& corefined)
    : complex_(corefined.complex),
      parents_(complex_),
      faces_at_(complex_),
      touched_(parents_.size(), 0),
      frozen_(parents_.size(), 0),
      kept_(parents_.size(), 0),
      has_lost_(parents_.size(), 0),
      spoiled_(parents_.size(), 0) {
  for (std::uint32_t i = 0; i < size(); ++i)
    has_lost_[i] = std::ranges::binary_search(corefined.covered, complex_.parent[pieces(i).front().value], {},
                                              &Corefined::Covered::face);
  mean_edge_length_.reserve(size());
  for (std::uint32_t i = 0; i < size(); ++i)
    mean_edge_length_.push_back(pieces(i).size() == 1 ? meshgraft::mean_edge_length(complex_.corners(pieces(i).front()))
                                                      : contour_length(i) / 3);
  for (std::size_t f = 0; f < complex_.n_faces(); ++f) {
    const std::uint32_t i = parents_.of_face[f];
    if (corefined.touched[f]) touched_[i] = 1;
    if (!corefined.kept.empty() && corefined.kept[f]) kept_[i] = 1;
    for (const VertexId v : complex_.face[f])
      if (complex_.state[v.value] == VertexState::kFrozen) frozen_[i] = 1;
  }
  freeze_doubled();
  // A face that had to be cut cannot be mended alone.
  std::vector<std::uint32_t> cut;
  for (std::uint32_t i = 0; i < size(); ++i)
    if (kept_[i] && !is_whole(i)) cut.push_back(i);
  release_around(std::move(cut));
}

void InputFaces::find_spoiled(const Complex& original, double min_quality) {
  std::vector<std::pair<ElementRef, std::uint32_t>> poor;
  const auto q_of = [&](std::uint32_t i) { return aspect_ratio(complex_.corners(pieces(i).front())); };
  for (std::uint32_t i = 0; i < size(); ++i)
    if (is_whole(i) && q_of(i) < min_quality) poor.emplace_back(complex_.parent[pieces(i).front().value], i);
  if (poor.empty()) return;
  std::ranges::sort(poor);
  for (std::size_t f = 0; f < original.n_faces(); ++f) {
    const auto it = std::ranges::lower_bound(poor, original.parent[f], {}, &decltype(poor)::value_type::first);
    if (it == poor.end() || it->first != original.parent[f]) continue;
    if (q_of(it->second) < kSpoiled * aspect_ratio(original.corners(FaceId(f)))) spoiled_[it->second] = 1;
  }
}

std::vector<std::uint32_t> InputFaces::release(std::span<const NodeRef> nodes) {
  std::vector<std::uint32_t> at_nodes;
  for (std::uint32_t i = 0; i < size(); ++i)
    if (kept(i) && std::ranges::any_of(complex_.face[pieces(i).front().value], [&](VertexId v) {
          return std::ranges::binary_search(nodes, complex_.node[v.value]);
        }))
      at_nodes.push_back(i);
  return release_around(std::move(at_nodes));
}

std::vector<std::uint32_t> InputFaces::release_around(std::vector<std::uint32_t> front) {
  std::vector<std::uint32_t> released, next;
  for (int k = 0; k < kReleased && !front.empty(); ++k) {
    for (const std::uint32_t i : front) {
      if (std::exchange(kept_[i], std::uint8_t{0}) != 0) released.push_back(i);
      each_neighbour(i, [&](std::uint32_t j) { next.push_back(j); });
    }
    make_distinct(next);
    front = std::exchange(next, {});
  }
  return released;
}

void InputFaces::freeze_doubled() {
  const auto on_its_vertices = [&](FaceId f, FaceId g) {
    return std::ranges::is_permutation(complex_.face[f.value], complex_.face[g.value]);
  };
  for (std::size_t k = 0; k < complex_.n_faces(); ++k) {
    const FaceId f(k);
    for (const FaceId g : faces_at_[complex_.face[k][0]])
      if (g > f && on_its_vertices(f, g)) frozen_[of(f)] = frozen_[of(g)] = 1;
  }
}

double InputFaces::contour_length(std::uint32_t i) const {
  // Edges that only one of the pieces has.
  std::vector<std::array<VertexId, 2>> edges;
  for (const FaceId f : pieces(i))
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(complex_.face[f.value][k], complex_.face[f.value][(k + 1) % 3]);
      edges.push_back({a, b});
    }
  std::ranges::sort(edges);
  double perimeter = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const bool alone = (k == 0 || edges[k - 1] != edges[k]) && (k + 1 == edges.size() || edges[k + 1] != edges[k]);
    if (alone) perimeter += distance(complex_.position[edges[k][0].value], complex_.position[edges[k][1].value]);
  }
  return perimeter;
}

Vec3 InputFaces::centre(std::uint32_t i) const {
  Vec3 sum;
  double weight = 0;
  for (const FaceId f : pieces(i)) {
    const Triangle t = complex_.corners(f);
    const double w = area(t);
    sum += w * centroid(t), weight += w;
  }
  return weight > 0 ? sum / weight : complex_.corners(pieces(i).front())[0];
}

bool InputFaces::share_a_mesh(FaceId f, FaceId g) const {
  if (mesh_of(complex_.component[f.value]) == mesh_of(complex_.component[g.value])) return true;
  if (complex_.layers_of(f).empty() && complex_.layers_of(g).empty()) return false;
  const std::vector<std::uint32_t> of_f = complex_.components_of(f), of_g = complex_.components_of(g);
  return std::ranges::any_of(of_f, [&](std::uint32_t a) {
    return std::ranges::any_of(of_g, [&](std::uint32_t b) { return mesh_of(a) == mesh_of(b); });
  });
}

std::vector<int> InputFaces::rings(int last) const {
  std::vector<int> ring(size(), 0);
  std::vector<std::uint32_t> front, next;
  for (std::uint32_t i = 0; i < size(); ++i)
    if (touched(i)) ring[i] = 1, front.push_back(i);
  for (int k = 2; k <= last && !front.empty(); ++k) {
    for (const std::uint32_t i : front)
      each_neighbour_of_layers(i, [&](std::uint32_t j) {
        if (ring[j] == 0) ring[j] = k, next.push_back(j);
      });
    front = std::exchange(next, {});
  }
  return ring;
}

}  // namespace meshgraft
