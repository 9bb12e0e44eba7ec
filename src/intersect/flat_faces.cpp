#include "intersect/flat_faces.hpp"

#include <algorithm>
#include <optional>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

/// The longest side of a face and the corner opposite.
struct Base {
  std::array<VertexId, 2> ends;
  VertexId top;
  double height = 0;
};

Base base_of(const Complex& complex, FaceId f) {
  const auto& v = complex.face[f.value];
  std::size_t longest = 0;
  std::array<double, 3> length{};
  for (std::size_t k = 0; k < 3; ++k) {
    length[k] = distance(complex.position[v[k].value], complex.position[v[(k + 1) % 3].value]);
    if (length[k] > length[longest]) longest = k;
  }
  const auto [low, high] = std::minmax(v[longest], v[(longest + 1) % 3]);
  const double height = length[longest] > 0 ? 2 * area(complex.corners(f)) / length[longest] : 0;
  return {{low, high}, v[(longest + 2) % 3], height};
}

bool has(const std::array<VertexId, 3>& face, VertexId v) { return std::ranges::find(face, v) != face.end(); }

void split_lines(Complex& complex, const Base& base) {
  std::vector<Complex::Line> lines;
  for (const Complex::Line& line : complex.lines) {
    const auto [low, high] = std::minmax(line.ends[0], line.ends[1]);
    lines.push_back(line);
    if (std::array{low, high} != base.ends) continue;
    lines.back().ends[1] = base.top;
    lines.push_back(line);
    lines.back().ends[0] = base.top;
  }
  complex.lines = std::move(lines);
}

/// The complex without face `gone`, the others on its base split at its top.
void take_out(Complex& complex, FaceMarks& marks, std::vector<std::uint8_t>& may_go, FaceId gone, const Base& base) {
  split_lines(complex, base);
  Complex old;
  complex.swap_faces(old);
  FaceMarks now;
  std::vector<std::uint8_t> may;
  for (std::size_t f = 0; f < old.face.size(); ++f) {
    if (f == gone.value) continue;
    const auto add = [&](const std::array<VertexId, 3>& v) {
      complex.add_face(v, old, FaceId(f));
      now.add(marks, f);
      may.push_back(may_go[f]);
    };
    const auto& v = old.face[f];
    if (!has(v, base.ends[0]) || !has(v, base.ends[1]) || has(v, base.top)) {
      add(v);
      continue;
    }
    for (const VertexId end : base.ends) {
      auto piece = v;
      std::ranges::replace(piece, end, base.top);
      add(piece);
    }
  }
  marks = std::move(now), may_go = std::move(may);
}

}  // namespace

void take_out_flat_faces(Complex& complex, FaceMarks& marks, std::vector<std::uint8_t>& may_go, double height) {
  for (std::size_t f = 0; f < complex.n_faces();) {
    const FaceId face(f);
    const std::optional<Base> base = may_go[f] ? std::optional(base_of(complex, face)) : std::nullopt;
    if (!base || base->height > height) {
      ++f;
      continue;
    }
    take_out(complex, marks, may_go, face, *base);
    f = 0;  // pieces may be flat too; each step takes one corner out of a finite number of lines
  }
}

}  // namespace meshgraft
