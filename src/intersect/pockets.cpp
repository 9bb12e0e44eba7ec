#include "intersect/pockets.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/buckets.hpp"
#include "core/distinct.hpp"
#include "core/text.hpp"
#include "core/union_find.hpp"
#include "geometry/closest.hpp"
#include "geometry/quality.hpp"
#include "intersect/meeting.hpp"

namespace meshgraft {
namespace {

constexpr double kNarrow = 0.75;  // share of the edge length up to which a pocket is too narrow for new faces
constexpr double kShallow = 0.2;  // share of its width; a deeper one is a corner that comes through

using Edge = std::array<VertexId, 2>;

/// A piece of one side that the junction bounds.
struct Piece {
  std::vector<FaceId> faces;  // ascending
  std::vector<Edge> walls;    // ascending
  bool is_closed = true;      // every edge of its border is a wall
};

/// Edge length of the finest face.
double least_size(std::span<const double> size, const std::vector<FaceId>& faces) {
  double least = std::numeric_limits<double>::infinity();
  for (const FaceId f : faces) least = std::min(least, size[f.value]);
  return least;
}

class Pockets {
 public:
  Pockets(const Complex& complex, const std::array<std::vector<FaceId>, 2>& sides, std::span<const double> size)
      : complex_(complex), sides_(sides), size_(size) {}

  std::vector<Pocket> find() {
    find_walls();
    std::vector<Pocket> pockets;
    if (walls_.empty()) return pockets;
    std::map<std::vector<Edge>, Piece> first;
    for (Piece& piece : pieces_of(0)) first.emplace(piece.walls, piece);
    for (const Piece& piece : pieces_of(1)) {
      const double wide = width(piece);
      if (wide >= kNarrow * least_size(size_, piece.faces)) continue;
      const auto other = first.find(piece.walls);
      if (other == first.end()) continue;
      const double deep = std::max(depth(piece, other->second), depth(other->second, piece));
      if (deep < kShallow * wide) pockets.push_back({{other->second.faces, piece.faces}, piece.walls, wide, deep});
    }
    return pockets;
  }

 private:
  struct Use {
    Edge edge;
    std::size_t side = 0;
    std::uint32_t face = 0;  // position in the list of the side
    friend auto operator<=>(const Use&, const Use&) = default;
  };

  template <class F>
  void for_each_edge(F&& f) const {
    for (std::size_t first = 0, last = 0; first < uses_.size(); first = last) {
      while (last < uses_.size() && uses_[last].edge == uses_[first].edge) ++last;
      f(std::span(uses_).subspan(first, last - first));
    }
  }

  /// Edges that faces of both sides have.
  void find_walls() {
    Buckets<Use> by_low(complex_.n_vertices(), [&](auto&& add) {
      for (const std::size_t s : kSides)
        for (std::uint32_t i = 0; i < sides_[s].size(); ++i) {
          const auto& v = complex_.face[sides_[s][i].value];
          for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(v[k], v[(k + 1) % 3]);
            add(a.value, Use{{a, b}, s, i});
          }
        }
    });
    for (std::size_t v = 0; v < by_low.size(); ++v) std::ranges::sort(by_low[v]);
    uses_ = std::move(by_low).take_all();
    for_each_edge([&](std::span<const Use> uses) {
      if (uses.front().side != uses.back().side) walls_.push_back(uses.front().edge);
    });
  }

  [[nodiscard]] bool is_wall(const Edge& e) const { return std::ranges::binary_search(walls_, e); }

  /// Those that are closed.
  [[nodiscard]] std::vector<Piece> pieces_of(std::size_t s) const {
    UnionFind joined(sides_[s].size());
    for_each_edge([&](std::span<const Use> uses) {
      if (is_wall(uses.front().edge)) return;
      for (std::size_t i = 1; i < uses.size(); ++i)
        if (uses[i].side == s) joined.unite(uses[i - 1].face, uses[i].face);
    });
    std::map<std::uint32_t, Piece> by_first;
    for (std::uint32_t i = 0; i < sides_[s].size(); ++i) by_first[joined.find(i)].faces.push_back(sides_[s][i]);
    for_each_edge([&](std::span<const Use> uses) {
      for (const Use& use : uses) {
        if (use.side != s) continue;
        Piece& piece = by_first[joined.find(use.face)];
        if (is_wall(use.edge))
          piece.walls.push_back(use.edge);
        else if (uses.size() != 2)
          piece.is_closed = false;
      }
    });
    std::vector<Piece> pieces;
    for (auto& [face, piece] : by_first) {
      make_distinct(piece.walls);
      if (piece.is_closed && !piece.walls.empty()) pieces.push_back(std::move(piece));
    }
    return pieces;
  }

  /// Of a round one the diameter, of a long one twice the width.
  [[nodiscard]] double width(const Piece& piece) const {
    double all = 0, around = 0;
    for (const FaceId f : piece.faces) all += area(complex_.corners(f));
    for (const auto& [a, b] : piece.walls) around += distance(complex_.position[a.value], complex_.position[b.value]);
    return 4 * all / around;
  }

  /// How far the corners of a piece are off the other.
  [[nodiscard]] double depth(const Piece& piece, const Piece& other) const {
    double most = 0;
    for (const FaceId f : piece.faces)
      for (const Vec3 p : complex_.corners(f)) {
        double least = std::numeric_limits<double>::infinity();
        for (const FaceId g : other.faces)
          least = std::min(least, distance(p, closest_on_triangle(p, complex_.corners(g)).point));
        most = std::max(most, least);
      }
    return most;
  }

  const Complex& complex_;
  const std::array<std::vector<FaceId>, 2>& sides_;
  std::span<const double> size_;
  std::vector<Use> uses_;    // ascending
  std::vector<Edge> walls_;  // ascending
};

}  // namespace

std::vector<Pocket> find_pockets(const Complex& complex, const std::array<std::vector<FaceId>, 2>& sides,
                                 std::span<const double> size) {
  return Pockets(complex, sides, size).find();
}

JunctionFault pocket_fault(const Complex& complex, std::span<const double> size, const Pocket& pocket) {
  const auto& [first, second] = pocket.faces;
  return {ErrorCode::kOverlap,
          "two surfaces touch more than they cross: they come through each other by only " + text_of(pocket.depth) +
              ", in a spot " + text_of(pocket.width) + " wide, narrower than the faces there (" +
              text_of(least_size(size, second)) + ")",
          {complex.parent[first.front().value], complex.parent[second.front().value]},
          centroid(complex.corners(second.front())),
          "move the part: deeper in, so that it is joined along a clear line, or away by more than that"};
}

}  // namespace meshgraft
