#include "merge/trim.hpp"

#include <algorithm>
#include <map>

#include "core/union_find.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "merge/edges.hpp"

namespace meshgraft {
namespace {

using Edge = std::array<VertexId, 2>;

struct Piece {
  std::vector<FaceId> faces;     // ascending
  std::vector<VertexId> inside;  // that it shares with no other piece
  std::vector<Edge> border;      // junction edges it ends on
  bool has_free_edge = false;
  bool is_cut_off = true;  // behind each edge of the border its part goes on
  bool is_held = false;    // by something other than its faces
};

class Trimmer {
 public:
  Trimmer(const Corefined& corefined, double length)
      : complex_(corefined.complex),
        length_(length),
        borders_(corefined.junction_edges),
        piece_of_(pieces_of(complex_, borders_)) {
    collect_faces();
    collect_edges();
    collect_vertices();
    find_holds();
  }

  /// By face: 1 if it is in a loose end.
  [[nodiscard]] std::vector<std::vector<FaceId>> loose_ends() const {
    std::vector<std::uint32_t> loose;
    for (const auto& [id, piece] : pieces_)
      if (is_loose(piece)) loose.push_back(id);
    std::vector<std::vector<FaceId>> ends;
    for (const std::uint32_t id : loose)
      if (std::ranges::none_of(behind_.at(id), [&](std::uint32_t b) { return std::ranges::binary_search(loose, b); }))
        ends.push_back(pieces_.at(id).faces);
    return ends;
  }

 private:
  void collect_faces() {
    const Joins& joins = complex_.joins;
    for (std::uint32_t f = 0; f < piece_of_.size(); ++f)
      if (joins.mesh_of(complex_.component[f]) != joins.mesh_of(0)) pieces_[piece_of_[f]].faces.emplace_back(f);
  }

  void collect_edges() {
    const std::vector<FaceOnEdge> uses = edge_uses(complex_);
    for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
      const Edge ends{edge[0].low, edge[0].high};
      const bool is_border = std::ranges::binary_search(borders_, ends);
      for (const FaceOnEdge& use : edge) {
        const auto at = pieces_.find(piece_of_[use.face.value]);
        if (at == pieces_.end()) continue;
        if (edge.size() == 1) at->second.has_free_edge = true;
        if (!is_border) continue;
        at->second.border.push_back(ends);
        bool goes_on = false;
        for (const FaceOnEdge& other : edge) {
          const std::uint32_t piece = piece_of_[other.face.value];
          if (piece == at->first || complex_.component[other.face.value] != complex_.component[use.face.value])
            continue;
          behind_[at->first].push_back(piece);
          goes_on = true;
        }
        if (!goes_on) at->second.is_cut_off = false;
      }
    });
  }

  void collect_vertices() {
    constexpr std::uint32_t kNone = 0xFFFFFFFF, kSeveral = kNone - 1;
    only_.assign(complex_.n_vertices(), kNone);
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      for (const VertexId v : complex_.face[f]) {
        std::uint32_t& piece = only_[v.value];
        if (piece == kNone) piece = piece_of_[f];
        if (piece != piece_of_[f]) piece = kSeveral;
      }
    for (std::size_t v = 0; v < only_.size(); ++v)
      if (const auto at = pieces_.find(only_[v]); at != pieces_.end()) {
        at->second.inside.emplace_back(v);
        if (complex_.state[v] != VertexState::kOpen) at->second.is_held = true;
      }
  }

  /// 1D elements that end on a piece and do not lie on its edges.
  void find_holds() {
    if (complex_.lines.empty()) return;
    const std::vector<FaceOnEdge> uses = edge_uses(complex_);
    for (const Complex::Line& line : complex_.lines) {
      const auto [low, high] = std::minmax(line.ends[0], line.ends[1]);
      const auto at = std::ranges::lower_bound(uses, FaceOnEdge{low, high, FaceId(std::size_t{0})});
      if (at != uses.end() && at->low == low && at->high == high) continue;
      for (const VertexId v : line.ends)
        if (const auto piece = pieces_.find(only_[v.value]); piece != pieces_.end()) piece->second.is_held = true;
    }
  }

  [[nodiscard]] bool is_loose(const Piece& p) const {
    return !p.border.empty() && p.has_free_edge && p.is_cut_off && !p.is_held && is_one_line(p.border) && is_near(p);
  }

  [[nodiscard]] bool is_one_line(std::span<const Edge> border) const {
    UnionFind sets(border.size());
    std::map<VertexId, std::uint32_t> first;
    for (std::uint32_t e = 0; e < border.size(); ++e)
      for (const VertexId v : border[e]) sets.unite(first.try_emplace(v, e).first->second, e);
    for (std::uint32_t e = 0; e < border.size(); ++e)
      if (sets.find(e) != 0) return false;
    return true;
  }

  [[nodiscard]] bool is_near(const Piece& p) const {
    std::vector<Box> boxes(p.border.size());
    for (std::size_t e = 0; e < boxes.size(); ++e)
      for (const VertexId v : p.border[e]) boxes[e].add(complex_.position[v.value]);
    const BoxTree tree(boxes);
    return std::ranges::all_of(p.inside, [&](VertexId v) {
      const Vec3 at = complex_.position[v.value];
      const auto squared_distance = [&](std::uint32_t e) {
        const auto& [a, b] = p.border[e];
        return squared_norm(at - closest_on_segment(at, complex_.position[a.value], complex_.position[b.value]).point);
      };
      return tree.nearest(at, squared_distance).squared_distance < length_ * length_;
    });
  }

  const Complex& complex_;
  double length_;
  std::span<const Edge> borders_;
  std::vector<std::uint32_t> piece_of_;                         // by face
  std::map<std::uint32_t, Piece> pieces_;                       // of parts
  std::map<std::uint32_t, std::vector<std::uint32_t>> behind_;  // by piece: those of its part across its border
  std::vector<std::uint32_t> only_;                             // by vertex: the piece it is in, if there is only one
};

}  // namespace

std::vector<DroppedEntry> trim(Corefined& corefined, double length, const Graft& graft, Dropped& dropped) {
  std::vector<DroppedEntry> entries;
  std::vector<std::uint8_t> marked(corefined.complex.n_faces());
  for (const std::vector<FaceId>& faces : Trimmer(corefined, length).loose_ends()) {
    for (const FaceId f : faces) marked[f.value] = 1;
    entries.push_back(entry_of(corefined.complex, faces, graft.group_sets, graft.groups));
    entries.back().cause = "trimmed";
  }
  if (!entries.empty()) drop_faces(corefined, marked, graft.group_sets, graft.groups.size(), dropped);
  return entries;
}

}  // namespace meshgraft
