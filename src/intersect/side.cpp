#include "intersect/side.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

/// One side of one face, near or adjacent to a near one.
struct Use {
  std::uint64_t edge = 0;  // smaller vertex, larger vertex
  FaceId face;
  LocalFace local = kNowhere;  // of a near face
  std::uint8_t corner = 0;
  bool forward = true;  // runs from the smaller to the larger vertex
};

std::uint64_t key(VertexId a, VertexId b) { return std::uint64_t{std::min(a, b).value} << 32 | std::max(a, b).value; }

bool is_sharp(const Complex& complex, const Use& a, const Use& b, double sharp_angle) {
  const Vec3 n = unit_normal(complex.corners(a.face));
  const Vec3 m = a.forward == b.forward ? -unit_normal(complex.corners(b.face)) : unit_normal(complex.corners(b.face));
  return dot(n, m) < std::cos(sharp_angle);
}

bool is_feature_edge(const Complex& complex, std::span<const Use> uses, const FeatureRule& rule) {
  const auto frozen = [&](std::uint64_t v) { return complex.state[v & 0xFFFFFFFF] == VertexState::kFrozen; };
  if (frozen(uses[0].edge >> 32) && frozen(uses[0].edge)) return false;  // its other faces may be missing
  if (uses.size() != 2 || is_sharp(complex, uses[0], uses[1], rule.sharp_angle)) return true;
  return rule.borders_of_layers && !complex.layers.empty() && !complex.are_of_the_same(uses[0].face, uses[1].face);
}

/// Between groups or attributes of one mesh; the border of what lies on it is another matter.
bool is_border(const Complex& complex, std::span<const Use> uses) {
  const auto differ = [&](const Use& u) {
    if (!complex.are_of_the_same(uses[0].face, u.face)) return false;
    return complex.face_groups[u.face.value] != complex.face_groups[uses[0].face.value] ||
           complex.face_attributes[u.face.value] != complex.face_attributes[uses[0].face.value];
  };
  return std::ranges::any_of(uses, differ);
}

/// Of edges with 1D elements, ascending.
std::vector<std::uint64_t> keys_of_lines(const Complex& complex) {
  std::vector<std::uint64_t> keys;
  keys.reserve(complex.lines.size());
  for (const Complex::Line& line : complex.lines) keys.push_back(key(line.ends[0], line.ends[1]));
  std::ranges::sort(keys);
  return keys;
}

}  // namespace

Side::Side(const Complex& complex, std::vector<FaceId> near, std::span<const std::uint8_t> own, const FeatureRule& rule)
    : faces_(std::move(near)),
      vertex_feature_(complex.n_vertices()),
      vertex_corner_(complex.n_vertices()),
      vertex_line_(complex.n_vertices()) {
  corners_.reserve(faces_.size());
  for (const FaceId f : faces_) corners_.push_back(complex.face[f.value]);
  find_edges(complex, own, rule);
  find_faces_at_vertices(complex.n_vertices());
}

void Side::find_edges(const Complex& complex, std::span<const std::uint8_t> own, const FeatureRule& rule) {
  std::vector<std::uint8_t> marked(complex.n_vertices());
  for (const auto& corners : corners_)
    for (const VertexId v : corners) marked[v.value] = 1;

  std::vector<Use> uses;
  uses.reserve(6 * faces_.size());
  LocalFace next = 0;
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    if (!own[f]) continue;
    const LocalFace local = next < faces_.size() && faces_[next].value == f ? next++ : kNowhere;
    const auto& v = complex.face[f];
    for (std::uint8_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      if (marked[a.value] || marked[b.value]) uses.push_back({key(a, b), FaceId(f), local, k, a < b});
    }
  }
  std::stable_sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.edge < b.edge; });

  const std::vector<std::uint64_t> lines = keys_of_lines(complex);
  std::vector<std::array<VertexId, 2>> feature_edges;  // both ways
  edges_.resize(faces_.size());
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].edge == uses[first].edge) ++last;
    const auto at = std::span(uses).subspan(first, last - first);
    const bool feature = meshgraft::is_feature_edge(complex, at, rule);
    const VertexId low(std::size_t(at[0].edge >> 32)), high(std::size_t(at[0].edge & 0xFFFFFFFF));
    if (feature) {
      vertex_feature_[low.value] = vertex_feature_[high.value] = 1;
      feature_edges.push_back({low, high}), feature_edges.push_back({high, low});
    }
    const bool line = feature || is_border(complex, at) || std::ranges::binary_search(lines, at[0].edge);
    if (line) vertex_line_[low.value] = vertex_line_[high.value] = 1;
    if (std::all_of(at.begin(), at.end(), [](const Use& u) { return u.local == kNowhere; })) continue;
    first_at_edge_.push_back(static_cast<std::uint32_t>(at_edge_.size()));
    for (const Use& u : at) {
      if (u.local == kNowhere) continue;
      edges_[u.local][u.corner] = static_cast<LocalEdge>(ends_.size());
      at_edge_.push_back(u.local);
    }
    ends_.push_back({low, high});
    n_at_edge_.push_back(static_cast<std::uint32_t>(at.size()));
    edge_feature_.push_back(feature), edge_line_.push_back(line);
  }
  first_at_edge_.push_back(static_cast<std::uint32_t>(at_edge_.size()));
  for (std::size_t v = 0; v < marked.size(); ++v)
    if (marked[v] && complex.state[v] == VertexState::kPinned) vertex_feature_[v] = vertex_corner_[v] = 1;
  find_corners(complex, rule.sharp_angle, std::move(feature_edges));
}

void Side::find_corners(const Complex& complex, double sharp_angle,
                        std::vector<std::array<VertexId, 2>> feature_edges) {
  std::sort(feature_edges.begin(), feature_edges.end());
  const auto way = [&](const std::array<VertexId, 2>& e) {
    return normalized(complex.position[e[1].value] - complex.position[e[0].value]);
  };
  for (std::size_t first = 0, last = 0; first < feature_edges.size(); first = last) {
    const VertexId v = feature_edges[first][0];
    while (last < feature_edges.size() && feature_edges[last][0] == v) ++last;
    const bool goes_on =
        last - first == 2 && -dot(way(feature_edges[first]), way(feature_edges[first + 1])) >= std::cos(sharp_angle);
    if (!goes_on) vertex_corner_[v.value] = 1;
  }
}

void Side::find_faces_at_vertices(std::size_t n_vertices) {
  at_vertex_ = Buckets<LocalFace>(n_vertices, [&](auto&& add) {
    for (LocalFace f = 0; f < faces_.size(); ++f)
      for (const VertexId v : corners_[f]) add(v.value, f);
  });
}

LocalFace Side::find(FaceId f) const {
  const auto at = std::lower_bound(faces_.begin(), faces_.end(), f);
  return at == faces_.end() || *at != f ? kNowhere : static_cast<LocalFace>(at - faces_.begin());
}

LocalEdge Side::find(VertexId a, VertexId b) const {
  const std::array<VertexId, 2> ends{std::min(a, b), std::max(a, b)};
  const auto at = std::lower_bound(ends_.begin(), ends_.end(), ends);
  return at == ends_.end() || *at != ends ? kNowhere : static_cast<LocalEdge>(at - ends_.begin());
}

}  // namespace meshgraft
