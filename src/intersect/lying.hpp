// Two sides that lie on each other: which edges of each have to be imprinted on the other, and the
// symbols of where they come to lie there (face/face mode of the paper, 2.4 and 4).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "intersect/contact.hpp"
#include "intersect/imprint.hpp"
#include "intersect/meeting.hpp"

namespace meshgraft {

/// A meeting of sides that lie on each other. In contact the surface of side `stays` remains; the
/// faces of the other side go, and what is left of it is joined to the first along the border.
struct LyingMeeting {
  Meeting meeting;
  ContactRule rule;
  std::size_t stays = 0;
  /// True if groups and attributes of the side that goes are taken over, so that borders between them
  /// have to be imprinted too.
  bool takes_over = true;

  std::span<const Reach> reach;      // by face of the complex; empty: there is none
  std::span<const Triangle> unbent;  // by face of the complex, see unbent_faces()

  std::vector<FacePair> pairs;                                // that lie on each other, ascending
  std::array<std::vector<std::uint8_t>, 2> is_flat;           // by local face: flat to a face of the other side near it
  std::array<std::vector<std::uint8_t>, 2> in_contact;        // by local face
  std::array<std::vector<std::uint8_t>, 2> border_edge;       // by local edge: where it crosses one of the other
                                                              // side there is a node
  std::array<std::vector<std::uint8_t>, 2> imprinted_edge;    // by local edge: followed over the other side; all
                                                              // are border edges
  std::array<std::vector<std::uint8_t>, 2> imprinted_vertex;  // by vertex
  std::array<std::vector<LocalFace>, 2> cover_face;           // faces of `cover`, by position there
  std::array<Cover, 2> cover;                                 // the faces in contact, by side

  /// Pieces of imprinted edges that both sides have, (smaller, larger): what separates the area of
  /// contact from the rest.
  std::vector<std::array<VertexId, 2>> walls;
  std::array<std::vector<Imprint::Segment>, 2> segments;

  /// Of the side that stays: folds between faces in contact, by local edge, which are lines of its surface also where
  /// faces of one surface may be folded more than the sharp angle (see Overlayer). What is imprinted beside them lies
  /// on them, and runs to their vertices where the fold is no feature.
  std::vector<std::uint8_t> fold_edge{}, fold_vertex{};

  /// Of Sides. They end on a mesh that goes through both sides, and go along it to where it meets the other side: where
  /// that curves, not straight across.
  std::span<const VertexId> rims{};

  [[nodiscard]] std::size_t goes() const { return 1 - stays; }
  [[nodiscard]] bool is_fold(std::size_t s, LocalEdge e) const { return s == stays && fold_edge[e] != 0; }
  [[nodiscard]] bool is_fold(std::size_t s, VertexId v) const { return s == stays && fold_vertex[v.value] != 0; }
  [[nodiscard]] Vec3 at(std::size_t s, VertexId v) const { return meeting.chart[s][v.value]; }
  [[nodiscard]] Triangle triangle(std::size_t s, LocalFace f) const {
    const auto& c = meeting.side[s].corners(f);
    return {at(s, c[0]), at(s, c[1]), at(s, c[2])};
  }
  /// Of a face as it lay before it was bent.
  [[nodiscard]] Vec3 normal(std::size_t s, LocalFace f) const {
    return unit_normal(unbent[meeting.side[s].face(f).value]);
  }
  /// Edge length that lengths at a pair of faces are measured by.
  [[nodiscard]] double size(std::size_t s, LocalFace f) const { return meeting.size[meeting.side[s].face(f).value]; }
};

/// Sets `cover` and `cover_face` of a side.
void build_cover(LyingMeeting& lying, std::size_t s);

/// Marks the edges and vertices to imprint. Of the side that goes: borders of the area of contact,
/// features, and, if it takes over, borders of groups and attributes. Of the side that stays: features
/// where its surface ends.
void find_imprinted(LyingMeeting& lying);

/// True if an edge separates groups, attributes or components of the faces in contact.
[[nodiscard]] bool is_border_of_groups(const LyingMeeting& lying, std::size_t s, LocalEdge e);
/// True if a vertex is an end of such an edge.
[[nodiscard]] bool is_on_border_of_groups(const LyingMeeting& lying, std::size_t s, VertexId v);
/// A vertex in a node group that none of its neighbours is in: a point of its own.
[[nodiscard]] bool is_single_group_node(const LyingMeeting& lying, std::size_t s, VertexId v);

/// Declares where imprinted vertices lie on the other side, and where border edges of the two cross.
void declare_lying(LyingMeeting& lying);

/// A new vertex where an edge of each side, or an edge and a vertex, lie on each other.
///   at   its place in the surface of each side
std::uint32_t add_on_edges(LyingMeeting& lying, const std::array<Carrier, 2>& on, const std::array<Vec3, 2>& at);

/// Follows each imprinted edge over the faces of the other side: further symbols, segments, walls.
/// Gives a place where that is not possible.
std::optional<JunctionFault> trace_imprinted(LyingMeeting& lying);

}  // namespace meshgraft
