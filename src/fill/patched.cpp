#include "fill/patched.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/union_find.hpp"
#include "geometry/quality.hpp"
#include "patch/blend.hpp"
#include "patch/opening.hpp"
#include "patch/refine.hpp"
#include "remesh/result.hpp"
#include "zone/edge_table.hpp"

namespace meshgraft {
namespace {

constexpr double kFlatHeight = 1e-9;  // of the length of a rim: what it may leave its plane by if it is planar

double side_length(const Complex& c, const Rim& rim, std::size_t k) {
  const VertexId a = rim.vertices[k], b = rim.vertices[(k + 1) % rim.vertices.size()];
  return distance(c.position[a.value], c.position[b.value]);
}

double length_of(const Complex& c, const Hole& hole) {
  double sum = 0;
  for (const Rim& rim : hole)
    for (std::size_t k = 0; k < rim.vertices.size(); ++k) sum += side_length(c, rim, k);
  return sum;
}

/// Area vector of the polygons through the vertices.
Vec3 area_of(const Complex& c, const Hole& hole) {
  Vec3 sum;
  const Vec3 origin = c.position[hole.front().vertices.front().value];
  for (const Rim& rim : hole)
    for (std::size_t k = 0; k < rim.vertices.size(); ++k)
      sum += 0.5 * cross(c.position[rim.vertices[k].value] - origin,
                         c.position[rim.vertices[(k + 1) % rim.vertices.size()].value] - origin);
  return sum;
}

/// Normals at the vertices of a hole, and whether all faces there lie in one plane with it.
struct RimNormals {
  std::map<VertexId, Vec3> at;
  bool planar = true;

  RimNormals(const Complex& c, const VertexFaces& faces_at, const Hole& hole) {
    const Vec3 across = area_of(c, hole), plane = normalized(across);
    const Vec3 origin = c.position[hole.front().vertices.front().value];
    const double length = length_of(c, hole);
    planar = norm(across) > kFlatHeight * length * length;  // the ends of a pipe cancel each other
    for (const Rim& rim : hole)
      for (const VertexId v : rim.vertices) {
        Vec3 sum;
        for (const FaceId f : faces_at[v]) {
          sum += area_vector(c.corners(f));
          for (const Vec3 p : c.corners(f)) planar = planar && std::abs(dot(p - origin, plane)) <= kFlatHeight * length;
        }
        at[v] = normalized(sum);
      }
    if (planar)
      for (auto& [v, n] : at) n = plane;
  }
};

/// The faces that close a hole; the surface is followed as far as that is possible.
tl::expected<OpeningFill, std::string> closed(const Complex& c, const VertexFaces& faces_at, const EdgeTable& edges,
                                              const Hole& hole) {
  const RimNormals normals(c, faces_at, hole);
  const Vec3 across = normalized(area_of(c, hole));
  Opening opening;
  for (const Rim& rim : hole) opening.contours.push_back(rim.vertices);
  opening.planar = normals.planar;
  opening.position = [&](VertexId v) { return c.position[v.value]; };
  opening.normal = [&](VertexId v) { return normals.at.at(v); };
  opening.has_edge = [&](VertexId a, VertexId b) { return edges.find(a, b).valid(); };
  OpeningOptions options;
  const auto along = fill_opening(opening, options);
  if (along) return along;
  opening.normal = [&](VertexId) { return across; };  // a cap: the end of a pipe, a rim that is folded
  for (const double least_cosine : {options.least_cosine, 0.0}) {
    options.least_cosine = least_cosine;
    if (auto fill = fill_opening(opening, options)) return fill;
  }
  return along;
}

/// The face of a hole's rims whose attributes hold along the greatest part of them.
FaceId typical_face(const Complex& c, const Hole& hole) {
  std::map<std::pair<AttributesId, std::uint32_t>, double> length;
  const auto key = [&](FaceId f) { return std::pair{c.face_attributes[f.value], c.component[f.value]}; };
  for (const Rim& rim : hole)
    for (std::size_t k = 0; k < rim.faces.size(); ++k) length[key(rim.faces[k])] += side_length(c, rim, k);
  const auto most = std::ranges::max_element(length, {}, [](const auto& entry) { return entry.second; });
  FaceId best;
  for (const Rim& rim : hole)
    for (const FaceId f : rim.faces)
      if (key(f) == most->first && (!best.valid() || c.parent[f.value] < c.parent[best.value])) best = f;
  return best;
}

/// Corners, curves and sheets: those of what is around, and one sheet for each patch, on the surface of its faces or
/// not.
Brep brep_of(const Patched& p, GroupSets& groups, bool on_its_surface) {
  Complex around = p.complex;
  around.face.resize(p.n_around), around.parent.resize(p.n_around), around.component.resize(p.n_around);
  around.face_groups.resize(p.n_around), around.face_attributes.resize(p.n_around);
  Brep brep = read_brep(around, {}, {}, groups);
  std::map<std::array<VertexId, 2>, CurveId> curve;  // of free edges, in the direction of the patch
  for (std::size_t f = 0; f < p.n_around; ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (brep.curve_of_edge[f][k].valid())
        curve[{around.face[f][(k + 1) % 3], around.face[f][k]}] = brep.curve_of_edge[f][k];
  std::vector<std::uint8_t> is_around(around.n_vertices(), 0);
  for (const auto& face : around.face)
    for (const VertexId v : face) is_around[v.value] = 1;
  const std::size_t first_sheet = brep.sheets.size();
  for (std::size_t i = 0; i < p.patch.size(); ++i) {
    const FaceId f(p.n_around + i);
    const SheetId sheet(first_sheet + p.patch[i]);
    if (sheet.value >= brep.sheets.size()) brep.sheets.resize(sheet.value + 1);
    brep.sheets[sheet.value].faces.push_back(f);
    brep.sheet_of_face.push_back(sheet);
    auto& sides = brep.curve_of_edge.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = p.complex.face[f.value];
      if (is_around[v[k].value] == 0) brep.dimension[v[k].value] = Dimension::kSheet;
      const auto it = curve.find({v[k], v[(k + 1) % 3]});
      if (it == curve.end()) continue;
      sides[k] = it->second;
      brep.curves[it->second.value].free = false;
    }
  }
  for (std::size_t s = first_sheet; s < brep.sheets.size(); ++s) {
    Sheet& sheet = brep.sheets[s];
    sheet.made_up = !on_its_surface;
    Vec3 area;
    for (const FaceId f : sheet.faces) area += area_vector(p.complex.corners(f));
    const Vec3 normal = normalized(area), origin = p.complex.corners(sheet.faces.front())[0];
    const double limit = kFlatHeight * std::sqrt(norm(area));
    sheet.planar = std::ranges::all_of(sheet.faces, [&](FaceId f) {
      return std::ranges::all_of(p.complex.corners(f),
                                 [&](Vec3 q) { return std::abs(dot(q - origin, normal)) <= limit; });
    });
    if (sheet.planar) sheet.normal = normal, sheet.origin = origin;
  }
  return brep;
}

/// The patches of a remeshed complex: faces of the zone that hang together.
Patched patched_again(Remeshed remeshed) {
  Patched p;
  p.complex = std::move(remeshed.complex), p.in_zone = std::move(remeshed.in_zone);
  p.n_around = static_cast<std::size_t>(std::ranges::find(p.in_zone, 1) - p.in_zone.begin());
  const std::size_t n = p.in_zone.size() - p.n_around;
  UnionFind together(n);
  std::map<std::array<VertexId, 2>, std::uint32_t> first_at;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = p.complex.face[p.n_around + i];
      const auto [a, b] = std::minmax(v[k], v[(k + 1) % 3]);
      const auto [it, is_first] = first_at.try_emplace({a, b}, i);
      if (!is_first) together.unite(it->second, i);
    }
  std::map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t i = 0; i < n; ++i)
    p.patch.push_back(number.try_emplace(together.find(i), static_cast<std::uint32_t>(number.size())).first->second);
  return p;
}

/// The patches in the working mesh, ready to be worked on.
struct Workshop {
  Workshop(const Patched& p, const Sizing& sizing, GroupSets& groups, const RemeshOptions& options)
      : complex(p.complex),
        in_zone(p.in_zone),
        brep(brep_of(p, groups, false)),
        editor(complex, brep, in_zone, sizing, options) {
    is_patch.assign(brep.sheets.size(), 0);
    for (std::size_t f = p.n_around; f < in_zone.size(); ++f) is_patch[brep.sheet_of_face[f].value] = 1;
  }
  const Complex& complex;
  const std::vector<std::uint8_t>& in_zone;
  Brep brep;
  Editor editor;
  std::vector<std::uint8_t> is_patch;  // by sheet
};

}  // namespace

tl::expected<Patched, NotClosed> patched(const Complex& around, std::span<const Hole> holes, GroupSets& groups) {
  const VertexFaces faces_at(around);
  const EdgeTable edges(around);
  Patched p;
  p.complex = around, p.n_around = around.n_faces();
  for (std::size_t h = 0; h < holes.size(); ++h) {
    const auto fill = closed(around, faces_at, edges, holes[h]);
    if (!fill) return tl::unexpected(NotClosed{h, fill.error()});
    const FaceId like = typical_face(around, holes[h]);
    GroupSetId common = around.face_groups[like.value];
    for (const Rim& rim : holes[h])
      for (const FaceId f : rim.faces) common = groups.intersect(common, around.face_groups[f.value]);
    for (const auto& v : fill->faces) {
      const FaceId f = p.complex.add_face(v, around, like);
      p.complex.face_groups[f.value] = common;
      p.patch.push_back(static_cast<std::uint32_t>(h));
    }
  }
  p.in_zone.assign(p.complex.n_faces(), 1);
  std::fill_n(p.in_zone.begin(), p.n_around, std::uint8_t{0});
  return p;
}

Sizing rim_sizing(const Complex& around, std::span<const Hole> holes, std::optional<double> size) {
  if (size) return {[s = *size](SheetId, Vec3) { return s; }, [s = *size](CurveId, Vec3) { return s; }};
  struct Sample {
    Vec3 at;
    double size;
  };
  std::vector<Sample> samples;
  const VertexFaces faces_at(around);
  for (const Hole& hole : holes)
    for (const Rim& rim : hole)
      for (const VertexId v : rim.vertices) {
        double sum = 0;
        for (const FaceId f : faces_at[v]) sum += mean_edge_length(around.corners(f));
        samples.push_back({around.position[v.value], sum / static_cast<double>(faces_at[v].size())});
      }
  const auto mean = [samples = std::move(samples)](Vec3 p) {
    double sum = 0, weight = 0;
    for (const Sample& s : samples) {
      const double w = 1 / std::max(squared_norm(p - s.at), 1e-12 * s.size * s.size);
      sum += w * s.size, weight += w;
    }
    return sum / weight;
  };
  return {[mean](SheetId, Vec3 p) { return mean(p); }, [mean](CurveId, Vec3 p) { return mean(p); }};
}

Remeshed shaped(const Patched& coarse, const Sizing& sizing, GroupSets& groups, const MergeOptions& options) {
  RemeshOptions remesh_options;
  remesh_options.min_quality = options.min_quality;
  remesh_options.edge_samples = 0;  // the surface is to be blended once more
  const BlendOptions blend{.blend = options.blend, .rim_is_smooth = true};
  Remeshed fine;
  {
    Workshop work(coarse, sizing, groups, remesh_options);
    std::vector<FaceId> faces;
    std::vector<LocalFace> anew;  // so that they count as filled
    for (std::size_t f = coarse.n_around; f < coarse.in_zone.size(); ++f)
      faces.emplace_back(f), anew.push_back(work.editor.mesh().face(FaceId(f)));
    work.editor.replace(faces, anew);
    refine(work.editor, work.is_patch);
    blend_filled(work.editor, work.complex, work.is_patch, blend);
    fine = to_remeshed(work.editor, work.complex, work.brep, work.in_zone, groups);
  }
  if (options.method == Method::kPaper) return fine;
  const Patched surface = patched_again(std::move(fine));
  const Brep brep = brep_of(surface, groups, true);
  const Patched better = patched_again(remesh(surface.complex, brep, sizing, surface.in_zone, groups, remesh_options));
  Workshop work(better, sizing, groups, remesh_options);
  blend_filled(work.editor, work.complex, work.is_patch, blend);
  return to_remeshed(work.editor, work.complex, work.brep, work.in_zone, groups);
}

}  // namespace meshgraft
