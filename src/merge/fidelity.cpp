#include "merge/fidelity.hpp"

#include <algorithm>
#include <tuple>

#include "core/blocks.hpp"
#include "merge/edges.hpp"
#include "merge/measured_surface.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kSampleBlock = 1024;  // samples measured in one go

class Measure {
 public:
  Measure(const Outcome& outcome, const Tolerance& tolerance, const FidelityLimits& limits)
      : outcome_(outcome), tolerance_(tolerance), limits_(limits) {
    std::vector<std::vector<Triangle>> removed(outcome.components.size());
    for (std::uint32_t k = 0; k < outcome.inputs.size(); ++k)
      for (const ElementId e : outcome.graft.removed_elements[k])
        if (const Model& model = *outcome.inputs[k]; model.is_face(e)) {
          std::vector<Triangle>& faces = removed[outcome.components.of({k, e})];
          faces.push_back(model.corners(e));
          if (outcome.places.is_moved({k, e})) faces.push_back(outcome.places.of(ElementRef{k, e}));
        }
    for (const Complex::Layers& layers : outcome.final_complex.layers) gaps_ = std::max(gaps_, layers.size());
    for (auto& faces : removed) references_.emplace_back(std::move(faces));
  }

  FidelityVerdict run() {
    const std::vector<Sample> samples = all_samples();
    std::vector<Worst> of_block((samples.size() + kSampleBlock - 1) / kSampleBlock);
    for_blocks(
        samples.size(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t k = first; k < last; ++k) look(samples[k], of_block[first / kSampleBlock]);
        },
        kSampleBlock);
    Worst worst;
    for (const Worst& w : of_block) worst.add(w);

    FidelityVerdict verdict{worst.figures, {}};
    if (worst.beyond.face.valid())
      verdict.broken.push_back(
          {ErrorCode::kPromiseBroken,
           outcome_.text(worst.beyond.face) + " is " + text_of(worst.beyond.distance) + " off the input surface, " +
               text_of(100 * worst.beyond.distance / outcome_.input_edge_length(worst.beyond.face)) +
               " % of the edge length",
           "give a smaller --size, so that the surface is followed more closely",
           outcome_.parent_place(worst.beyond.face)});
    return verdict;
  }

 private:
  /// A point of a new face.
  struct Sample {
    Vec3 point;
    FaceId face;
  };

  /// A sample that is farther from the input surface than it may be.
  struct Beyond {
    FaceId face;  // invalid: there is none
    double distance = 0;
    double share = 0;  // of the edge length, by which it is too far
  };

  /// The farthest sample, over the edge length, the distances, and what is most too far; of equal ones the first.
  struct Worst {
    Report::Fidelity figures;
    Beyond beyond;

    void add(const Worst& other) {
      if (other.beyond.share > beyond.share) beyond = other.beyond;
      figures.max_distance = std::max(figures.max_distance, other.figures.max_distance);
      if (other.figures.max_distance_relative <= figures.max_distance_relative) return;
      figures.max_distance_relative = other.figures.max_distance_relative;
      figures.at = other.figures.at;
    }
  };

  /// How far a new face may be from the input surface. Where gaps were closed that is the tolerance: each of several
  /// layers may be that far from the next. A layer that was laid on another has the new faces of that one, which are
  /// as far from its surface as they may be, and the gap is between the two surfaces.
  [[nodiscard]] double allowed(FaceId f) const {
    const double length = outcome_.input_edge_length(f);
    const double drawn = static_cast<double>(gaps_) * tolerance_.at(length);
    if (const FaceId beneath = outcome_.beneath(f); beneath.valid())
      return drawn + limits_.max_relative * std::max(length, outcome_.input_edge_length(beneath));
    return std::max(limits_.max_relative * length, drawn);
  }

  [[nodiscard]] std::vector<Sample> all_samples() const {
    std::vector<Sample> samples;
    add_corners(samples);
    add_edges(samples);
    const Complex& complex = outcome_.final_complex;
    for (std::size_t f = 0; f < complex.n_faces(); ++f)
      if (outcome_.is_new(FaceId(f))) samples.push_back({centroid(complex.corners(FaceId(f))), FaceId(f)});
    return samples;
  }

  /// Each vertex once for each component it has new faces of.
  void add_corners(std::vector<Sample>& samples) const {
    const Complex& complex = outcome_.final_complex;
    std::vector<std::tuple<VertexId, std::uint32_t, FaceId>> uses;
    for (std::size_t f = 0; f < complex.n_faces(); ++f)
      if (outcome_.is_new(FaceId(f)))
        for (const VertexId v : complex.face[f]) uses.emplace_back(v, complex.component[f], FaceId(f));
    std::sort(uses.begin(), uses.end());
    for (std::size_t k = 0; k < uses.size(); ++k) {
      const auto [v, component, f] = uses[k];
      if (k > 0 && std::get<0>(uses[k - 1]) == v && std::get<1>(uses[k - 1]) == component) continue;
      samples.push_back({complex.position[v.value], f});
    }
  }

  /// Each edge of a new face once for each component.
  void add_edges(std::vector<Sample>& samples) const {
    const Complex& complex = outcome_.final_complex;
    const std::vector<FaceOnEdge> uses = edge_uses(complex, outcome_.changed_vertex);
    for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
      for (std::size_t k = 0; k < edge.size(); ++k) {
        const auto same_component = [&](const FaceOnEdge& e) {
          return outcome_.is_new(e.face) && complex.component[e.face.value] == complex.component[edge[k].face.value];
        };
        if (!outcome_.is_new(edge[k].face) || std::ranges::any_of(edge.first(k), same_component)) continue;
        samples.push_back(
            {midpoint(complex.position[edge[k].low.value], complex.position[edge[k].high.value]), edge[k].face});
      }
    });
  }

  /// Most samples are no farther than the worst one so far, which is told sooner than their distance.
  void look(const Sample& sample, Worst& worst) const {
    const auto& [p, f] = sample;
    const MeasuredSurface& reference = references_[outcome_.final_complex.component[f.value]];
    if (reference.empty()) return;
    const double length = outcome_.input_edge_length(f);
    const double most = allowed(f);
    const double known = std::min(worst.figures.max_distance, worst.figures.max_distance_relative * length);
    if (reference.is_within(p, std::max(std::min(known, most), limits_.negligible * length))) return;
    const double d = reference.distance(p);
    Worst own;
    own.figures.max_distance = d, own.figures.max_distance_relative = d / length, own.figures.at = p;
    if (d > most) own.beyond = {f, d, (d - most) / length};
    worst.add(own);
  }

  const Outcome& outcome_;
  const Tolerance& tolerance_;
  const FidelityLimits& limits_;
  std::size_t gaps_ = 1;  // over each other
  /// By component: its faces that were removed, as they were and as their moved nodes have stretched them.
  std::vector<MeasuredSurface> references_;
};

}  // namespace

FidelityVerdict fidelity_of(const Outcome& outcome, const Tolerance& tolerance, const FidelityLimits& limits) {
  return Measure(outcome, tolerance, limits).run();
}

}  // namespace meshgraft
