#include "cut/sides.hpp"

#include <algorithm>
#include <map>

#include "geometry/predicates.hpp"
#include "geometry/quality.hpp"
#include "merge/edges.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

/// An open tool: sides follow from the order of faces around each edge of the cut.
class OpenTool {
 public:
  OpenTool(const BasePieces& pieces, const Corefined& corefined, std::uint32_t component)
      : pieces_(pieces), complex_(corefined.complex), component_(component), sides_(pieces.n, ToolSide::kUnknown) {
    const std::vector<FaceOnEdge> uses = edge_uses(complex_);
    for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
      const std::array<VertexId, 2> ends{edge[0].low, edge[0].high};
      if (std::ranges::binary_search(corefined.junction_edges, ends)) look_at(edge);
      note_border(edge);
    });
  }

  Result<std::vector<ToolSide>> run(const std::string& name) {
    if (through_.empty()) return std::move(sides_);
    return failure(ErrorCode::kNotSeparated,
                   name + " does not cut all the way: it ends inside the base at " + text_of(end_of_cut()),
                   "extend the tool beyond the base there, or close it", {name, 0});
  }

 private:
  [[nodiscard]] VertexId apex(const FaceOnEdge& use) const {
    for (const VertexId v : complex_.face[use.face.value])
      if (v != use.low && v != use.high) return v;
    return {};
  }

  /// +1 if the vertex is on the side of the face to which its normal points. Exact.
  [[nodiscard]] int side_of_face(const FaceOnEdge& tool, VertexId v) const {
    const Triangle t = complex_.corners(tool.face);
    return orientation_sign(t[0], t[1], t[2], complex_.position[v.value]);
  }

  /// The side of the tool on which a vertex lies, seen from an edge with one or two faces of the tool.
  [[nodiscard]] ToolSide side(std::span<const FaceOnEdge> tool, VertexId v) const {
    int sign = side_of_face(tool[0], v);
    if (tool.size() == 2) {
      const int other = side_of_face(tool[1], v), fold = side_of_face(tool[0], apex(tool[1]));
      // Beyond a ridge it is enough to be outside of one face; in a valley it takes both.
      if (fold < 0) sign = std::max(sign, other);
      if (fold > 0) sign = std::min(sign, other);
    }
    return sign > 0 ? ToolSide::kOutside : sign < 0 ? ToolSide::kInside : ToolSide::kUnknown;
  }

  void look_at(std::span<const FaceOnEdge> edge) {
    std::vector<FaceOnEdge> tool;
    for (const FaceOnEdge& use : edge)
      if (complex_.component[use.face.value] == component_) tool.push_back(use);
    std::map<std::uint32_t, ToolSide> here;  // by piece
    for (const FaceOnEdge& use : edge) {
      if (complex_.component[use.face.value] == component_) continue;
      const ToolSide s = side(tool, apex(use));
      const std::uint32_t piece = pieces_.of_face[use.face.value];
      const auto [at, fresh] = here.try_emplace(piece, s);
      if (!fresh && at->second != s) through_.push_back({edge[0].low, edge[0].high});
      if (sides_[piece] == ToolSide::kUnknown)
        sides_[piece] = s;
      else if (s != ToolSide::kUnknown && s != sides_[piece])
        through_.push_back({edge[0].low, edge[0].high});
    }
  }

  void note_border(std::span<const FaceOnEdge> edge) {
    const auto n = std::ranges::count_if(
        edge, [&](const FaceOnEdge& u) { return complex_.component[u.face.value] != component_; });
    if (n == 1) border_.push_back(edge[0].low), border_.push_back(edge[0].high);
  }

  /// Where the edges that do not separate come to an end inside the base; else on one of them.
  [[nodiscard]] Vec3 end_of_cut() {
    std::ranges::sort(border_);
    std::map<VertexId, int> uses;
    std::ranges::sort(through_);
    through_.erase(std::ranges::unique(through_).begin(), through_.end());
    for (const auto& [a, b] : through_) ++uses[a], ++uses[b];
    for (const auto& [v, n] : uses)
      if (n == 1 && !std::ranges::binary_search(border_, v)) return complex_.position[v.value];
    const auto& [a, b] = through_.front();
    return midpoint(complex_.position[a.value], complex_.position[b.value]);
  }

  const BasePieces& pieces_;
  const Complex& complex_;
  std::uint32_t component_;
  std::vector<ToolSide> sides_;                   // by piece
  std::vector<std::array<VertexId, 2>> through_;  // edges of the cut with one piece on both sides
  std::vector<VertexId> border_;                  // on free edges of the base
};

/// Groups of that name, as a set.
std::vector<std::uint8_t> groups_named(const Model& base, const std::string& name) {
  std::vector<std::uint8_t> is_one(base.groups.size());
  for (std::size_t g = 0; g < is_one.size(); ++g) is_one[g] = base.groups[g].name == name ? 1 : 0;
  return is_one;
}

Result<std::vector<std::uint8_t>> pieces_of_group(const Model& base, const BasePieces& pieces, const Complex& complex,
                                                  const std::vector<ToolSide>& sides, const std::string& tool,
                                                  const std::string& name) {
  const std::vector<std::uint8_t> wanted = groups_named(base, name);
  if (std::ranges::count(wanted, 1) == 0)
    return failure(ErrorCode::kUsage, "there is no group " + name + " in " + base.path,
                   "meshgraft info -v lists all groups", {base.path, 0});
  const auto is_member = [&](ElementId e) {
    return std::ranges::any_of(base.group_sets.members(base.element_groups[e.value]),
                               [&](GroupId g) { return wanted[g.value] != 0; });
  };
  std::vector<std::uint8_t> goes(pieces.n);
  bool inside = false, outside = false;
  const auto look_at = [&](std::uint32_t piece, ElementId e) {
    if (piece == BasePieces::kNone || pieces.touched[piece] == 0 || !is_member(e)) return;
    goes[piece] = 1;
    (sides[piece] == ToolSide::kInside ? inside : outside) = true;
  };
  for (std::size_t f = 0; f < complex.n_faces(); ++f) look_at(pieces.of_face[f], complex.parent[f].element);
  for (std::size_t e = 0; e < base.n_elements(); ++e) look_at(pieces.of_element[e], ElementId(e));
  if (inside && outside)
    return failure(ErrorCode::kUsage, "group " + name + " has faces on both sides of " + tool,
                   "name a group that lies on the side to be dropped, or give inside or outside");
  if (!inside && !outside)
    return failure(ErrorCode::kUsage, "group " + name + " has no face in a piece that " + tool + " cuts off",
                   "name a group that has faces there, or give inside or outside");
  if (std::ranges::find(goes, 0) == goes.end())
    return failure(
        ErrorCode::kPartsApart,
        "group " + name + " has faces in all pieces of " + base.path + ", so that all of it would be dropped",
        "check the place, the size and the units of the tool", {base.path, 0});
  return goes;
}

}  // namespace

std::vector<ToolSide> sides_of_closed(const BasePieces& pieces, const TriangleSurface& tool) {
  std::vector<ToolSide> sides;
  for (const Vec3 p : pieces.place) sides.push_back(tool.contains(p) ? ToolSide::kInside : ToolSide::kOutside);
  return sides;
}

Result<std::vector<ToolSide>> sides_of_open(const BasePieces& pieces, const Corefined& corefined,
                                            std::uint32_t component, const std::string& name) {
  return OpenTool(pieces, corefined, component).run(name);
}

Result<std::vector<std::uint8_t>> dropped_pieces(const Model& base, const BasePieces& pieces, const Complex& complex,
                                                 const std::vector<ToolSide>& sides, const std::string& tool,
                                                 const Drop& drop) {
  if (drop.what == Drop::What::kGroup) return pieces_of_group(base, pieces, complex, sides, tool, drop.group);
  const bool inside = drop.what == Drop::What::kInside;
  std::vector<std::uint8_t> goes(pieces.n);
  for (std::size_t p = 0; p < goes.size(); ++p)
    goes[p] = sides[p] == (inside ? ToolSide::kInside : ToolSide::kOutside) ? 1 : 0;
  const auto n = static_cast<std::uint32_t>(std::ranges::count(goes, 1));
  if (n > 0 && n < pieces.n) return goes;
  const std::string where = inside ? "inside" : "outside";
  return failure(ErrorCode::kPartsApart,
                 n == 0 ? "nothing of " + base.path + " is " + where + " of " + tool
                        : "all of " + base.path + " is " + where + " of " + tool + " and would be dropped",
                 "check the place, the size and the units of the tool", {base.path, 0});
}

}  // namespace meshgraft
