#include "intersect/flat_faces.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

using Corners = std::array<VertexId, 3>;
using Edge = std::array<VertexId, 2>;

Edge edge_of(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

class FlatFaces {
 public:
  FlatFaces(Complex& complex, FaceMarks& marks, std::span<const double> height, double none)
      : complex_(complex), marks_(marks), none_(none), may_go_on_(complex.n_vertices()) {
    for (std::uint32_t f = 0; f < complex.n_faces(); ++f) {
      pieces_.push_back({complex.face[f], f, height[f]});
      if (height[f] < 0) continue;
      open_.push_back(f);
      for (const VertexId v : complex.face[f]) may_go_on_[v.value] = 1;
    }
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) each_edge(i, [&](const Edge& e) { at_edge_[e].push_back(i); });
  }

  void run() {
    bool any = false;
    // Each step takes a corner out of a finite number of lines, or makes the worst face there better.
    while (!open_.empty()) {
      const std::uint32_t i = open_.back();
      open_.pop_back();
      if (pieces_[i].is_gone) continue;
      const Base base = base_of(pieces_[i].corners);
      if (base.height > pieces_[i].height || has_no_length(base)) continue;
      const std::vector<std::uint32_t> beside = others_at(base, i);
      if (const auto longer = longer_line(base, beside)) {
        open_.insert(open_.end(), {i, *longer});
        continue;
      }
      if (base.height > none_ && !is_better_without(i, beside, base)) continue;
      any = true;
      split_lines(base);
      take_out(i);
      for (const std::uint32_t other : beside) split(other, base);
    }
    if (any) rebuild();
  }

 private:
  struct Piece {
    Corners corners;
    std::uint32_t of = 0;  // face
    double height = 0;     // up to which it may go
    bool is_gone = false;
  };

  /// The longest side of a face and the corner opposite.
  struct Base {
    Edge ends;
    VertexId top;
    double height = 0;
  };

  [[nodiscard]] Vec3 at(VertexId v) const { return complex_.position[v.value]; }
  [[nodiscard]] Triangle triangle(const Corners& v) const { return {at(v[0]), at(v[1]), at(v[2])}; }

  [[nodiscard]] Base base_of(const Corners& v) const {
    std::size_t longest = 0;
    std::array<double, 3> length{};
    for (std::size_t k = 0; k < 3; ++k) {
      length[k] = distance(at(v[k]), at(v[(k + 1) % 3]));
      if (length[k] > length[longest]) longest = k;
    }
    const double height = length[longest] > 0 ? 2 * area(triangle(v)) / length[longest] : 0;
    return {edge_of(v[longest], v[(longest + 1) % 3]), v[(longest + 2) % 3], height};
  }

  /// Two corners in one place: without the face, its neighbour across the base would be such a one, and so on around
  /// the corner without end.
  [[nodiscard]] bool has_no_length(const Base& base) const {
    return std::ranges::any_of(base.ends, [&](VertexId end) { return distance(at(end), at(base.top)) <= none_; });
  }

  /// The edges of a piece that may be the base of a face that goes.
  template <class F>
  void each_edge(std::uint32_t i, F&& f) const {
    const Corners& v = pieces_[i].corners;
    for (std::size_t k = 0; k < 3; ++k)
      if (may_go_on_[v[k].value] && may_go_on_[v[(k + 1) % 3].value]) f(edge_of(v[k], v[(k + 1) % 3]));
  }

  /// The other pieces on the base that have not its top already.
  [[nodiscard]] std::vector<std::uint32_t> others_at(const Base& base, std::uint32_t i) const {
    std::vector<std::uint32_t> others;
    for (const std::uint32_t other : at_edge_.at(base.ends))
      if (other != i && std::ranges::find(pieces_[other].corners, base.top) == pieces_[other].corners.end())
        others.push_back(other);
    return others;
  }

  /// Of faces that are lines the longest goes first: to split one at a corner of a shorter one leaves two lines
  /// again, and so on without end.
  [[nodiscard]] std::optional<std::uint32_t> longer_line(const Base& base,
                                                         std::span<const std::uint32_t> beside) const {
    const auto length = [&](const Base& b) { return distance(at(b.ends[0]), at(b.ends[1])); };
    for (const std::uint32_t other : beside) {
      if (pieces_[other].height < 0) continue;
      const Base of_other = base_of(pieces_[other].corners);
      if (of_other.height <= none_ && length(of_other) > length(base)) return other;
    }
    return std::nullopt;
  }

  [[nodiscard]] static std::array<Corners, 2> parts_of(const Corners& face, const Base& base) {
    std::array parts{face, face};
    for (const std::size_t k : kSides) std::ranges::replace(parts[k], base.ends[k], base.top);
    return parts;
  }

  /// Q of a face, 0 if it is turned over against a normal.
  [[nodiscard]] double quality(const Corners& v, Vec3 normal) const {
    return dot(area_vector(triangle(v)), normal) > 0 ? aspect_ratio(triangle(v)) : 0;
  }

  [[nodiscard]] bool is_better_without(std::uint32_t i, std::span<const std::uint32_t> beside, const Base& base) const {
    double before = aspect_ratio(triangle(pieces_[i].corners)), after = 1;
    for (const std::uint32_t other : beside) {
      const Corners& v = pieces_[other].corners;
      before = std::min(before, aspect_ratio(triangle(v)));
      for (const Corners& part : parts_of(v, base)) after = std::min(after, quality(part, area_vector(triangle(v))));
    }
    return after > before;
  }

  void split_lines(const Base& base) {
    std::vector<Complex::Line> lines;
    for (const Complex::Line& line : complex_.lines) {
      lines.push_back(line);
      if (edge_of(line.ends[0], line.ends[1]) != base.ends) continue;
      lines.back().ends[1] = base.top;
      lines.push_back(line);
      lines.back().ends[0] = base.top;
    }
    complex_.lines = std::move(lines);
  }

  void take_out(std::uint32_t i) {
    each_edge(i, [&](const Edge& e) { std::erase(at_edge_.at(e), i); });
    pieces_[i].is_gone = true;
  }

  void split(std::uint32_t i, const Base& base) {
    take_out(i);
    for (const Corners& part : parts_of(pieces_[i].corners, base)) {
      const auto now = static_cast<std::uint32_t>(pieces_.size());
      pieces_.push_back({part, pieces_[i].of, pieces_[i].height});
      each_edge(now, [&](const Edge& e) { at_edge_[e].push_back(now); });
      if (pieces_[now].height >= 0) open_.push_back(now);
    }
  }

  void rebuild() {
    std::erase_if(pieces_, [](const Piece& p) { return p.is_gone; });
    std::ranges::stable_sort(pieces_, {}, &Piece::of);
    Complex old;
    complex_.swap_faces(old);
    FaceMarks marks;
    for (const Piece& p : pieces_) {
      complex_.add_face(p.corners, old, FaceId(std::size_t{p.of}));
      marks.add(marks_, p.of);
    }
    marks_ = std::move(marks);
  }

  Complex& complex_;
  FaceMarks& marks_;
  double none_;
  std::vector<std::uint8_t> may_go_on_;  // by vertex: it is a corner of a face that may go
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> open_;  // pieces to look at
  std::map<Edge, std::vector<std::uint32_t>> at_edge_;
};

}  // namespace

void take_out_flat_faces(Complex& complex, FaceMarks& marks, std::span<const double> height, double none) {
  FlatFaces(complex, marks, height, none).run();
}

}  // namespace meshgraft
