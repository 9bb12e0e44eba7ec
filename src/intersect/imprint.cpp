#include "intersect/imprint.hpp"

#include <algorithm>
#include <tuple>

#include "core/blocks.hpp"
#include "geometry/quality.hpp"
#include "intersect/cut_face.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kCutBlock = 256;  // faces cut in one go

/// The part of an ascending list whose field `key` equals `value`.
template <class T, class K>
std::span<const T> range_of(const std::vector<T>& list, K T::*key, K value) {
  const auto first = std::lower_bound(list.begin(), list.end(), value, [&](const T& a, K v) { return a.*key < v; });
  const auto last = std::upper_bound(first, list.end(), value, [&](K v, const T& a) { return v < a.*key; });
  return {first, last};
}

class Imprinter {
 public:
  Imprinter(Meeting& m, const std::array<Imprint, 2>& imprint) : m_(m), imprint_(imprint), by_(m.complex.n_vertices()) {
    for (std::size_t v = 0; v < by_.size(); ++v) by_[v] = VertexId(v);
    for (const auto& [y, x] : m.replaced) by_[y.value] = x;
  }

  std::optional<ImprintFault> run(FaceMarks& marks) {
    if (auto fault = check_fixed_edges()) return fault;
    split_lines();
    find_sewn();
    return rebuild_faces(marks);
  }

 private:
  /// Points inside the edge between two vertices, from the first on; the edge as it was before the
  /// meeting. An edge may be one of both sides, and of faces of neither: all take the same points.
  [[nodiscard]] std::vector<VertexId> points_on(VertexId from, VertexId to) const {
    std::vector<std::pair<double, VertexId>> found;
    for (const std::size_t s : kSides)
      if (const LocalEdge e = m_.side[s].find(from, to); e != kNowhere)
        for (const Imprint::OnEdge& p : range_of(imprint_[s].on_edges, &Imprint::OnEdge::edge, e))
          found.emplace_back(p.t, p.vertex);
    std::sort(found.begin(), found.end());
    std::vector<VertexId> points;
    for (const auto& [t, v] : found)
      if (std::find(points.begin(), points.end(), v) == points.end()) points.push_back(v);
    if (to < from) std::reverse(points.begin(), points.end());
    return points;
  }

  std::optional<ImprintFault> check_fixed_edges() {
    for (auto& edge : m_.complex.fixed_edges) {
      for (const std::size_t s : kSides) {
        const LocalEdge e = m_.side[s].find(edge[0], edge[1]);
        if (e == kNowhere) continue;
        const std::vector<VertexId> points = points_on(edge[0], edge[1]);
        if (points.empty()) continue;
        const FaceId f = m_.side[s].face(m_.side[s].faces_at_edge(e)[0]);
        return ImprintFault{{ErrorCode::kUnsupportedElement,
                             "an edge of an element that cannot be remeshed meets another mesh",
                             {m_.complex.parent[f.value]},
                             m_.at(points[0])},
                            {}};
      }
      edge = {by_[edge[0].value], by_[edge[1].value]};
      std::sort(edge.begin(), edge.end());
    }
    return std::nullopt;
  }

  void split_lines() {
    std::vector<Complex::Line> lines;
    for (const Complex::Line& line : m_.complex.lines) {
      const std::vector<VertexId> chain = chain_on(line.ends[0], line.ends[1]);
      for (std::size_t i = 1; i < chain.size(); ++i)
        lines.push_back({{chain[i - 1], chain[i]}, line.parent, line.groups, line.attributes});
    }
    m_.complex.lines = std::move(lines);
  }

  /// The ends of the pieces of an edge.
  [[nodiscard]] std::vector<VertexId> chain_on(VertexId from, VertexId to) const {
    std::vector<VertexId> chain{by_[from.value]};
    const std::vector<VertexId> points = points_on(from, to);
    chain.insert(chain.end(), points.begin(), points.end());
    chain.push_back(by_[to.value]);
    return chain;
  }

  void find_sewn() {
    using Piece = std::tuple<VertexId, VertexId, std::uint32_t>;  // its ends, ascending, and the component
    for (const Side& side : m_.side) {
      std::vector<Piece> pieces;
      for (LocalEdge e = 0; e < side.n_edges(); ++e) {
        if (!side.is_free(e)) continue;
        const std::vector<VertexId> chain = chain_on(side.ends(e)[0], side.ends(e)[1]);
        const std::uint32_t component = m_.complex.component[side.face(side.faces_at_edge(e).front()).value];
        for (std::size_t i = 1; i < chain.size(); ++i) {
          const auto [low, high] = std::minmax(chain[i - 1], chain[i]);
          pieces.emplace_back(low, high, component);
        }
      }
      std::ranges::sort(pieces);
      for (auto at = pieces.begin(); (at = std::adjacent_find(at, pieces.end())) != pieces.end(); ++at)
        m_.sewn.push_back({m_.at(std::get<0>(*at)), m_.at(std::get<1>(*at))});
    }
  }

  [[nodiscard]] FaceToCut face_to_cut(std::size_t s, LocalFace f) const {
    FaceToCut face;
    const auto& corners = m_.side[s].corners(f);
    for (std::size_t k = 0; k < 3; ++k) {
      face.corner[k] = by_[corners[k].value];
      face.on_edge[k] = points_on(corners[k], corners[(k + 1) % 3]);
    }
    for (const auto& p : range_of(imprint_[s].on_faces, &Imprint::OnFace::face, f)) face.inside.push_back(p.vertex);
    for (const auto& p : range_of(imprint_[s].segments, &Imprint::Segment::face, f)) face.segments.push_back(p.ends);
    return face;
  }

  /// A face that is not near the other side, with the points on the edges that it shares with those
  /// that are.
  [[nodiscard]] FaceToCut beside(const std::array<VertexId, 3>& corners) const {
    FaceToCut face;
    for (std::size_t k = 0; k < 3; ++k) {
      face.corner[k] = by_[corners[k].value];
      face.on_edge[k] = points_on(corners[k], corners[(k + 1) % 3]);
    }
    return face;
  }

  [[nodiscard]] ImprintFault fault(FaceId id) const {
    const Triangle t = m_.complex.corners(id);
    const double longest = std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
    const bool flat = area(t) <= 0.5 * longest * m_.rule.at(m_.size[id.value]).weld;
    return {{flat ? ErrorCode::kDegenerateFace : ErrorCode::kJunctionNotResolved,
             flat ? "a face without area meets another mesh" : "a face cannot be cut along the junction",
             {m_.complex.parent[id.value]},
             centroid(t)},
            id};
  }

  /// The part that a face has in the meeting.
  struct Role {
    std::size_t side = kSides.size();  // beside both
    LocalFace face = kNowhere;
  };

  [[nodiscard]] std::vector<Role> roles() const {
    std::vector<Role> of(m_.complex.n_faces());
    for (const std::size_t s : kSides)
      for (LocalFace f = 0; f < m_.side[s].n_faces(); ++f) of[m_.side[s].face(f).value] = {s, f};
    return of;
  }

  using Pieces = std::optional<std::vector<std::array<VertexId, 3>>>;

  /// What becomes of each face.
  [[nodiscard]] std::vector<Pieces> cut_all(std::span<const Role> role) const {
    std::vector<Pieces> pieces(role.size());
    const auto cut_one = [&](std::size_t f) {
      const auto [s, local] = role[f];
      if (local == kNowhere) return cut(beside(m_.complex.face[f]), m_.complex.position);
      return cut(face_to_cut(s, local), m_.surface(s));
    };
    for_blocks(
        role.size(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t f = first; f < last; ++f) pieces[f] = cut_one(f);
        },
        kCutBlock);
    return pieces;
  }

  std::optional<ImprintFault> rebuild_faces(FaceMarks& marks) {
    const std::vector<Role> role = roles();
    const std::vector<Pieces> pieces = cut_all(role);
    if (const auto uncut = std::ranges::find_if(pieces, [](const Pieces& p) { return !p; }); uncut != pieces.end())
      return fault(FaceId(static_cast<std::size_t>(uncut - pieces.begin())));
    Complex& c = m_.complex;
    Complex old;  // the lists of faces as they were
    c.swap_faces(old);
    FaceMarks now;
    for (std::size_t f = 0; f < old.face.size(); ++f) {
      const auto [s, local] = role[f];
      const bool is_near = local != kNowhere;
      for (const auto& v : *pieces[f]) {
        c.add_face(v, old, FaceId(f));
        now.add(marks, f);
        now.touched.back() = marks.touched[f] || (is_near && imprint_[s].touched[local]);
        now.active.back() = is_near;
      }
    }
    marks = std::move(now);
    return std::nullopt;
  }

  Meeting& m_;
  const std::array<Imprint, 2>& imprint_;
  std::vector<VertexId> by_;  // by vertex: itself or its replacement
};

}  // namespace

std::vector<Triangle> unbent_faces(const Complex& complex, const FaceMarks& marks, const SnapRule& snap) {
  std::vector<Triangle> faces;
  faces.reserve(complex.n_faces());
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    Triangle t = complex.corners(FaceId(f));
    const Triangle& input = marks.input[f];
    const Vec3 n = unit_normal(input);
    const auto height = [&](Vec3 p) { return dot(n, p - input[0]); };
    const double weld = snap.at(marks.size[f]).weld;
    if (std::ranges::any_of(t, [&](Vec3 p) { return std::abs(height(p)) > weld; }))
      for (Vec3& p : t) p -= height(p) * n;
    faces.push_back(t);
  }
  return faces;
}

std::optional<ImprintFault> apply(Meeting& meeting, const std::array<Imprint, 2>& imprint, FaceMarks& marks) {
  return Imprinter(meeting, imprint).run(marks);
}

}  // namespace meshgraft
