#include "merge/coverage.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/distinct.hpp"
#include "geometry/quality.hpp"
#include "merge/measured_surface.hpp"

namespace meshgraft {
namespace {

/// What a face is, apart from its place.
using Key = std::tuple<std::vector<std::uint32_t>, GroupSetId, AttributesId>;

class Coverage {
 public:
  Coverage(const Outcome& outcome, const Tolerance& tolerance, const CoverageLimits& limits)
      : outcome_(outcome),
        before_(outcome.corefined.complex),
        after_(outcome.final_complex),
        tolerance_(tolerance),
        limits_(limits) {
    for (std::size_t f = 0; f < before_.n_faces(); ++f)
      if (is_removed(FaceId(f))) removed_.emplace_back(f);
    for (std::size_t f = 0; f < after_.n_faces(); ++f)
      if (outcome.is_new(FaceId(f))) new_.emplace_back(f);
    was_ = removed_, there_ = new_;
    if (outcome.all_layers) add_layered();
  }

  CoverageVerdict run() {
    if (outcome_.kind == OperationKind::kFill) return {};  // there was nothing
    look_from_removed();
    look_from_new();
    return std::move(verdict_);
  }

 private:
  using Patches = std::map<Key, MeasuredSurface>;  // faces of one complex that are alike

  [[nodiscard]] bool is_removed(ElementRef parent) const {
    return std::ranges::binary_search(outcome_.graft.removed_elements[parent.input], parent.element);
  }
  [[nodiscard]] bool is_removed(FaceId f) const {
    return is_removed(before_.parent[f.value]) ||
           (outcome_.all_layers && std::ranges::any_of(before_.layers_of(f), [&](const Complex::Layer& layer) {
              return is_removed(layer.parent);
            }));
  }

  [[nodiscard]] static Key whole_key(const Complex& complex, FaceId f) {
    return {complex.components_of(f), complex.face_groups[f.value], complex.face_attributes[f.value]};
  }

  /// A layer may have one face that is on the nodes of its parent, and is kept, and others of the same parent: neither
  /// those nor the rest of the parent are where only what was removed is.
  void add_layered() {
    std::vector<ElementRef> parents;
    for (std::size_t f = 0; f < before_.n_faces(); ++f) {
      const auto& layers = before_.layers_of(FaceId(f));
      if (layers.empty()) continue;
      if (!is_removed(FaceId(f))) was_.emplace_back(f);
      parents.push_back(before_.parent[f]);
      for (const Complex::Layer& layer : layers) parents.push_back(layer.parent);
    }
    make_distinct(parents);
    for (std::size_t f = 0; f < after_.n_faces(); ++f)
      if (!outcome_.is_new(FaceId(f)) && std::ranges::binary_search(parents, after_.parent[f])) there_.emplace_back(f);
  }

  /// What a face stands for. Where all layers stay each becomes a face of its own. `only_removed`: those of them that
  /// are remeshed.
  [[nodiscard]] std::vector<Key> keys_before(FaceId f, bool only_removed) const {
    if (!outcome_.all_layers) return {whole_key(before_, f)};
    std::vector<Key> all;
    const auto add = [&](ElementRef parent, std::uint32_t component) {
      if (!only_removed || is_removed(parent)) all.push_back({{component}, {}, {}});
    };
    add(before_.parent[f.value], before_.component[f.value]);
    for (const Complex::Layer& layer : before_.layers_of(f)) add(layer.parent, layer.component);
    return all;
  }
  [[nodiscard]] std::vector<Key> keys_after(FaceId f) const {
    return {outcome_.all_layers ? Key{{after_.component[f.value]}, {}, {}} : whole_key(after_, f)};
  }

  template <class F>
  [[nodiscard]] static Patches patches(const Complex& complex, const std::vector<FaceId>& faces, F&& keys) {
    std::map<Key, std::vector<Triangle>> alike;
    for (const FaceId f : faces)
      for (const Key& key : keys(f)) alike[key].push_back(complex.corners(f));
    Patches all;
    for (auto& [key, triangles] : alike) all.emplace(key, std::move(triangles));
    return all;
  }

  [[nodiscard]] double edge_length(ElementRef parent) const {
    return mean_edge_length(outcome_.inputs[parent.input]->corners(parent.element));
  }
  [[nodiscard]] double allowed(double length) const {
    return std::max(limits_.max_relative * length, tolerance_.at(length));
  }

  /// By vertex of before_: how far a corner of a face on it was drawn off the parent, to close a gap. New faces may
  /// take the way down beside it.
  [[nodiscard]] std::vector<double> drawn() const {
    std::vector<double> own(before_.n_vertices(), 0), around(before_.n_vertices(), 0);
    if (outcome_.corefined.moves.empty()) return around;
    for (const FaceId f : removed_) {
      const ElementRef parent = before_.parent[f.value];
      const Triangle was = outcome_.inputs[parent.input]->corners(parent.element);
      for (const VertexId v : before_.face[f.value]) {
        const Vec3 p = before_.position[v.value];
        own[v.value] = std::max(own[v.value], distance(p, closest_on_triangle(p, was).point));
      }
    }
    for (const FaceId f : removed_) {
      const auto [a, b, c] = before_.face[f.value];
      const double most = std::max({own[a.value], own[b.value], own[c.value]});
      for (const VertexId v : {a, b, c}) around[v.value] = std::max(around[v.value], most);
    }
    return around;
  }

  /// Corners and centroids of what was removed.
  void look_from_removed() {
    const Patches there = patches(after_, there_, [&](FaceId f) { return keys_after(f); });
    Report::Fidelity::Removed& most = verdict_.figures;
    const std::vector<double> drawn_around = drawn();
    std::vector<Near> near(before_.n_vertices());
    Gone gone;
    for (const FaceId f : removed_) {
      double most_drawn = 0;
      for (const VertexId v : before_.face[f.value]) most_drawn = std::max(most_drawn, drawn_around[v.value]);
      const double length = edge_length(before_.parent[f.value]), enough = allowed(length) + most_drawn;
      const Vec3 middle = centroid(before_.corners(f));
      for (const Key& key : keys_before(f, true)) {
        const auto patch = there.find(key);
        if (patch == there.end()) return tell({f, middle});
        const MeasuredSurface& surface = patch->second;
        const auto look_from = [&](Vec3 p, Near& known) {
          const double of_interest =
              std::max(kNegligible * length, std::min(most.max_distance_relative * length, enough));
          if (known.surface == &surface && known.distance <= of_interest) return;
          if (surface.is_within(p, of_interest)) {
            known = {&surface, of_interest};
            return;
          }
          const double d = surface.distance(p);
          if (d > most.max_distance_relative * length) most = {std::max(most.max_distance, d), d / length, p};
          if (const double beyond = (d - enough) / length; beyond > gone.beyond) gone = {f, p, d, beyond};
        };
        Near of_middle;
        look_from(middle, of_middle);
        for (const VertexId v : before_.face[f.value]) look_from(before_.position[v.value], near[v.value]);
      }
    }
    if (gone.face.valid()) tell(gone);
  }

  /// A surface that a place is known to be no farther from.
  struct Near {
    const MeasuredSurface* surface = nullptr;
    double distance = 0;
  };

  /// A place where surface is missing.
  struct Gone {
    FaceId face;  // of before_
    Vec3 at;
    double distance = 0;  // of the new faces that stand for it; 0: there are none
    double beyond = 0;    // what is allowed, over the edge length
  };

  void tell(const Gone& gone) {
    const ElementRef parent = before_.parent[gone.face.value];
    verdict_.broken.push_back(
        {ErrorCode::kPromiseBroken,
         "the surface of " + text_of(outcome_.inputs, parent) + " is gone around " + text_of(gone.at) +
             (gone.distance == 0
                  ? ": no new face has its groups and properties"
                  : ": the new faces with its groups and properties are " + text_of(gone.distance) + " off, " +
                        text_of(100 * gone.distance / edge_length(parent)) + " % of the edge length"),
         "give a smaller --size, so that the surface is followed more closely",
         place_of(*outcome_.inputs[parent.input], parent.element)});
  }

  /// Centroids of the new faces.
  void look_from_new() {
    const Patches was = patches(before_, was_, [&](FaceId f) { return keys_before(f, false); });
    for (const FaceId f : new_) {
      const double length = outcome_.input_edge_length(f);
      const auto was_there = [&](const Key& key) {
        const auto patch = was.find(key);
        return patch != was.end() && patch->second.is_within(centroid(after_.corners(f)), allowed(length));
      };
      if (std::ranges::all_of(keys_after(f), was_there)) continue;
      verdict_.broken.push_back({ErrorCode::kPromiseBroken,
                                 outcome_.text(f) + " is not where the input has its groups and properties",
                                 hint_for_place(outcome_.kind), outcome_.parent_place(f)});
      return;
    }
  }

  static constexpr double kNegligible = 1e-9;  // share of the edge length: rounding

  const Outcome& outcome_;
  const Complex& before_;
  const Complex& after_;
  const Tolerance& tolerance_;
  const CoverageLimits& limits_;
  std::vector<FaceId> removed_, new_;  // of before_, of after_; ascending
  std::vector<FaceId> was_, there_;    // the same, and what a kept face of a layer stands for
  CoverageVerdict verdict_;
};

}  // namespace

CoverageVerdict coverage_of(const Outcome& outcome, const Tolerance& tolerance, const CoverageLimits& limits) {
  return Coverage(outcome, tolerance, limits).run();
}

}  // namespace meshgraft
