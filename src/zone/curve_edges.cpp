#include "zone/curve_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/blocks.hpp"
#include "geometry/quality.hpp"
#include "zone/open_seams.hpp"
#include "zone/original_faces.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kEdgeBlock = 4096;  // edges judged in one go

/// What two faces of one sheet have in common: component, attributes, groups; the same of each layer.
using LayerKey = std::tuple<std::uint32_t, AttributesId, GroupSetId>;
using FaceKey = std::pair<LayerKey, std::vector<LayerKey>>;

/// What an edge bounds and carries.
struct Kind {
  bool junction = false, fixed = false;
  std::vector<FaceKey> faces;                               // ascending
  std::vector<std::tuple<AttributesId, GroupSetId>> lines;  // ascending
  friend auto operator<=>(const Kind&, const Kind&) = default;
};

double angle_between(Vec3 a, Vec3 b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

auto line_key(const Complex::Line& line) { return std::tuple(line.attributes, line.groups); }

void place_lines(const Complex& complex, const EdgeTable& edges, CurveEdges& result) {
  std::vector<std::pair<EdgeId, std::uint32_t>> placed;
  for (std::uint32_t i = 0; i < complex.lines.size(); ++i) {
    const auto [a, b] = complex.lines[i].ends;
    const EdgeId e = edges.find(a, b);
    if (e.valid())
      placed.emplace_back(e, i);
    else
      result.ends_of_loose_lines.insert(result.ends_of_loose_lines.end(), {a, b});
  }
  std::ranges::sort(placed, {},
                    [&](const auto& p) { return std::tuple(p.first, line_key(complex.lines[p.second]), p.second); });
  result.first_line.assign(edges.size() + 1, 0);
  for (const auto& [e, i] : placed) {
    ++result.first_line[e.value + 1];
    result.line.push_back(i);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) result.first_line[e + 1] += result.first_line[e];
}

class Classifier {
 public:
  Classifier(const Complex& complex, const EdgeTable& edges, const Parents& parents, const CurveEdges& marks,
             const BrepOptions& options)
      : complex_(complex), edges_(edges), parents_(parents), marks_(marks), options_(options) {
    area_vector_ = area_vectors(parents, complex);
    if (options.original == nullptr) return;
    const OriginalFaces originals(*options.original);
    const auto as_it_was = [&](std::size_t first, std::size_t last) {
      for (std::size_t p = first; p < last; ++p)
        if (const FaceId f = originals.find(complex.parent[parents.faces_of(static_cast<std::uint32_t>(p))[0].value]);
            f.valid())
          area_vector_[p] = area_vector(options.original->corners(f));
    };
    for_blocks(parents.size(), as_it_was, kEdgeBlock);
  }

  [[nodiscard]] bool is_curve(EdgeId e) const {
    const auto uses = edges_.uses(e);
    if (uses.size() != 2 || marks_.junction[e.value] || marks_.fixed[e.value] || !marks_.lines_of(e).empty())
      return true;
    const FaceId f = uses[0].face, g = uses[1].face;
    if (uses[0].forward == uses[1].forward || face_key(f) != face_key(g)) return true;
    const std::uint32_t p = parents_.of_face[f.value], q = parents_.of_face[g.value];
    return p != q && angle_between(area_vector_[p], area_vector_[q]) > options_.sharp_angle;
  }

  [[nodiscard]] Kind kind(EdgeId e) const {
    Kind k;
    k.junction = marks_.junction[e.value] != 0, k.fixed = marks_.fixed[e.value] != 0;
    for (const EdgeUse& use : edges_.uses(e)) k.faces.push_back(face_key(use.face));
    std::ranges::sort(k.faces);
    for (const std::uint32_t i : marks_.lines_of(e)) k.lines.push_back(line_key(complex_.lines[i]));
    return k;
  }

 private:
  [[nodiscard]] FaceKey face_key(FaceId f) const {
    FaceKey key{{complex_.component[f.value], complex_.face_attributes[f.value], complex_.face_groups[f.value]}, {}};
    for (const Complex::Layer& layer : complex_.layers_of(f))
      key.second.emplace_back(layer.component, layer.attributes, layer.groups);
    return key;
  }

  const Complex& complex_;
  const EdgeTable& edges_;
  const Parents& parents_;
  const CurveEdges& marks_;
  const BrepOptions& options_;
  std::vector<Vec3> area_vector_;  // by parent, as it was in the input: closing a gap bends faces, and makes no edge
};

}  // namespace

CurveEdges curve_edges(const Complex& complex, const EdgeTable& edges, const Parents& parents,
                       std::span<const std::array<VertexId, 2>> junction_edges, const BrepOptions& options) {
  CurveEdges result;
  result.kind.assign(edges.size(), CurveEdges::kNoKind);
  result.junction.assign(edges.size(), 0);
  result.fixed.assign(edges.size(), 0);
  for (const auto& [a, b] : junction_edges)
    if (const EdgeId e = edges.find(a, b); e.valid()) result.junction[e.value] = 1;
  for (const auto& [a, b] : complex.fixed_edges)
    if (const EdgeId e = edges.find(a, b); e.valid()) result.fixed[e.value] = 1;
  // Nodes added on one border of an open seam would face none on the other.
  for (const EdgeId e : seam_edges(complex, edges)) result.fixed[e.value] = 1;
  place_lines(complex, edges, result);

  const Classifier classifier(complex, edges, parents, result, options);
  std::map<Kind, std::uint32_t> kinds;
  const auto curves = collected<EdgeId>(
      edges.size(),
      [&](std::size_t i, std::vector<EdgeId>& out) {
        if (classifier.is_curve(EdgeId(i))) out.emplace_back(i);
      },
      kEdgeBlock);
  for (const EdgeId e : curves) {
    const auto [a, b] = edges.ends(e);
    if (is_frozen_edge(complex, a, b)) result.fixed[e.value] = 1;
    result.kind[e.value] =
        kinds.try_emplace(classifier.kind(e), static_cast<std::uint32_t>(kinds.size())).first->second;
  }
  return result;
}

}  // namespace meshgraft
