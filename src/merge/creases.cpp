#include "merge/creases.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "merge/edges.hpp"
#include "merge/inputs.hpp"
#include "merge/segments.hpp"

namespace meshgraft {
namespace {

class Creases {
 public:
  Creases(const Outcome& outcome, const CreaseLimits& limits)
      : outcome_(outcome), complex_(outcome.final_complex), limits_(limits) {}

  std::vector<Warning> warnings() {
    if (outcome_.kind == OperationKind::kFill) return {};
    find_folds();
    if (folds_.empty()) return {};
    const Segments features(features_before());
    for (const Fold& fold : folds_)
      if (!features.are_near(fold.at, limits_.beside * fold.size)) count(fold);
    return told();
  }

 private:
  struct Fold {
    FaceId face;  // new
    Vec3 at;
    double angle = 0, size = 0;
  };
  struct Found {
    std::size_t n = 0;
    Fold sharpest;
  };

  void find_folds() {
    for_each_edge(edge_uses(complex_, outcome_.changed_vertex), [&](std::span<const FaceOnEdge> edge) {
      if (edge.size() != 2) return;
      const FaceId f = edge[0].face, g = edge[1].face;
      if (!outcome_.is_new(f) && !outcome_.is_new(g)) return;
      const double angle = fold_angle(complex_, edge[0], edge[1]);
      if (angle < limits_.sharp_angle + limits_.margin) return;
      const auto [a, b] = std::pair{complex_.position[edge[0].low.value], complex_.position[edge[0].high.value]};
      const double size = std::max(outcome_.input_edge_length(f), outcome_.input_edge_length(g));
      folds_.push_back({outcome_.is_new(f) ? f : g, midpoint(a, b), angle, size});
    });
  }

  /// Sharp, free and non-manifold edges of the workpiece, with nodes where they were moved to, and the junction.
  [[nodiscard]] std::vector<Segment> features_before() const {
    const Complex& before = outcome_.original;
    std::vector<Segment> features;
    for_each_edge(edge_uses(before), [&](std::span<const FaceOnEdge> edge) {
      if (edge.size() == 2 && fold_angle(before, edge[0], edge[1]) < limits_.sharp_angle) return;
      features.push_back({outcome_.moved(edge[0].low), outcome_.moved(edge[0].high)});
    });
    for (const auto& [a, b] : outcome_.corefined.junction_edges)
      features.push_back({outcome_.corefined.complex.position[a.value], outcome_.corefined.complex.position[b.value]});
    return features;
  }

  void count(const Fold& fold) {
    Found& found = of_input_[complex_.parent[fold.face.value].input];
    ++found.n;
    if (fold.angle > found.sharpest.angle) found.sharpest = fold;
  }

  [[nodiscard]] std::vector<Warning> told() const {
    std::vector<Warning> warnings;
    for (const auto& [input, found] : of_input_) {
      const std::string angle = text_of(std::round(found.sharpest.angle * 180 / std::numbers::pi)) + " degrees";
      std::string text = "an edge of " + outcome_.text(found.sharpest.face) + " around " + text_of(found.sharpest.at) +
                         " is folded by " + angle + ", where " + outcome_.inputs[input]->path + " has no sharp edge";
      if (found.n > 1)
        text += "; so " +
                (found.n == 2 ? std::string("is another") : "are " + std::to_string(found.n - 1) + " others") +
                ", by less";
      warnings.push_back({"new-crease", text + "; a smaller --size follows the surface more closely",
                          outcome_.parent_place(found.sharpest.face)});
    }
    return warnings;
  }

  const Outcome& outcome_;
  const Complex& complex_;
  const CreaseLimits& limits_;
  std::vector<Fold> folds_;
  std::map<std::uint32_t, Found> of_input_;
};

}  // namespace

std::vector<Warning> crease_warnings(const Outcome& outcome, const CreaseLimits& limits) {
  return Creases(outcome, limits).warnings();
}

}  // namespace meshgraft
