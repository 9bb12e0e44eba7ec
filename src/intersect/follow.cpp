#include "intersect/follow.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr std::array kShares{0.5, 1.0};  // of the way of the neighbour

class Follower {
 public:
  Follower(Complex& complex, const FaceMarks& marks, std::span<const std::uint8_t> is_drawn,
           std::vector<std::pair<VertexId, Vec3>>& moved)
      : complex_(complex), marks_(marks), is_drawn_(is_drawn), moved_(moved) {}

  void run() {
    std::vector<FaceId> turned;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      if (is_drawn_[f] != 0 && is_turned(FaceId(f))) turned.emplace_back(f);
    if (turned.empty()) return;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      for (const VertexId v : complex_.face[f]) faces_at_[v].emplace_back(f);
    for (const FaceId f : turned)
      for (const VertexId v : complex_.face[f.value])
        if (is_turned(f) && may_follow(v)) follow(f, v);
  }

 private:
  [[nodiscard]] bool is_turned(FaceId f) const {
    return dot(area_vector(complex_.corners(f)), area_vector(marks_.input[f.value])) < 0;
  }

  [[nodiscard]] bool may_follow(VertexId v) const {
    return complex_.state[v.value] == VertexState::kOpen &&
           std::ranges::all_of(faces_at_.at(v), [&](FaceId f) { return is_drawn_[f.value] != 0; });
  }

  /// How far a vertex was drawn off the planes that its faces had.
  [[nodiscard]] Vec3 way(VertexId v) const {
    Vec3 longest;
    for (const FaceId f : faces_at_.at(v)) {
      if (is_drawn_[f.value] == 0) continue;
      const Triangle& input = marks_.input[f.value];
      const Vec3 n = unit_normal(input);
      const Vec3 off = dot(n, complex_.position[v.value] - input[0]) * n;
      if (norm(off) > norm(longest)) longest = off;
    }
    return longest;
  }

  void follow(FaceId f, VertexId v) {
    Vec3 longest;
    for (const VertexId w : complex_.face[f.value])
      if (const Vec3 other = way(w); w != v && norm(other) > norm(longest)) longest = other;
    std::vector<FaceId> upright;
    for (const FaceId g : faces_at_.at(v))
      if (!is_turned(g)) upright.push_back(g);
    const Vec3 from = complex_.position[v.value];
    for (const double share : kShares) {
      complex_.position[v.value] = from + share * longest;
      if (is_turned(f) || std::ranges::any_of(upright, [&](FaceId g) { return is_turned(g); })) continue;
      moved_.emplace_back(v, from);
      return;
    }
    complex_.position[v.value] = from;
  }

  Complex& complex_;
  const FaceMarks& marks_;
  std::span<const std::uint8_t> is_drawn_;
  std::vector<std::pair<VertexId, Vec3>>& moved_;
  std::map<VertexId, std::vector<FaceId>> faces_at_;
};

}  // namespace

void let_neighbours_follow(Complex& complex, const FaceMarks& marks, std::span<const std::uint8_t> is_drawn,
                           std::vector<std::pair<VertexId, Vec3>>& moved) {
  Follower(complex, marks, is_drawn, moved).run();
}

}  // namespace meshgraft
