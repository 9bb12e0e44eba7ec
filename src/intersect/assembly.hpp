// A complex whose components are joined one by one, each in a piece cut out around its own junction:
// the cost of a join is that of its surroundings, however many components there are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/buckets.hpp"
#include "intersect/imprint.hpp"

namespace meshgraft {

/// Positions of items (faces, lines) at each vertex.
class ItemsAt {
 public:
  /// `items[i]` are the vertices of item i.
  template <class Item>
  ItemsAt(std::size_t n_vertices, const std::vector<Item>& items);
  void add_vertices(std::size_t n_vertices) { more_.resize(n_vertices); }
  void add(VertexId v, std::uint32_t item) { more_[v.value].push_back(item); }
  /// The items at any of the vertices, ascending.
  [[nodiscard]] std::vector<std::uint32_t> at(std::span<const VertexId> vertices) const;

 private:
  Buckets<std::uint32_t> item_;                   // by vertex that was there from the start
  std::vector<std::vector<std::uint32_t>> more_;  // by vertex: added since
};

/// A part of an Assembly as a complex of its own. Vertices and faces are in the order of the whole.
struct CutOut {
  Complex complex;
  FaceMarks marks;                                    // `from` is the position of each face itself
  std::vector<VertexId> vertex;                       // by vertex here: the one of the whole
  std::vector<std::uint32_t> face, line, fixed_edge;  // by item here: the one of the original complex
};

class Assembly {
 public:
  /// `complex` must outlive this. `size`: by face, its mean edge length.
  Assembly(const Complex& complex, std::span<const double> size);

  /// Moves a vertex, before anything is joined.
  void move(VertexId v, Vec3 to) { whole_.position[v.value] = to; }
  /// A vertex that must stay where it is now.
  void pin(VertexId v) {
    if (VertexState& state = whole_.state[v.value]; state == VertexState::kOpen) state = VertexState::kPinned;
  }

  /// The pieces of the given faces (ascending, of the original complex) and all that share a vertex
  /// with one of them, complete with their lines and fixed edges.
  [[nodiscard]] CutOut around(std::span<const FaceId> faces) const;

  /// What has become of a cut-out: `now` is its complex after a join, `marks` follow the faces. Faces,
  /// lines and fixed edges stand in the order of what they descend from.
  ///   returns   by vertex of `now`: the one of the whole
  std::vector<VertexId> put_back(const CutOut& before, const Complex& now, const FaceMarks& marks);

  /// The whole: pieces stand where their faces stood. `touched`, `kept`: by face, as in Corefined.
  [[nodiscard]] Complex finished(std::vector<std::uint8_t>& touched, std::vector<std::uint8_t>& kept) const;

 private:
  struct Piece {
    std::array<VertexId, 3> corners;
    std::uint8_t touched = 0, kept = 0;
    GroupSetId groups;
    Complex::Layers layers;
    Reach reach;
    std::vector<std::uint32_t> over;
    friend bool operator==(const Piece&, const Piece&) = default;
  };
  static constexpr std::uint32_t kWhole = 0xFFFFFFFF;

  [[nodiscard]] std::vector<Piece> pieces_of(std::uint32_t face) const;
  [[nodiscard]] std::vector<Complex::Line> pieces_of_line(std::uint32_t line) const;
  void set_pieces(std::uint32_t face, std::vector<Piece> pieces);
  void set_pieces_of_line(std::uint32_t line, std::vector<Complex::Line> pieces);

  const Complex& input_;
  Complex whole_;  // its vertices are those of now; its faces and lines as they were
  std::span<const double> size_;
  ItemsAt faces_at_, lines_at_, fixed_at_;
  std::vector<std::uint32_t> cut_face_, cut_line_;  // by face, line: position in the lists below, or kWhole
  std::vector<std::vector<Piece>> face_pieces_;
  std::vector<std::vector<Complex::Line>> line_pieces_;
};

}  // namespace meshgraft
