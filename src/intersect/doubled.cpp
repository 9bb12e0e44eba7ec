#include "intersect/doubled.hpp"

#include <algorithm>
#include <vector>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

JunctionFault duplicate_fault(const Complex& complex, FaceId f, FaceId g) {
  return {ErrorCode::kDuplicateFace,
          "two faces in one place meet another mesh",
          {complex.parent[f.value], complex.parent[g.value]},
          centroid(complex.corners(f))};
}

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3 p : t) box.add(p);
  return box;
}

/// Corner for corner nearer than `gap`, in any order.
bool coincide(const Triangle& t, const Triangle& u, double gap) {
  return std::ranges::all_of(
      t, [&](Vec3 p) { return std::ranges::any_of(u, [&](Vec3 q) { return distance(p, q) <= gap; }); });
}

/// Two faces of one component and one side in the same place, both overlapping a box.
std::optional<JunctionFault> doubled_faces_in(const Meeting& m, std::size_t s, const Box& within) {
  std::vector<LocalFace> near;
  for (LocalFace f = 0; f < m.side[s].n_faces(); ++f)
    if (within.overlaps(box_of(m.triangle(s, f)))) near.push_back(f);
  for (auto f = near.begin(); f != near.end(); ++f)
    for (auto g = f + 1; g != near.end(); ++g) {
      const FaceId a = m.side[s].face(*f), b = m.side[s].face(*g);
      const bool one_mesh = m.complex.component[a.value] == m.complex.component[b.value];
      if (!one_mesh || m.complex.parent[a.value] == m.complex.parent[b.value]) continue;
      if (coincide(m.triangle(s, *f), m.triangle(s, *g), m.rule.at(m.size[a.value]).weld))
        return duplicate_fault(m.complex, a, b);
    }
  return std::nullopt;
}

}  // namespace

std::optional<std::pair<JunctionFault, FaceId>> find_doubled_face(const Complex& complex,
                                                                  std::span<const std::uint8_t> marked) {
  std::vector<std::pair<std::array<VertexId, 3>, FaceId>> faces;
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    if (!marked[f]) continue;
    auto corners = complex.face[f];
    std::sort(corners.begin(), corners.end());
    faces.emplace_back(corners, FaceId(f));
  }
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].first != faces[i - 1].first) continue;
    const FaceId f = faces[i - 1].second, g = faces[i].second;
    JunctionFault fault = duplicate_fault(complex, f, g);
    if (complex.component[f.value] != complex.component[g.value])
      fault.code = ErrorCode::kOverlap, fault.what = "faces lie on each other over an area";
    return std::pair{std::move(fault), g};
  }
  return std::nullopt;
}

std::optional<JunctionFault> doubled_faces_at(const Meeting& m, FaceId uncut) {
  const Box within = box_of(m.complex.corners(uncut)).grown(m.rule.at(m.size[uncut.value]).weld);
  for (const std::size_t s : kSides)
    if (auto fault = doubled_faces_in(m, s, within)) return fault;
  return std::nullopt;
}

}  // namespace meshgraft
