#include "remesh/result.hpp"

#include <algorithm>
#include <compare>
#include <span>

#include "core/blocks.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kProjectBlock = 256;  // vertices or faces projected in one go

class Writer {
 public:
  Writer(Editor& editor, const Complex& complex, const Brep& brep, const std::vector<std::uint8_t>& in_zone,
         GroupSets& groups)
      : editor_(editor), complex_(complex), brep_(brep), in_zone_(in_zone), groups_(groups) {}

  Remeshed run() {
    collect_curve_edges();
    write_lines_first();
    number_vertices();
    find_faces_beneath();
    for (std::size_t v = 0; v < mesh().n_vertices(); ++v)
      if (id_[v].valid()) write_vertex(VertexId(v));
    write_faces();
    for (Complex::Line& line : lines_) {
      for (VertexId& end : line.ends) end = id_[end.value];
      out().lines.push_back(line);
    }
    for (const auto& e : complex_.fixed_edges) out().fixed_edges.push_back({id_[e[0].value], id_[e[1].value]});
    out().joins = complex_.joins;
    measure_curves();
    std::ranges::sort(result_.bad,
                      [](const BadFace& a, const BadFace& b) { return a.q < b.q || (a.q == b.q && a.face < b.face); });
    return std::move(result_);
  }

 private:
  [[nodiscard]] const LocalMesh& mesh() const { return editor_.mesh(); }
  Complex& out() { return result_.complex; }

  /// An edge of a resampled curve, from the smaller to the larger arc length.
  struct CurveEdge {
    double from, to;
    VertexId a, b;
    friend auto operator<=>(const CurveEdge&, const CurveEdge&) = default;
  };

  /// Edges in the zone by curve, each list ascending by arc length.
  void collect_curve_edges() {
    edges_.resize(brep_.curves.size());
    for (std::size_t k = 0; k < mesh().n_faces(); ++k) {
      const LocalFace& f = mesh().face(FaceId(k));
      if (!f.alive || !f.in_zone) continue;
      for (std::size_t i = 0; i < 3; ++i)
        if (f.curve[i].valid()) edges_[f.curve[i].value].push_back(with_arcs(f.curve[i], f.v[i], f.v[(i + 1) % 3]));
    }
    for (auto& edges : edges_) {
      std::ranges::sort(edges);
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    }
  }

  [[nodiscard]] CurveEdge with_arcs(CurveId c, VertexId a, VertexId b) const {
    const Curve& curve = brep_.curves[c.value];
    const double whole = editor_.reference().length(c);
    const bool loop = curve.chain.front() == curve.chain.back();
    const bool a_slides = mesh().vertex(a).curve == c, b_slides = mesh().vertex(b).curve == c;
    const auto corner = [&](VertexId v) { return !loop && v == curve.chain.back() ? whole : 0.0; };
    double from = a_slides ? mesh().vertex(a).arc : corner(a);
    double to = b_slides ? mesh().vertex(b).arc : corner(b);
    if (loop) {  // the shorter way round; between a corner and its neighbour that is unique as well
      if (to - from > 0.5 * whole) from += whole;
      if (from - to > 0.5 * whole) to += whole;
    }
    return from <= to ? CurveEdge{from, to, a, b} : CurveEdge{to, from, b, a};
  }

  /// 1D elements: kept where their edge is still there, wherever its ends have slid to; made anew on the other
  /// edges of a curve.
  void write_lines_first() {
    std::vector<std::uint8_t> gone(complex_.lines.size(), 0);
    std::vector<Complex::Line> made;
    for (std::size_t c = 0; c < brep_.curves.size(); ++c) {
      const Curve& curve = brep_.curves[c];
      if (curve.lines_per_edge == 0 || editor_.reference().polyline(CurveId(c)).empty()) continue;
      const std::size_t n = curve.lines_per_edge;
      std::vector<std::array<VertexId, 2>> kept;
      for (std::size_t e = 0; e + 1 < curve.chain.size(); ++e) {
        const VertexId a = curve.chain[e], b = curve.chain[e + 1];
        if (mesh().has_edge(a, b) && mesh().curve_at(a, b) == CurveId(c))
          kept.push_back({std::min(a, b), std::max(a, b)});
        else
          for (std::size_t k = 0; k < n; ++k) gone[curve.lines[e * n + k]] = 1;
      }
      std::ranges::sort(kept);
      for (const CurveEdge& edge : edges_[c]) {
        if (std::ranges::binary_search(kept, std::array{std::min(edge.a, edge.b), std::max(edge.a, edge.b)})) continue;
        const std::size_t e = editor_.reference().edge(CurveId(c), 0.5 * (edge.from + edge.to));
        for (std::size_t k = 0; k < n; ++k) {
          Complex::Line line = complex_.lines[curve.lines[e * n + k]];
          const bool forward = line.ends[0] == curve.chain[e];
          line.ends = forward ? std::array{edge.a, edge.b} : std::array{edge.b, edge.a};
          made.push_back(line);
        }
      }
    }
    for (std::size_t k = 0; k < complex_.lines.size(); ++k)
      if (!gone[k]) lines_.push_back(complex_.lines[k]);
    lines_.insert(lines_.end(), made.begin(), made.end());
  }

  void number_vertices() {
    std::vector<std::uint8_t> used(mesh().n_vertices(), 0);
    for (std::size_t v = 0; v < complex_.n_vertices(); ++v) used[v] = complex_.state[v] != VertexState::kOpen;
    for (std::size_t f = 0; f < mesh().n_faces(); ++f)
      if (mesh().face(FaceId(f)).alive)
        for (const VertexId v : mesh().face(FaceId(f)).v) used[v.value] = 1;
    for (const Complex::Line& line : lines_)
      for (const VertexId v : line.ends) used[v.value] = 1;
    id_.resize(mesh().n_vertices());
    std::size_t n = 0;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v]) id_[v] = VertexId(n++);
  }

  void write_vertex(VertexId v) {
    const LocalVertex& vertex = mesh().vertex(v);
    if (!mesh().is_new(v) && !vertex.moved) {
      out().add_vertex(complex_.position[v.value], complex_.node[v.value], complex_.state[v.value],
                       complex_.vertex_groups[v.value]);
      return;
    }
    out().add_vertex(vertex.position, NodeRef{}, VertexState::kOpen, groups_beneath(v));
  }

  /// Node groups of a new vertex: on each component it lies on, those of all vertices of the edge or
  /// face beneath it.
  GroupSetId groups_beneath(VertexId id) {
    const LocalVertex& v = mesh().vertex(id);
    if (!v.curve.valid()) {
      const FaceId f = beneath_vertex_[id.value];
      return common_groups(complex_.face[f.value], f);
    }
    const auto& chain = brep_.curves[v.curve.value].chain;
    const auto edge = std::span(chain).subspan(editor_.reference().edge(v.curve, v.arc), 2);
    GroupSetId all = GroupSets::kEmpty;
    for (const FaceId f : mesh().star(id)) {
      const FaceId beneath = mesh().sheet(mesh().face(f).sheet).faces.front();
      all = groups_.unite(all, common_groups(edge, beneath));
    }
    return all;
  }

  /// On the components of a face.
  GroupSetId common_groups(std::span<const VertexId> vertices, FaceId f) {
    GroupSetId all = common_groups(vertices, complex_.component[f.value]);
    for (const Complex::Layer& layer : complex_.layers_of(f))
      all = groups_.unite(all, common_groups(vertices, layer.component));
    return all;
  }

  GroupSetId common_groups(std::span<const VertexId> vertices, std::uint32_t component) {
    GroupSetId common = complex_.groups_on(component, vertices.front());
    for (const VertexId v : vertices.subspan(1)) common = groups_.intersect(common, complex_.groups_on(component, v));
    return common;
  }

  void write_faces() {
    for (std::size_t k = 0; k < mesh().n_faces(); ++k) {
      const FaceId f(k);
      const LocalFace& face = mesh().face(f);
      if (!face.alive) continue;
      const std::array<VertexId, 3> v{id_[face.v[0].value], id_[face.v[1].value], id_[face.v[2].value]};
      const FaceId id = out().add_face(v, complex_, beneath_face_[k].face);
      deviation_.add(beneath_face_[k].deviation);
      result_.in_zone.push_back(mesh().is_new(f) ? 1 : in_zone_[k]);
      if (face.in_zone && face.q < editor_.options().min_quality)
        result_.bad.push_back({id, face.q, cause_of(editor_, f)});
    }
    result_.mean_quality = mesh().mean_quality();
  }

  /// How far the mesh is off the reference at most.
  struct Deviation {
    double most = 0, relative = 0;  // over the local edge length
    Vec3 at;                        // of the most

    void add(const Deviation& other) {
      relative = std::max(relative, other.relative);
      if (other.most > most) most = other.most, at = other.at;
    }
  };

  struct Beneath {
    FaceId face;  // of the complex
    Deviation deviation;
  };

  /// Of all vertices and faces that are written; each by itself.
  void find_faces_beneath() {
    beneath_vertex_.resize(mesh().n_vertices()), beneath_face_.resize(mesh().n_faces());
    for_blocks(
        mesh().n_vertices(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t k = first; k < last; ++k) {
            const LocalVertex& v = mesh().vertex(VertexId(k));
            if (id_[k].valid() && (mesh().is_new(VertexId(k)) || v.moved) && !v.curve.valid())
              beneath_vertex_[k] = editor_.reference().project(v.sheet, v.position, v.beneath).face;
          }
        },
        kProjectBlock);
    for_blocks(
        mesh().n_faces(),
        [&](std::size_t first, std::size_t last) {
          for (FaceId f(first); f.value < last; ++f.value)
            if (mesh().face(f).alive) beneath_face_[f.value] = mesh().is_changed(f) ? beneath(f) : Beneath{f, {}};
        },
        kProjectBlock);
  }

  /// The face of the complex beneath the centroid.
  [[nodiscard]] Beneath beneath(FaceId f) const {
    const LocalFace& face = mesh().face(f);
    const Triangle t = mesh().corners(f);
    FaceId hint;
    for (const VertexId v : face.v)
      if (mesh().vertex(v).dimension == Dimension::kSheet) hint = mesh().vertex(v).beneath;
    const Foot foot = editor_.reference().project(face.sheet, centroid(t), hint);
    Beneath result{foot.face, {foot.distance, foot.distance / mean_edge_length(t), centroid(t)}};
    if (!mesh().sheet(face.sheet).planar)
      for (std::size_t k = 0; k < 3; ++k) {
        if (face.curve[k].valid()) continue;
        const Vec3 p = midpoint(t[k], t[(k + 1) % 3]);
        const double d = editor_.reference().project(face.sheet, p, foot.face).distance;
        result.deviation.add({d, d / distance(t[k], t[(k + 1) % 3]), p});
      }
    return result;
  }

  void measure_curves() {
    for (std::size_t c = 0; c < brep_.curves.size(); ++c) {
      if (editor_.reference().polyline(CurveId(c)).empty()) continue;
      for (const CurveEdge& e : edges_[c]) {
        const double d = editor_.reference().sagitta(CurveId(c), e.from, e.to);
        deviation_.add({d, d / editor_.length(e.a, e.b), midpoint(mesh().position(e.a), mesh().position(e.b))});
      }
    }
    result_.max_deviation = deviation_.most, result_.max_deviation_relative = deviation_.relative;
    result_.deviation_at = deviation_.at;
  }

  Editor& editor_;
  const Complex& complex_;
  const Brep& brep_;
  const std::vector<std::uint8_t>& in_zone_;
  GroupSets& groups_;
  std::vector<std::vector<CurveEdge>> edges_;  // by curve
  std::vector<Complex::Line> lines_;           // with vertices of the working mesh
  std::vector<VertexId> id_;                   // by vertex of the working mesh, in the result
  std::vector<FaceId> beneath_vertex_;         // by new vertex of a sheet
  std::vector<Beneath> beneath_face_;          // by face
  Deviation deviation_;
  Remeshed result_;
};

}  // namespace

Remeshed to_remeshed(Editor& editor, const Complex& complex, const Brep& brep, const std::vector<std::uint8_t>& in_zone,
                     GroupSets& groups) {
  return Writer(editor, complex, brep, in_zone, groups).run();
}

}  // namespace meshgraft
