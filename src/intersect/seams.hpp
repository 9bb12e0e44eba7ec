// Open seams: free edges and their ends on one side that are no farther apart than the tolerance and a
// hundredth of the edge length, without a common vertex. Where the other side meets such a place, all of them get the
// vertex of the junction there.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "intersect/meeting.hpp"

namespace meshgraft {

/// The widths of the open seams of both sides. Cost n log n in the free edges.
[[nodiscard]] SeamWidths seam_widths(const Meeting& meeting);

/// Asks for the symbols of a meeting that seams share. Sees those that were added since.
class Seams {
 public:
  explicit Seams(Meeting& meeting);

  /// The symbol within the snap length of p that lies on a face at the carrier `other` of the other side, and on side s
  /// on another border of the seam than `own`; the first. Nothing if `own` is on no free edge.
  [[nodiscard]] std::optional<std::uint32_t> find(std::size_t s, const Carrier& own, const Carrier& other, Vec3 p);

  /// The symbol within the snap length of p in which other borders of both seams meet, where `on` are borders of seams
  /// that cross; the first.
  [[nodiscard]] std::optional<std::uint32_t> find_crossing(Vec3 p, const std::array<Carrier, 2>& on);

  /// A symbol at p with these carriers, not yet added: at such a symbol, or with a new vertex.
  Symbol shared_or_new(Vec3 p, const std::array<Carrier, 2>& on);

  /// The vertex w of side s becomes that of a symbol. False if faces on it may be missing.
  bool close(std::size_t s, VertexId w, std::uint32_t symbol);

  /// Vertices on borders of seams become those of the symbols that are near on another border.
  void close_at_symbols();

  /// A vertex on one border of a seam is on the free edges of its other borders too, unless a face of its own side is
  /// between them.
  void declare_edges_at_vertices();

 private:
  [[nodiscard]] bool is_on_border(std::size_t s, const Carrier& on) const;
  [[nodiscard]] double width(std::size_t s, const Carrier& a, const Carrier& b) const;
  [[nodiscard]] bool ends_in(std::size_t s, const Carrier& own, VertexId v) const;
  [[nodiscard]] bool is_filled(std::size_t s, VertexId v, LocalEdge e) const;
  void note(std::size_t s, const Carrier& on, VertexId v);
  void index_new_symbols();

  Meeting& m_;
  std::array<std::vector<std::uint8_t>, 2> on_free_edge_;  // by side and vertex
  /// By side on a border of which they lie, and face of the other side.
  std::map<std::pair<std::size_t, LocalFace>, std::vector<std::uint32_t>> symbols_;
  std::multimap<double, std::uint32_t> crossings_;  // symbols on free edges of both sides, by the x of their places
  std::size_t n_indexed_ = 0;
};

}  // namespace meshgraft
