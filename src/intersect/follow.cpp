#include "intersect/follow.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

// Shares of the way of the neighbour. Those that ease slopes stop short of the other mesh, on which they would lie.
constexpr std::array kFollowing{0.5, 1.0}, kEasing{0.5, 0.75};
constexpr double kSteep = 0.5;  // cosine of the angle between a face and its input face from which it is steep

/// What may move, and what must not become of faces.
struct Rules {
  std::function<Triangle(FaceId)> input;                    // its input face, where that was before anything was moved
  std::function<bool(FaceId)> may_bend;                     // with any of its vertices
  std::function<bool(std::span<const FaceId>)> may_follow;  // a vertex, by its faces, which may all bend
  std::array<double, 2> shares{};
  double least_cosine = 0;  // of the angle between a face and its input face
};

class Follower {
 public:
  Follower(Complex& complex, const Rules& rules, std::vector<std::pair<VertexId, Vec3>>& moved)
      : complex_(complex), rules_(rules), moved_(moved) {}

  [[nodiscard]] bool is_astray(FaceId f) const {
    const Vec3 now = area_vector(complex_.corners(f)), was = area_vector(rules_.input(f));
    return dot(now, was) < rules_.least_cosine * norm(now) * norm(was);
  }

  void run(const std::vector<FaceId>& astray) {
    if (astray.empty()) return;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      for (const VertexId v : complex_.face[f]) faces_at_[v].emplace_back(f);
    for (const FaceId f : astray)
      for (const VertexId v : complex_.face[f.value])
        if (is_astray(f) && may_follow(v)) follow(f, v);
  }

 private:
  [[nodiscard]] bool may_follow(VertexId v) const {
    const std::vector<FaceId>& faces = faces_at_.at(v);
    return complex_.state[v.value] == VertexState::kOpen && std::ranges::all_of(faces, rules_.may_bend) &&
           rules_.may_follow(faces);
  }

  /// How far a vertex was drawn off the planes that its faces had.
  [[nodiscard]] Vec3 way(VertexId v) const {
    Vec3 longest;
    for (const FaceId f : faces_at_.at(v)) {
      if (!rules_.may_bend(f)) continue;
      const Triangle input = rules_.input(f);
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
      if (!is_astray(g)) upright.push_back(g);
    const Vec3 from = complex_.position[v.value], so_far = way(v);
    for (const double share : rules_.shares) {
      if (share * norm(longest) <= norm(so_far)) continue;
      complex_.position[v.value] = from - so_far + share * longest;
      if (is_astray(f) || std::ranges::any_of(upright, [&](FaceId g) { return is_astray(g); })) continue;
      moved_.emplace_back(v, from);
      return;
    }
    complex_.position[v.value] = from;
  }

  Complex& complex_;
  const Rules& rules_;
  std::vector<std::pair<VertexId, Vec3>>& moved_;
  std::map<VertexId, std::vector<FaceId>> faces_at_;
};

}  // namespace

void let_neighbours_follow(Complex& complex, const FaceMarks& marks, std::span<const std::uint8_t> is_drawn,
                           std::vector<std::pair<VertexId, Vec3>>& moved) {
  const Rules rules{[&](FaceId f) { return marks.input[f.value]; }, [&](FaceId f) { return is_drawn[f.value] != 0; },
                    [](std::span<const FaceId>) { return true; }, kFollowing, 0};
  Follower follower(complex, rules, moved);
  std::vector<FaceId> turned;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    if (is_drawn[f] != 0 && follower.is_astray(FaceId(f))) turned.emplace_back(f);
  follower.run(turned);
}

std::vector<std::pair<VertexId, Vec3>> ease_slopes(Corefined& corefined, const Complex& original) {
  if (corefined.moves.empty() && corefined.covered.empty()) return {};
  Complex& complex = corefined.complex;
  std::vector<std::pair<ElementRef, FaceId>> faces;
  for (std::size_t f = 0; f < original.n_faces(); ++f) faces.emplace_back(original.parent[f], FaceId(f));
  std::ranges::sort(faces);
  const auto input = [&](FaceId f) {
    const ElementRef parent = complex.parent[f.value];
    return original.corners(std::ranges::lower_bound(faces, parent, {}, &std::pair<ElementRef, FaceId>::first)->second);
  };
  const auto may_bend = [&](FaceId f) {
    return complex.layers_of(f).empty() && (corefined.kept.empty() || corefined.kept[f.value] == 0);
  };
  const auto is_of_one = [&](std::span<const FaceId> at) {
    return std::ranges::all_of(
        at, [&](FaceId f) { return complex.component[f.value] == complex.component[at.front().value]; });
  };
  const Rules rules{input, may_bend, is_of_one, kEasing, kSteep};
  std::vector<std::pair<VertexId, Vec3>> moved;
  Follower follower(complex, rules, moved);
  std::vector<FaceId> steep;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    if (corefined.touched[f] != 0 && may_bend(FaceId(f)) && follower.is_astray(FaceId(f))) steep.emplace_back(f);
  follower.run(steep);
  return moved;
}

}  // namespace meshgraft
