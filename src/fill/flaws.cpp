#include "fill/flaws.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "check/face_pairs.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

constexpr int kSamples = 7;       // of a beam beside a face
constexpr double kInside = 0.01;  // weight of a point that is inside a triangle, not on its border

Box box_of(const Triangle& t) {
  Box box;
  for (const Vec3 p : t) box.add(p);
  return box;
}

/// Within `reach` of a triangle, and not beside it.
bool is_inside(Vec3 p, const Triangle& t, double reach) {
  const TrianglePoint foot = closest_on_triangle(p, t);
  return distance(p, foot.point) <= reach && std::ranges::all_of(foot.weight, [](double w) { return w > kInside; });
}

/// A corner or the centroid of one that lies inside of the other, within `reach`.
std::optional<Vec3> lies_on(const Triangle& one, const Triangle& other, double reach) {
  for (const Vec3 p : {one[0], one[1], one[2], centroid(one)})
    if (is_inside(p, other, reach)) return p;
  return {};
}

/// Places of one kind of flaw; an error names the first.
struct Findings {
  std::string what, hint;
  std::vector<std::string> places;
  Place place;

  void add(std::string where, Place in_file) {
    if (places.empty()) place = std::move(in_file);
    places.push_back(std::move(where));
  }
  [[nodiscard]] std::string text() const {
    const std::string others = ", and in " + std::to_string(places.size() - 1) + " more places";
    return "the filling " + what + " " + places.front() + (places.size() > 1 ? others : "");
  }
};

class Flaws {
 public:
  Flaws(const Model& base, const Complex& complex, std::size_t first, std::span<const UnfollowedBeam> unfollowed,
        const Tolerance& tolerance)
      : base_(base), complex_(complex), first_(first), unfollowed_(unfollowed), tolerance_(tolerance) {}

  FillingFlaws run() {
    find_folds();
    find_others();
    FillingFlaws flaws;
    for (const Findings* f : {&folds_, &lying_, &crossing_})
      if (!f->places.empty()) flaws.broken.push_back({ErrorCode::kPromiseBroken, f->text(), f->hint, f->place});
    if (!beams_.places.empty())
      flaws.warnings.push_back({"beam-on-filling", beams_.text() + "; not joined", beams_.place});
    return flaws;
  }

 private:
  using Ids = std::array<std::uint32_t, 3>;

  void find_folds() {
    std::map<std::array<VertexId, 2>, FaceId> one_side;
    for (std::size_t f = first_; f < complex_.n_faces(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(complex_.face[f][k], complex_.face[f][(k + 1) % 3]);
        const auto [it, is_first] = one_side.try_emplace({a, b}, FaceId(f));
        if (!is_first && dot(area_vector(complex_.corners(it->second)), area_vector(complex_.corners(FaceId(f)))) < 0)
          folds_.add(text_of(midpoint(complex_.position[a.value], complex_.position[b.value])), {base_.path, 0});
      }
  }

  /// Corners of a new face as nodes of the base; new vertices count on from these.
  [[nodiscard]] Ids ids_of(std::size_t f) const {
    Ids ids{};
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = complex_.face[f][k];
      const NodeRef n = complex_.node[v.value];
      ids[k] = n.valid() ? n.node.value : static_cast<std::uint32_t>(base_.n_nodes() + v.value);
    }
    return ids;
  }

  void find_others() {
    std::vector<Box> boxes;
    for (std::size_t f = first_; f < complex_.n_faces(); ++f) {
      const Triangle t = complex_.corners(FaceId(f));
      boxes.push_back(box_of(t).grown(tolerance_.at(mean_edge_length(t))));
    }
    const BoxTree tree(boxes);
    for (std::size_t k = 0; k < base_.n_elements(); ++k) {
      const ElementId e(k);
      const Corners c = corners_of(base_.shape(e), base_.nodes_of(e));
      if (c.n == 2) compare_beam(e, {c.node[0], c.node[1]}, tree);
      if (!c.is_surface() || std::ranges::any_of(std::span(c.node).first(c.n), [](NodeId n) { return !n.valid(); }))
        continue;
      for (std::size_t i = 2; i < c.n; ++i) {
        const Ids ids{c.node[0].value, c.node[i - 1].value, c.node[i].value};
        const Triangle t{base_.position[ids[0]], base_.position[ids[1]], base_.position[ids[2]]};
        tree.overlapping(box_of(t), [&](std::uint32_t f) { compare(e, ids, t, first_ + f); });
      }
    }
  }

  void compare(ElementId e, const Ids& ids, const Triangle& t, std::size_t f) {
    const Ids own = ids_of(f);
    const Triangle filled = complex_.corners(FaceId(f));
    const std::string element = "element " + std::to_string(base_.element_label[e.value]) + " at ";
    const bool touches =
        std::ranges::any_of(own, [&](std::uint32_t v) { return std::ranges::find(ids, v) != ids.end(); });
    const double reach = tolerance_.at(std::min(mean_edge_length(t), mean_edge_length(filled)));
    auto at = touches ? std::nullopt : lies_on(t, filled, reach);
    if (!touches && !at) at = lies_on(filled, t, reach);
    if (at)
      lying_.add(element + text_of(*at), place_of(base_, e));
    else if (!base_.is_face(e) && !is_degenerate(ids, t) && meet_beyond_shared(own, filled, ids, t))
      crossing_.add(element + text_of(centroid(t)), place_of(base_, e));
  }

  void compare_beam(ElementId e, const std::array<NodeId, 2>& ends, const BoxTree& tree) {
    if (!ends[0].valid() || !ends[1].valid()) return;
    if (std::ranges::binary_search(unfollowed_, e, {}, &UnfollowedBeam::element)) return;
    const Vec3 a = base_.position[ends[0].value], b = base_.position[ends[1].value];
    if (a == b) return;
    Box box{a, a};
    box.add(b);
    std::optional<Vec3> at;
    tree.overlapping(box, [&](std::uint32_t f) {
      const Triangle t = complex_.corners(FaceId(first_ + f));
      double from = 1, to = 0;  // the part of the beam beside the face
      for (const Vec3 corner : t) {
        const double along = std::clamp(dot(corner - a, b - a) / squared_norm(b - a), 0.0, 1.0);
        from = std::min(from, along), to = std::max(to, along);
      }
      for (int k = 0; k <= kSamples && !at; ++k)
        if (const Vec3 p = lerp(a, b, std::lerp(from, to, double(k) / kSamples));
            is_inside(p, t, tolerance_.at(mean_edge_length(t))))
          at = p;
    });
    if (at)
      beams_.add("element " + std::to_string(base_.element_label[e.value]) + " at " + text_of(*at), place_of(base_, e));
  }

  const Model& base_;
  const Complex& complex_;
  std::size_t first_;
  std::span<const UnfollowedBeam> unfollowed_;
  const Tolerance& tolerance_;
  Findings folds_{"is folded back on itself at", "fill it in smaller parts, or with another --blend", {}, {}};
  Findings beams_{"has 1D elements on it:", {}, {}, {}};
  Findings lying_{
      "lies on", "where a piece of the mesh stands in the hole, fill between both: --contour 2+5, say", {}, {}};
  Findings crossing_{
      "crosses", "split the element into linear triangles and cut the mesh there, or leave the contour open", {}, {}};
};

}  // namespace

FillingFlaws flaws_of(const Model& base, const Complex& complex, std::size_t first,
                      std::span<const UnfollowedBeam> unfollowed, const Tolerance& tolerance) {
  return Flaws(base, complex, first, unfollowed, tolerance).run();
}

}  // namespace meshgraft
