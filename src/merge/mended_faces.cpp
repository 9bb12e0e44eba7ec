#include "merge/mended_faces.hpp"

#include <string>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kNoQuality = 1e-12;  // Q of three places on one line, which rounding has put off it

}  // namespace

std::vector<Warning> mended_face_warnings(const Outcome& outcome) {
  std::vector<Warning> warnings;
  for (std::uint32_t k = 0; k < outcome.inputs.size(); ++k) {
    const Model& model = *outcome.inputs[k];
    std::size_t n = 0;
    ElementId first;
    for (const ElementId e : outcome.graft.removed_elements[k]) {
      if (!model.is_face(e) || aspect_ratio(model.corners(e)) > kNoQuality) continue;
      if (n++ == 0) first = e;
    }
    if (n == 0) continue;
    warnings.push_back({"mended-face",
                        (n == 1 ? "a triangle" : std::to_string(n) + " triangles") + " without area, " +
                            (n == 1 ? "" : "the first of them ") + text_of(outcome.inputs, {k, first}) + ", " +
                            (n == 1 ? "was" : "were") + " in the zone and gave way to others",
                        place_of(model, first)});
  }
  return warnings;
}

}  // namespace meshgraft
