#include "merge/mended_faces.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <string>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kNoHeight = 1e-12;  // over the length, of three places on one line, which rounding has put off it

struct Found {
  std::size_t n = 0;
  ElementId first;  // only if n > 0
};

Found both(Found a, Found b) { return {a.n + b.n, a.n > 0 ? a.first : b.first}; }

bool is_flat_face(const Model& model, ElementId e) {
  if (!model.is_face(e)) return false;
  const Triangle t = model.corners(e);
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], n = cross(u, v);
  const double limit = kNoHeight * (dot(u, u) + dot(v, v));  // no root: every face of a model is asked
  return dot(n, n) <= limit * limit;
}

/// "3 triangles without area, the first of them element 7 of wall.unv, were"
std::string text_of(const Outcome& outcome, std::uint32_t input, Found found) {
  const bool one = found.n == 1;
  return (one ? "a triangle" : std::to_string(found.n) + " triangles") + " without area, " +
         (one ? "" : "the first of them ") + text_of(outcome.inputs, {input, found.first}) + ", " +
         (one ? "was" : "were");
}

}  // namespace

std::vector<Warning> mended_face_warnings(const Outcome& outcome) {
  std::vector<Warning> warnings;
  for (std::uint32_t k = 0; k < outcome.inputs.size(); ++k) {
    const Model& model = *outcome.inputs[k];
    Found found;
    for (const ElementId e : outcome.graft.removed_elements[k])
      if (is_flat_face(model, e)) found = both(found, {1, e});
    if (found.n == 0) continue;
    warnings.push_back({"mended-face", text_of(outcome, k, found) + " in the zone and gave way to others",
                        place_of(model, found.first)});
  }
  return warnings;
}

std::vector<Warning> flat_face_warnings(const Outcome& outcome) {
  std::vector<Warning> warnings;
  for (std::uint32_t k = 0; k < outcome.inputs.size(); ++k) {
    const Model& model = *outcome.inputs[k];
    const auto& removed = outcome.graft.removed_elements[k];
    const auto find = [&](const tbb::blocked_range<std::size_t>& range, Found found) {
      for (std::size_t e = range.begin(); e < range.end(); ++e)
        if (is_flat_face(model, ElementId(e)) && !std::ranges::binary_search(removed, ElementId(e)))
          found = both(found, {1, ElementId(e)});
      return found;
    };
    const Found found =
        tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, model.n_elements(), 10'000), Found{}, find, both);
    if (found.n == 0) continue;
    warnings.push_back(
        {"flat-face",
         text_of(outcome, k, found) + " not in the zone and stayed as " + (found.n == 1 ? "it was" : "they were"),
         place_of(model, found.first)});
  }
  return warnings;
}

}  // namespace meshgraft
