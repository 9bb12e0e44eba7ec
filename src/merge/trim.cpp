#include "merge/trim.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "core/union_find.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "geometry/quality.hpp"
#include "intersect/extend.hpp"
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

struct LooseEnd {
  std::vector<FaceId> faces;  // ascending
  VertexId tip;               // farthest from the line that cuts it off
  double length = 0;          // from that line to the tip
};

using IsShort = std::function<bool(const LooseEnd&)>;

class Trimmer {
 public:
  Trimmer(const Complex& original, const Corefined& corefined, IsShort is_short)
      : original_(original),
        complex_(corefined.complex),
        is_short_(std::move(is_short)),
        borders_(corefined.junction_edges),
        piece_of_(pieces_of(complex_, borders_)) {
    collect_faces();
    collect_edges();
    collect_vertices();
    find_holds();
  }

  [[nodiscard]] std::vector<LooseEnd> loose_ends() const {
    std::map<std::uint32_t, LooseEnd> loose;
    for (const auto& [id, piece] : pieces_) {
      if (!can_be_loose(piece)) continue;
      const auto [tip, length] = farthest(piece);
      LooseEnd end{piece.faces, tip, length};
      if (is_short_(end)) loose.emplace(id, std::move(end));
    }
    std::vector<LooseEnd> ends;
    for (const auto& [id, end] : loose)
      if (std::ranges::none_of(behind_.at(id), [&](std::uint32_t b) { return loose.contains(b); })) ends.push_back(end);
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
        if (is_held(v)) at->second.is_held = true;
      }
  }

  /// By the input; the junction pins vertices in which a free edge turns.
  [[nodiscard]] bool is_held(std::size_t v) const {
    const std::vector<VertexState>& state = v < original_.n_vertices() ? original_.state : complex_.state;
    return state[v] != VertexState::kOpen;
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

  [[nodiscard]] static bool can_be_loose(const Piece& p) {
    return !p.border.empty() && p.has_free_edge && p.is_cut_off && !p.is_held && is_one_line(p.border);
  }

  [[nodiscard]] static bool is_one_line(std::span<const Edge> border) {
    UnionFind sets(border.size());
    std::map<VertexId, std::uint32_t> first;
    for (std::uint32_t e = 0; e < border.size(); ++e)
      for (const VertexId v : border[e]) sets.unite(first.try_emplace(v, e).first->second, e);
    for (std::uint32_t e = 0; e < border.size(); ++e)
      if (sets.find(e) != 0) return false;
    return true;
  }

  /// The vertex of a piece that is farthest from its border, and how far; invalid and 0 if it has no vertex of its own.
  [[nodiscard]] std::pair<VertexId, double> farthest(const Piece& p) const {
    std::vector<Box> boxes(p.border.size());
    for (std::size_t e = 0; e < boxes.size(); ++e)
      for (const VertexId v : p.border[e]) boxes[e].add(complex_.position[v.value]);
    const BoxTree tree(boxes);
    std::pair<VertexId, double> found{{}, 0};
    for (const VertexId v : p.inside) {
      const Vec3 at = complex_.position[v.value];
      const auto squared_distance = [&](std::uint32_t e) {
        const auto& [a, b] = p.border[e];
        return squared_norm(at - closest_on_segment(at, complex_.position[a.value], complex_.position[b.value]).point);
      };
      const double d = std::sqrt(tree.nearest(at, squared_distance).squared_distance);
      if (d > found.second) found = {v, d};
    }
    return found;
  }

  const Complex& original_;
  const Complex& complex_;
  IsShort is_short_;
  std::span<const Edge> borders_;
  std::vector<std::uint32_t> piece_of_;                         // by face
  std::map<std::uint32_t, Piece> pieces_;                       // of parts
  std::map<std::uint32_t, std::vector<std::uint32_t>> behind_;  // by piece: those of its part across its border
  std::vector<std::uint32_t> only_;                             // by vertex: the piece it is in, if there is only one
};

/// How near points are to what a component is to be joined with. The tree is made when it is first asked.
class Neighbours {
 public:
  explicit Neighbours(const Complex& complex) : complex_(complex) {}

  [[nodiscard]] bool are_within(double length, Vec3 p, std::uint32_t component) {
    if (tree_.empty()) tree_ = tree_of(complex_);
    const auto squared_distance = [&](std::uint32_t f) {
      if (!complex_.joins.are_joined(complex_.component[f], component)) return std::numeric_limits<double>::infinity();
      return squared_norm(p - closest_on_triangle(p, complex_.corners(FaceId(std::size_t{f}))).point);
    };
    return tree_.nearest(p, squared_distance, length * length).found();
  }

 private:
  static BoxTree tree_of(const Complex& complex) {
    std::vector<Box> boxes(complex.n_faces());
    for (std::size_t f = 0; f < boxes.size(); ++f)
      for (const Vec3 p : complex.corners(FaceId(f))) boxes[f].add(p);
    return BoxTree(boxes);
  }

  const Complex& complex_;
  BoxTree tree_;
};

}  // namespace

std::vector<DroppedEntry> trim(const Complex& original, Corefined& corefined, double length, const Graft& graft,
                               Dropped& dropped) {
  std::vector<DroppedEntry> entries;
  std::vector<std::uint8_t> marked(corefined.complex.n_faces());
  const auto is_short = [&](const LooseEnd& end) { return end.length < length; };
  for (const LooseEnd& end : Trimmer(original, corefined, is_short).loose_ends()) {
    for (const FaceId f : end.faces) marked[f.value] = 1;
    entries.push_back(entry_of(corefined.complex, end.faces, graft.group_sets, graft.groups));
    entries.back().cause = "trimmed";
  }
  if (!entries.empty()) drop_faces(corefined, marked, graft.group_sets, graft.groups.size(), dropped);
  return entries;
}

std::vector<Warning> loose_end_warnings(const Outcome& outcome, const Tolerance& tolerance) {
  const Inputs inputs = outcome.inputs;
  const Complex& complex = outcome.corefined.complex;
  Neighbours neighbours(complex);
  const auto is_short = [&](const LooseEnd& end) {
    if (!end.tip.valid()) return false;
    double allowed = 0;
    for (const FaceId f : end.faces) {
      const ElementRef parent = complex.parent[f.value];
      allowed = std::max(allowed, tolerance.at(mean_edge_length(inputs[parent.input]->corners(parent.element))));
    }
    return end.length <= kLongestWay * allowed &&
           neighbours.are_within(allowed, complex.position[end.tip.value], complex.component[end.faces.front().value]);
  };
  std::map<std::uint32_t, std::vector<LooseEnd>> of_input;
  for (LooseEnd& end : Trimmer(outcome.original, outcome.corefined, is_short).loose_ends())
    of_input[complex.parent[end.faces.front().value].input].push_back(std::move(end));
  std::vector<Warning> warnings;
  for (const auto& [input, ends] : of_input) {
    const LooseEnd& longest = *std::ranges::max_element(ends, {}, &LooseEnd::length);
    const std::string more = ends.size() == 1   ? ""
                             : ends.size() == 2 ? ", and another no farther"
                                                : ", and " + std::to_string(ends.size() - 1) + " others no farther";
    warnings.push_back({"sticks-out",
                        "an end of " + inputs[input]->path + " sticks out beyond the junction by " +
                            text_of(longest.length) + " at " + text_of(complex.position[longest.tip.value]) + more +
                            "; its depth is within the tolerance, but too great for its faces to be drawn back; "
                            "--trim beyond with a greater length drops it",
                        place_of(*inputs[input], complex.parent[longest.faces.front().value].element)});
  }
  return warnings;
}

}  // namespace meshgraft
