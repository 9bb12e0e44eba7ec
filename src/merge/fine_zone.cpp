#include "merge/fine_zone.hpp"

#include <limits>

#include "geometry/quality.hpp"

namespace meshgraft {

std::vector<Warning> fine_zone_warnings(const Outcome& outcome, const FineZoneLimits& limits) {
  const Complex& complex = outcome.final_complex;
  std::size_t created = 0;
  FaceId smallest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    if (!outcome.is_new(FaceId(f))) continue;
    ++created;
    const double size = mean_edge_length(complex.corners(FaceId(f)));
    if (size < least) least = size, smallest = FaceId(f);
  }
  const std::size_t removed = outcome.original.n_faces() - (complex.n_faces() - created);
  if (created < limits.worth_telling || static_cast<double>(created) < limits.many_times * static_cast<double>(removed))
    return {};
  std::vector<Warning> warnings;
  warnings.push_back(
      {"fine-zone",
       std::to_string(created) + " triangles replace " + std::to_string(removed) + ": the smallest, " +
           outcome.text(smallest) + ", has edges of " + text_of(least) + ", where those of the input have " +
           text_of(outcome.input_edge_length(smallest)) +
           "; they follow a narrow lap, gap or corner that the meshes leave there; if it means nothing, a "
           "--tolerance of " +
           text_of(limits.tolerance_share * least) + " leaves it out",
       outcome.parent_place(smallest)});
  return warnings;
}

}  // namespace meshgraft
