#include "fill/shape.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "geometry/quality.hpp"
#include "merge/quality_summary.hpp"
#include "patch/blend.hpp"
#include "patch/membrane.hpp"
#include "patch/opening.hpp"
#include "patch/refine.hpp"
#include "remesh/result.hpp"

namespace meshgraft {
namespace {

constexpr double kFlatSheet = 1e-9;  // of the width of a patch: what it may leave its plane by if it is planar

/// The faces around by their free edges, in the direction of the patch.
using Beyond = std::map<std::array<VertexId, 2>, FaceId>;

/// Whether a patch that lies in a plane stays there though the surface is to be continued: all around lies in the
/// plane, too; or stands on it so steeply that the patch is a cap; or has a fold that ends at the rim, as it cannot be
/// continued on both sides of that.
bool stays_flat(const Patched& p, std::span<const FaceId> patch, Vec3 normal, double limit, const Beyond& beyond) {
  const Vec3 origin = p.complex.corners(patch.front())[0];
  const double smooth = std::cos(BrepOptions{}.sharp_angle);
  std::map<VertexId, Vec3> normal_beyond;  // by vertex of the rim: of one of the faces there
  bool is_level = true;
  for (const FaceId f : patch)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = p.complex.face[f.value];
      const auto it = beyond.find({v[k], v[(k + 1) % 3]});
      if (it == beyond.end()) continue;
      const Triangle t = p.complex.corners(it->second);
      const Vec3 n = unit_normal(t);
      if (dot(n, normal) < OpeningOptions{}.least_cosine) return true;
      is_level = is_level && std::ranges::all_of(t, [&](Vec3 q) { return std::abs(dot(q - origin, normal)) <= limit; });
      for (const VertexId end : it->first)
        if (const auto [other, is_first] = normal_beyond.try_emplace(end, n);
            !is_first && dot(other->second, n) < smooth)
          return true;
    }
  return is_level;
}

/// Corners, curves and sheets: those of what is around, and one sheet for each patch, on the surface of its faces or
/// not.
Brep brep_of(const Patched& p, GroupSets& groups, Blend blend, bool on_its_surface) {
  Complex around = p.complex;
  around.face.resize(p.n_around), around.parent.resize(p.n_around), around.component.resize(p.n_around);
  around.face_groups.resize(p.n_around), around.face_attributes.resize(p.n_around);
  Brep brep = read_brep(around, {}, {}, groups);
  std::map<std::array<VertexId, 2>, CurveId> curve;  // of free edges, in the direction of the patch
  Beyond beyond;
  for (std::size_t f = 0; f < p.n_around; ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (brep.curve_of_edge[f][k].valid()) {
        const std::array edge{around.face[f][(k + 1) % 3], around.face[f][k]};
        curve[edge] = brep.curve_of_edge[f][k], beyond[edge] = FaceId(f);
      }
  for (const Complex::Line& line : around.lines) {  // in a hole, each is a curve that stays as it is
    const auto [a, b] = line.ends;
    if (!p.beams.contains(nodes_of(around, a, b)) || curve.contains({a, b})) continue;
    curve[{a, b}] = curve[{b, a}] = CurveId(brep.curves.size());
    Curve& beam = brep.curves.emplace_back();
    beam.chain = {a, b}, beam.fixed = true;
  }
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
      if (is_around[v[k].value] == 0 && !p.complex.node[v[k].value].valid())
        brep.dimension[v[k].value] = Dimension::kSheet;
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
    const double limit = kFlatSheet * std::sqrt(norm(area));
    sheet.planar = std::ranges::all_of(sheet.faces, [&](FaceId f) {
      return std::ranges::all_of(p.complex.corners(f),
                                 [&](Vec3 q) { return std::abs(dot(q - origin, normal)) <= limit; });
    });
    if (sheet.planar && blend != Blend::kPosition) sheet.planar = stays_flat(p, sheet.faces, normal, limit, beyond);
    if (sheet.planar) sheet.normal = normal, sheet.origin = origin;
  }
  return brep;
}

/// The patches of a remeshed complex: faces of the zone that hang together.
Patched patched_again(Remeshed remeshed, const std::set<NodePair>& beams) {
  Patched p;
  p.beams = beams;
  p.complex = std::move(remeshed.complex), p.in_zone = std::move(remeshed.in_zone);
  p.n_around = static_cast<std::size_t>(std::ranges::find(p.in_zone, 1) - p.in_zone.begin());
  p.patch = patches_of(p.complex, p.n_around, p.beams);
  return p;
}

/// Moves the nodes inside curved patches to the membrane through their rims and beams.
void put_on_membrane(Patched& p) {
  std::vector<std::uint8_t> is_free(p.complex.n_vertices(), 0);
  const auto patches = std::span(p.complex.face).subspan(p.n_around);
  for (const auto& face : patches)
    for (const VertexId v : face) is_free[v.value] = p.complex.node[v.value].valid() ? 0 : 1;
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (const auto& [a, b, c] : patches) faces.push_back({a.value, b.value, c.value});
  p.complex.position = on_membrane(faces, std::move(p.complex.position), is_free);
}

/// The patches in the working mesh, ready to be worked on.
struct Workshop {
  Workshop(const Patched& p, const Sizing& sizing, GroupSets& groups, Blend blend, const RemeshOptions& options)
      : complex(p.complex),
        in_zone(p.in_zone),
        brep(brep_of(p, groups, blend, false)),
        editor(complex, brep, in_zone, sizing, options) {
    is_patch.assign(brep.sheets.size(), 0);
    for (std::size_t f = p.n_around; f < in_zone.size(); ++f) is_patch[brep.sheet_of_face[f].value] = 1;
  }

  /// To refine and blend a patch whose faces are as they were.
  void call_all_filled() {
    std::vector<FaceId> faces;
    std::vector<LocalFace> anew;
    for (std::size_t f = 0; f < in_zone.size(); ++f)
      if (in_zone[f] != 0) faces.emplace_back(f), anew.push_back(editor.mesh().face(FaceId(f)));
    editor.replace(faces, anew);
  }

  [[nodiscard]] bool is_curved() const {
    for (std::size_t s = 0; s < is_patch.size(); ++s)
      if (is_patch[s] != 0 && !brep.sheets[s].planar) return true;
    return false;
  }

  Blended blend(const BlendOptions& options) { return blend_filled(editor, complex, is_patch, options); }
  Remeshed result(GroupSets& groups) { return to_remeshed(editor, complex, brep, in_zone, groups); }

  const Complex& complex;
  const std::vector<std::uint8_t>& in_zone;
  Brep brep;
  Editor editor;
  std::vector<std::uint8_t> is_patch;  // by sheet
};

class Shaper {
 public:
  Shaper(const RimSizing& sizing, GroupSets& groups, const MergeOptions& options)
      : sizing_(sizing), groups_(groups), options_(options) {
    remesh_options_.min_quality = options.min_quality;
    remesh_options_.edge_samples = 1;  // the surface is to be blended once more
    remesh_options_.replaces_input = false;
    blend_.blend = options.blend, blend_.rim_is_smooth = true;
  }

  Shaped run(Patched patches) {
    if (options_.method == Method::kPaper) {
      grow(patches, sizing_.fine);
      Workshop work(patches, sizing_.fine, groups_, blend_.blend, remesh_options_);
      work.call_all_filled();
      refine(work.editor, work.is_patch);
      return blended(work, true);
    }
    grow(patches, sizing_.coarse);
    Shaped shape = settled(patches, sizing_.coarse, true);
    const Patched surface = patched_again(shape.remeshed, patches.beams);
    return is_coarse(surface) ? settled(surface, sizing_.fine, false) : shape;
  }

 private:
  static constexpr double kGrowth = 0.1;  // of the faces: growth below it is left to the last step
  static constexpr int kMostRounds = 4;   // of remeshing on the surface and blending what has come of it
  static constexpr double kNear = 1;      // edge lengths: a blending that moves faces less hardly changes their shape
  static constexpr double kCoarse = 1.3;  // of the size that is wanted: where sizes are more, the mesh is to be refined

  /// Inserts nodes step by step, in each on what the membrane through those of the last step is: the first faces, which
  /// only know the rim, are far from any smooth surface, and nodes on them would fold it on the way there.
  void grow(Patched& patches, const Sizing& sizing) const {
    for (double growth = 1; growth > kGrowth;) {
      Workshop work(patches, sizing, groups_, blend_.blend, remesh_options_);
      work.call_all_filled();
      refine(work.editor, work.is_patch, {.most_rounds = 1});
      const auto before = static_cast<double>(patches.patch.size());
      patches = patched_again(work.result(groups_), patches.beams);
      if (work.is_curved()) put_on_membrane(patches);
      growth = static_cast<double>(patches.patch.size()) / before - 1;
    }
  }

  /// Whether the mesh is as coarse as the first one may be.
  [[nodiscard]] bool is_coarse(const Patched& patches) const {
    for (std::size_t f = patches.n_around; f < patches.complex.n_faces(); ++f) {
      const Vec3 p = centroid(patches.complex.corners(FaceId(f)));
      if (sizing_.coarse.in_sheet({}, p) > kCoarse * sizing_.fine.in_sheet({}, p)) return true;
    }
    return false;
  }

  /// Meshes the surface and blends what has come of it, until that moves little and leaves no poor faces.
  Shaped settled(Patched surface, const Sizing& sizing, bool from_membrane) const {
    std::optional<Shaped> best;  // of those that moved little
    for (int round = 0;; ++round) {
      RemeshOptions options = remesh_options_;
      options.keeps_good = round > 0;
      const Brep brep = brep_of(surface, groups_, blend_.blend, true);
      const Patched patches =
          patched_again(remesh(surface.complex, brep, sizing, surface.in_zone, groups_, options), surface.beams);
      Workshop work(patches, sizing, groups_, blend_.blend, remesh_options_);
      Shaped shape = blended(work, from_membrane && round == 0);
      const auto& [moved, left, left_at] = shape.blended;
      const bool is_last = round + 1 == kMostRounds || moved == 0, is_near = left == 0 && moved < kNear;
      if (is_near && (!best || n_poor(shape) < n_poor(*best))) best = shape;
      if (best && (is_last || n_poor(*best) == 0)) return std::move(*best);
      if (is_last) return shape;
      surface = patched_again(std::move(shape.remeshed), surface.beams);
    }
  }

  /// Faces that break the promise of a good mesh.
  static std::ptrdiff_t n_poor(const Shaped& shape) {
    return std::ranges::count_if(shape.remeshed.bad, [](const BadFace& bad) { return !is_excused(bad); });
  }

  Shaped blended(Workshop& work, bool from_membrane) const {
    if (from_membrane && blend_.blend == Blend::kCurvature) {  // from there it leads far beyond its aim
      BlendOptions smooth = blend_;
      smooth.blend = Blend::kTangency;
      work.blend(smooth);
    }
    const Blended blended = work.blend(blend_);
    return {work.result(groups_), blended};
  }

  const RimSizing& sizing_;
  GroupSets& groups_;
  const MergeOptions& options_;
  RemeshOptions remesh_options_;
  BlendOptions blend_;
};

}  // namespace

Shaped shaped(const Patched& coarse, const RimSizing& sizing, GroupSets& groups, const MergeOptions& options) {
  return Shaper(sizing, groups, options).run(coarse);
}

}  // namespace meshgraft
