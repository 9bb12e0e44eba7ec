#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "fill/steepness.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/plane.hpp"
#include "geometry/quality.hpp"
#include "meshgraft/fill.hpp"

namespace meshgraft {
namespace {

class Nesting {
 public:
  Nesting(const Model& model, std::span<const Contour> contours) : model_(model), contours_(contours) {
    for (const Contour& c : contours) {
      Box& box = boxes_.emplace_back();
      for (const NodeId n : c.nodes) box.add(at(n)), normal_[n] = {};
    }
    for (std::size_t e = 0; e < model.n_elements(); ++e) {
      if (!model.is_face(ElementId(e))) continue;
      for (const NodeId n : model.nodes_of(ElementId(e)))
        if (const auto it = normal_.find(n); it != normal_.end())
          it->second += area_vector(model.corners(ElementId(e)));
    }
    for (auto& [n, normal] : normal_) normal = normalized(normal);
  }

  std::vector<OpeningContours> run() {
    std::vector<OpeningContours> openings;
    for (std::size_t k = 0; k < contours_.size(); ++k)
      if (contours_[k].is_hole && contours_[k].is_fillable) openings.push_back({k});
    for (std::size_t k = 0; k < contours_.size(); ++k) {
      if (contours_[k].is_hole || !contours_[k].is_fillable) continue;
      OpeningContours* innermost = nullptr;  // contours are sorted by length
      for (OpeningContours& o : openings)
        if (stands_in(k, o.front())) innermost = &o;
      if (innermost != nullptr) innermost->push_back(k);
    }
    return openings;
  }

 private:
  [[nodiscard]] Vec3 at(NodeId n) const { return model_.position[n.value]; }

  [[nodiscard]] bool stands_in(std::size_t border, std::size_t hole) const {
    if (!boxes_[hole].overlaps(boxes_[border])) return false;
    Vec3 mean;
    for (const NodeId n : contours_[hole].nodes) mean += normal_.at(n);
    const Plane plane(mean);
    std::vector<Vec2> rim;
    for (const NodeId n : contours_[hole].nodes) rim.push_back(plane(at(n)));
    return std::ranges::all_of(contours_[border].nodes, [&](NodeId n) {
      return is_inside(rim, plane(at(n))) && is_reached(contours_[hole], n);
    });
  }

  /// From the nearest node of the hole.
  [[nodiscard]] bool is_reached(const Contour& hole, NodeId n) const {
    const NodeId from =
        *std::ranges::min_element(hole.nodes, {}, [&](NodeId m) { return squared_norm(at(m) - at(n)); });
    const Vec3 way = at(n) - at(from), here = normal_.at(n), there = normal_.at(from);
    const double most = kSteepest * norm(way);
    return dot(here, there) > 0 && std::abs(dot(way, here)) <= most && std::abs(dot(way, there)) <= most;
  }

  const Model& model_;
  std::span<const Contour> contours_;
  std::vector<Box> boxes_;         // by contour
  std::map<NodeId, Vec3> normal_;  // unit, of the nodes of contours
};

}  // namespace

std::vector<OpeningContours> openings_of(const Model& model, std::span<const Contour> contours) {
  return Nesting(model, contours).run();
}

}  // namespace meshgraft
