// Two sides that meet: which faces come near each other, and the symbols of where they do.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "geometry/quality.hpp"
#include "intersect/corefine.hpp"
#include "intersect/side.hpp"

namespace meshgraft {

/// What a symbol lies on, on one side: the vertex, the inside of an edge or the inside of a face.
struct Carrier {
  enum Kind : std::uint8_t { kVertex, kEdge, kFace } kind = kVertex;
  std::uint32_t id = 0;  // VertexId, LocalEdge or LocalFace
  double t = 0;          // on an edge: from its smaller end (0) to the larger (1)
};

/// A point that both sides have; what it is comes first, its coordinates are those of the vertex.
struct Symbol {
  VertexId vertex;
  std::array<Carrier, 2> on;  // by side
};

/// Side 0 is everything joined so far and keeps its vertices, side 1 the component that is added.
inline constexpr std::array<std::size_t, 2> kSides{0, 1};

/// Cosine of an edge to the normal of a surface, up to which it runs along that; steeper ones end there or go through.
inline constexpr double kAlong = 0.5;

/// Of two edges that run along a surface from an acute corner, `ways` (unit) and its normals there: whether the first
/// is the one that leaves it, as the slope of a gusset leaves the wall that its upright edge ends on.
[[nodiscard]] inline bool leaves_at_corner(const std::array<Vec3, 2>& way, const std::array<Vec3, 2>& normal) {
  constexpr double kOneWall = 0.85;  // cosine
  constexpr double kSteeper = 0.1;   // sine to the surface, more than that of the other
  return dot(way[0], way[1]) > 0 && std::abs(dot(normal[0], normal[1])) >= kOneWall &&
         std::abs(dot(way[0], normal[0])) > std::abs(dot(way[1], normal[1])) + kSteeper;
}

/// A face of each side.
using FacePair = std::array<LocalFace, 2>;

/// Lengths below which two things are one place, for a pair of faces.
struct Snap {
  double feature = 0;  // the user's tolerance, where features attract what is near
  double weld = 0;     // everything else
  double asked = 0;    // the tolerance in full, as far as free edges are extended
  [[nodiscard]] double of(bool is_feature) const { return is_feature ? feature : weld; }
};

/// How lengths follow from the sizes of faces.
class SnapRule {
 public:
  /// `largest_coordinate`, by magnitude: what rounding costs follows from it.
  SnapRule(double largest_coordinate, const CorefineOptions& options, bool features);
  /// `size`: the smaller of the mean edge lengths of the two input faces.
  [[nodiscard]] Snap at(double size) const;
  /// A vertex nearer than this to where it should be is there.
  [[nodiscard]] double noise() const { return noise_; }

 private:
  CorefineOptions options_;
  bool features_;
  double rounding_, noise_;
};

/// How far below and above a face, along its normal, the faces lay that it stands for: a mesh on one of them lies
/// on the face too, although it is farther from it than the gap.
struct Reach {
  double low = 0, high = 0;
  [[nodiscard]] Reach turned() const { return {-high, -low}; }
  void add(const Reach& other) { low = std::min(low, other.low), high = std::max(high, other.high); }
  friend bool operator==(const Reach&, const Reach&) = default;
};

/// Features that end on the other side or run along it: corners, and edges with both ends near it, with these; so do
/// other lines of the mesh (Side::is_line_edge). A line that goes through the other side meets it in one point, which
/// need not be a vertex of it: that has no claim to be met although it is near.
struct EndingFeatures {
  std::array<std::vector<std::uint8_t>, 2> vertex, edge;  // by side and vertex, local edge
};

/// How far the borders of open seams are apart, 0 where there is none. What meets such a seam between its borders, or
/// beside it no farther away, meets both: nothing fits between.
struct SeamWidths {
  std::array<std::vector<double>, 2> vertex, edge;  // by side and vertex, local edge
};

struct Meeting {
  Complex& complex;
  GroupSets& groups;
  std::span<const double> size;         // by face of the complex: mean edge length of its input face
  std::span<const std::uint8_t> exact;  // by face of the complex: 1 if no gap is closed there; may be empty
  SnapRule rule;
  std::array<Side, 2> side;
  std::vector<FacePair> pairs;  // ascending

  std::vector<Symbol> symbols;
  std::array<std::vector<std::uint32_t>, 2> symbol_of;  // by side and vertex: the first; kNowhere if none
  std::vector<std::array<std::uint32_t, 2>> next;       // by symbol and side: the next of the same vertex there
  /// By side and vertex: where it lies in the surface of that side, if the sides keep a distance. Faces
  /// are cut there. Empty: at its position on both sides.
  std::array<std::vector<Vec3>, 2> chart;
  std::set<std::array<LocalEdge, 2>> crossed_edges;  // pairs of edges with a symbol inside both
  std::vector<std::array<VertexId, 2>> replaced;     // vertex of side 1, of side 0 that it became
  std::vector<std::pair<VertexId, Vec3>> moved;      // vertex of side 1, where it was
  std::vector<Corefined::JoinedSeam> seams;          // see Seams
  std::vector<std::array<Vec3, 2>> sewn;             // see Corefined; set by apply()
  bool has_closed_gap = false;                       // side 1 bends by more than the weld length

  /// Vertices with a free edge along the other side that is beyond the tolerance at its other end: only another edge
  /// makes them end there.
  std::span<const VertexId> half_reached{};
  /// Vertices that were moved before, as free edges were extended, and where they were.
  const std::map<VertexId, Vec3>* extended_from = nullptr;
  bool ends_on_borders = false;  // see CorefineOptions
  EndingFeatures ending{};       // within the snap length; set by declare_vertices()
  SeamWidths seams_of{};         // set by declare_vertices()

  [[nodiscard]] Vec3 at(VertexId v) const { return complex.position[v.value]; }
  /// Where it was before free edges were extended.
  [[nodiscard]] Vec3 at_first(VertexId v) const {
    if (extended_from == nullptr) return at(v);
    const auto from = extended_from->find(v);
    return from == extended_from->end() ? at(v) : from->second;
  }
  [[nodiscard]] Triangle triangle(std::size_t s, LocalFace f) const { return complex.corners(side[s].face(f)); }
  [[nodiscard]] Snap snap(const FacePair& p) const;
  [[nodiscard]] std::span<const Vec3> surface(std::size_t s) const {
    return chart[s].empty() ? std::span<const Vec3>(complex.position) : std::span<const Vec3>(chart[s]);
  }
  [[nodiscard]] bool has_symbol(std::size_t s, VertexId v) const { return symbol_of[s][v.value] != kNowhere; }
  /// Whether a vertex was made for a symbol; it is on neither side.
  [[nodiscard]] bool is_new(VertexId v) const { return v.value >= symbol_of[0].size(); }

  /// True if some symbol of a vertex of side s is so.
  template <class F>
  [[nodiscard]] bool any_symbol(std::size_t s, VertexId v, F&& is) const {
    for (std::uint32_t i = symbol_of[s][v.value]; i != kNowhere; i = next[i][s])
      if (is(symbols[i])) return true;
    return false;
  }

  /// True if the symbol lies on the edge or its ends; on the face, its edges or its corners.
  [[nodiscard]] bool on_edge(const Symbol& symbol, std::size_t s, LocalEdge e) const {
    return on_edge(symbol.on[s], s, e);
  }
  [[nodiscard]] bool on_edge(const Carrier& on, std::size_t s, LocalEdge e) const;
  [[nodiscard]] bool on_face(const Symbol& symbol, std::size_t s, LocalFace f) const;

  /// True if some symbol lies on both the edge of side s and the face of the other.
  [[nodiscard]] bool meet(std::size_t s, LocalEdge e, LocalFace f) const;

  /// True if an end of one edge was declared to lie on the other edge; e of side 0, f of side 1.
  [[nodiscard]] bool share_end(LocalEdge e, LocalEdge f) const;

  std::uint32_t add(const Symbol& symbol);
  /// A new vertex where edges cross, or an edge and a face.
  VertexId new_vertex(Vec3 p, const std::array<Carrier, 2>& on);
  /// The vertex lies on a carrier of side s: on each component there it is in the node groups that
  /// all corners of the carrier have on that component.
  void join_groups(VertexId v, std::size_t s, const Carrier& on);
};

/// Pairs of faces of `first` and `second` (ascending) that come nearer than twice their snap length
/// elsewhere than in vertices that they share.
std::vector<std::array<FaceId, 2>> near_pairs(const Complex& complex, std::span<const FaceId> first,
                                              std::span<const FaceId> second, std::span<const double> size,
                                              const SnapRule& rule);

/// Meeting of two sets of faces, without symbols yet. `beside`: further faces of the first and the second
/// that may be cut with them, ascending.
Meeting make_meeting(Complex& complex, GroupSets& groups, std::span<const double> size,
                     std::span<const std::uint8_t> exact, const SnapRule& rule,
                     std::span<const std::array<FaceId, 2>> pairs, std::span<const std::uint8_t> is_first,
                     std::span<const std::uint8_t> is_second, const FeatureRule& features,
                     const std::array<std::vector<FaceId>, 2>& beside = {});

/// `within`: which length counts as near. Cost: one pass over the pairs.
[[nodiscard]] EndingFeatures ending_features(const Meeting& meeting, double Snap::*within);

/// True if boxes grown by a gap show that two segments (or points) are farther apart than it. Most
/// are, and this is much cheaper than their distance.
[[nodiscard]] bool are_apart(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double gap);

/// Declares vertices that both sides have already, from an earlier round or another component.
void declare_shared(Meeting& meeting);
/// Declares vertices that are on the other side, in order of dimension, and moves those of side 1.
void declare_vertices(Meeting& meeting);
/// Declares edges that pass each other.
void declare_edges(Meeting& meeting);
/// Finds edges that go through faces, by exact signs.
void find_crossings(Meeting& meeting);

}  // namespace meshgraft
