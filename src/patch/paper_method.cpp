#include "patch/paper_method.hpp"

#include <algorithm>
#include <map>

#include "geometry/quality.hpp"
#include "patch/blend.hpp"
#include "patch/opening.hpp"
#include "patch/refine.hpp"
#include "patch/regions.hpp"
#include "remesh/editor.hpp"
#include "remesh/resample.hpp"
#include "remesh/result.hpp"

namespace meshgraft {
namespace {

using Way = std::array<VertexId, 2>;

/// Unit normals at the vertices of a region: the mean of its faces there.
std::map<VertexId, Vec3> normals_of(const LocalMesh& mesh, const Region& region) {
  const Sheet& sheet = mesh.sheet(region.sheet);
  std::map<VertexId, Vec3> normals;
  for (const FaceId f : region.faces)
    for (const VertexId v : mesh.face(f).v) normals[v] += area_vector(mesh.corners(f));
  for (auto& [v, n] : normals) n = sheet.planar ? sheet.normal : normalized(n);
  return normals;
}

/// Whether a face outside of the region has the edge.
bool is_elsewhere(const LocalMesh& mesh, const Region& region, VertexId a, VertexId b) {
  return std::ranges::any_of(mesh.faces_at(a, b),
                             [&](FaceId f) { return !std::ranges::binary_search(region.faces, f); });
}

/// The filling of a region as faces of the working mesh, or why there is none.
tl::expected<std::vector<LocalFace>, std::string> filled(const LocalMesh& mesh, const Region& region) {
  const std::map<VertexId, Vec3> normals = normals_of(mesh, region);
  Opening opening;
  opening.contours = region.contours;
  opening.planar = mesh.sheet(region.sheet).planar;
  opening.position = [&](VertexId v) { return mesh.position(v); };
  opening.normal = [&](VertexId v) { return normals.at(v); };
  opening.has_edge = [&](VertexId a, VertexId b) { return is_elsewhere(mesh, region, a, b); };
  const auto filling = fill_opening(opening);
  if (!filling) return tl::unexpected(filling.error());

  std::map<Way, CurveId> curve;
  for (std::size_t c = 0; c < region.contours.size(); ++c)
    for (std::size_t k = 0; k < region.contours[c].size(); ++k)
      curve[{region.contours[c][k], region.contours[c][(k + 1) % region.contours[c].size()]}] = region.sides[c][k];
  const LocalFace like = mesh.face(region.faces.front());
  std::vector<LocalFace> faces;
  for (const auto& v : filling->faces) {
    LocalFace& face = faces.emplace_back(like);
    face.v = v;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto side = curve.find({v[k], v[(k + 1) % 3]});
      face.curve[k] = side == curve.end() ? CurveId{} : side->second;
    }
  }
  return faces;
}

/// The centroid of the largest face.
Vec3 middle_of(const LocalMesh& mesh, const Region& region) {
  const FaceId largest = *std::ranges::max_element(region.faces, {}, [&](FaceId f) { return area(mesh.corners(f)); });
  return centroid(mesh.corners(largest));
}

}  // namespace

RemeshedByPaper remesh_by_paper(const Complex& complex, const Brep& brep, const SizeField& size,
                                const std::vector<std::uint8_t>& in_zone, GroupSets& groups, Blend blend,
                                const RemeshOptions& options) {
  const Sizing sizing = sizing_of(size);
  Editor editor(complex, brep, in_zone, sizing, options);
  resample_curves(editor, complex, brep, sizing);
  std::vector<std::uint8_t> is_filled(brep.sheets.size(), 0);
  RemeshedByPaper result;
  for (const Region& region : regions_of(editor.mesh())) {
    const auto faces = filled(editor.mesh(), region);
    if (!faces) {
      result.unfilled.push_back({middle_of(editor.mesh(), region), faces.error()});
      continue;
    }
    editor.replace(region.faces, *faces);
    is_filled[region.sheet.value] = 1;
  }
  refine(editor, is_filled);
  BlendOptions blend_options;
  blend_options.blend = blend;
  blend_filled(editor, complex, is_filled, blend_options);
  result.remeshed = to_remeshed(editor, complex, brep, in_zone, groups);
  return result;
}

}  // namespace meshgraft
