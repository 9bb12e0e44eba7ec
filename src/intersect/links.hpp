// Which symbols are joined by a piece of a junction curve.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "intersect/meeting.hpp"

namespace meshgraft {

/// What has to be imprinted on the faces of one side.
struct Imprint {
  struct OnEdge {
    LocalEdge edge;
    double t = 0;
    VertexId vertex;
    friend auto operator<=>(const OnEdge&, const OnEdge&) = default;
  };
  struct OnFace {
    LocalFace face;
    VertexId vertex;
    friend auto operator<=>(const OnFace&, const OnFace&) = default;
  };
  struct Segment {
    LocalFace face;
    std::array<VertexId, 2> ends;  // (smaller, larger)
    friend auto operator<=>(const Segment&, const Segment&) = default;
  };
  std::vector<OnEdge> on_edges;       // points inside edges, ascending: in order along each edge
  std::vector<OnFace> on_faces;       // points inside faces, ascending
  std::vector<Segment> segments;      // ascending, each once
  std::vector<std::uint8_t> touched;  // by local face: has a symbol
};

/// The points of all symbols on edges and faces, by side; no segments, nothing touched.
[[nodiscard]] std::array<Imprint, 2> collect_points(const Meeting& meeting);

/// The imprint on both sides. Two faces meet in the symbols that both carry; faces being convex,
/// each of these is joined to the next along the line on which they lie.
///
/// Two faces that share area instead, if there are such: symbols off the line, or faces flatter to
/// each other than the contact angle and nearer than the tolerance over more than a strip.
struct SharedArea {
  FacePair faces;
};
tl::expected<std::array<Imprint, 2>, SharedArea> link_symbols(const Meeting& meeting, const CorefineOptions& options);

}  // namespace meshgraft
