// A complex with its holes closed.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/complex.hpp"
#include "fill/unfollowed.hpp"
#include "meshgraft/fill.hpp"
#include "remesh/remesh.hpp"

namespace meshgraft {

/// A contour in the complex around it.
struct Rim {
  std::vector<VertexId> vertices;  // in the order of the contour
  std::vector<FaceId> faces;       // of the side to the next vertex
};

/// An opening, by the rims that bound it together.
using Hole = std::vector<Rim>;

/// From its vertex k to the next one.
[[nodiscard]] double side_length(const Complex& c, const Rim& rim, std::size_t k);

/// A piece of a hole that is filled by itself.
using Region = std::vector<std::vector<VertexId>>;  // closed chains with what is open on the left, as in Opening

/// The hole in one piece.
[[nodiscard]] Region region_of(const Hole& hole);
[[nodiscard]] double length_of(const Complex& c, const Hole& hole);
/// Area vector of the polygons through the vertices.
[[nodiscard]] Vec3 area_of(const Complex& c, const Hole& hole);

/// The two nodes of the input that an edge joins, the smaller first.
using NodePair = std::array<NodeRef, 2>;
[[nodiscard]] NodePair nodes_of(const Complex& c, VertexId a, VertexId b);

/// 1D elements that are not to be followed, and why.
using LeftOut = std::map<NodePair, Obstacle>;

/// Faces are those around, then the patches.
struct Patched {
  Complex complex;
  std::size_t n_around = 0;           // faces around
  std::vector<std::uint32_t> patch;   // by face after those: which it is of
  std::vector<std::uint8_t> in_zone;  // by face: it is of a patch
  std::set<NodePair> beams;           // edges of patches that follow 1D elements
  std::vector<UnfollowedBeam> unfollowed;
};

/// A hole that cannot be closed along the surface, and why.
struct NotClosed {
  std::size_t hole = 0;
  std::string why;
};

/// Numbers of the patches that faces from `first` on are of: those that hang together over edges that are no beams.
[[nodiscard]] std::vector<std::uint32_t> patches_of(const Complex& complex, std::size_t first,
                                                    const std::set<NodePair>& beams);

/// Closes the holes with as few faces as possible, along the 1D elements in them (see follow_beams); a hole that cannot
/// be closed along them, without them. Each hole takes its attributes from the face that stands for the greatest part
/// of its rims, and the groups that all faces of these share.
[[nodiscard]] tl::expected<Patched, NotClosed> patched(const Complex& around, std::span<const Hole> holes,
                                                       const LeftOut& left_out, GroupSets& groups);

}  // namespace meshgraft
