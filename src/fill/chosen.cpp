#include "fill/chosen.hpp"

#include "core/text.hpp"
#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

std::string number_of(std::size_t k) { return "contour " + std::to_string(k + 1); }

Result<void> check_named(const Model& base, std::span<const Contour> all, const Openings& openings) {
  std::vector<std::uint8_t> named(all.size(), 0);
  for (const OpeningContours& opening : openings) {
    if (opening.empty()) return failure(ErrorCode::kUsage, "an opening without a contour", "name its contours", {});
    for (const std::size_t k : opening) {
      if (k >= all.size())
        return failure(ErrorCode::kUsage,
                       "there is no " + number_of(k) + " in " + base.path + "; it has " + std::to_string(all.size()),
                       "list them with meshgraft fill FILE --list", {});
      if (named[k]++ != 0)
        return failure(ErrorCode::kUsage, number_of(k) + " is named twice", "name each contour once", {});
      if (!all[k].is_fillable)
        return failure(ErrorCode::kUnsupportedElement,
                       number_of(k) + " runs along elements that are not linear triangles",
                       "fill it before these are made, or leave it out", place_of_contour(base, all[k]));
    }
  }
  return {};
}

/// Names free edges that bound nothing that could be filled.
std::optional<Warning> no_contour(const Model& base, const FreeEdges& edges) {
  if (edges.others.empty()) return {};
  const NodeId at = edges.others.front()[0];
  return Warning{
      "no-contour",
      std::to_string(edges.others.size()) + " free edges, one of them at " + text_of(base.position[at.value]) +
          ", close no contour and are left as they are: the rim of a plate that stands on another, or of a hole "
          "beside one; or the orientation of faces changes along them",
      place_of(base, at)};
}

Failure nothing_to_fill(const Model& base, std::span<const Contour> all, const std::optional<Warning>& open,
                        const std::optional<Warning>& hidden) {
  const std::string what = "nothing to fill in " + base.path + ": ";
  if (hidden) return failure(ErrorCode::kUsage, what + hidden->what, "remove one of each pair", hidden->place);
  if (open)
    return failure(ErrorCode::kUsage, what + open->what,
                   "turn the faces alike, or fill the hole before anything is joined beside it", open->place);
  if (all.empty())
    return failure(ErrorCode::kUsage, what + "it has no free edges", "meshgraft check lists the edges of a mesh", {});
  return failure(ErrorCode::kUsage, what + "its contours are outer borders or run along other elements",
                 "name one with --contour", {});
}

}  // namespace

std::string numbers_of(const OpeningContours& opening) {
  if (opening.size() == 1) return number_of(opening.front());
  std::vector<std::string> numbers;
  for (const std::size_t k : opening) numbers.push_back(std::to_string(k + 1));
  return "contours " + joined(numbers);
}

std::optional<Warning> doubled_at_rims(const Model& base, const FreeEdges& edges) {
  if (edges.doubled.empty()) return {};
  const auto [a, b] = edges.doubled.front();
  const std::size_t n = edges.doubled.size();
  return Warning{
      "doubled-face",
      (n == 1 ? "two elements on the same nodes, "
              : std::to_string(n) + " pairs of elements on the same nodes, the first ") +
          std::to_string(base.element_label[a.value]) + " and " + std::to_string(base.element_label[b.value]) +
          ", have a side that no others have; it does not count as free, so that a hole or a border there is not seen",
      place_of(base, b)};
}

Place place_of_contour(const Model& base, const Contour& c) { return place_of(base, c.nodes.front()); }

Result<Openings> chosen(const Model& base, const FreeEdges& edges, const FillOptions& options,
                        std::vector<Warning>& warnings) {
  const std::span<const Contour> all = edges.contours;
  const auto hidden = doubled_at_rims(base, edges);
  if (hidden) warnings.push_back(*hidden);
  if (!options.openings.empty()) {
    if (const auto ok = check_named(base, all, options.openings); !ok) return Failure(ok.error());
    return options.openings;
  }
  Openings openings = openings_of(base, all);
  std::vector<std::uint8_t> taken(all.size(), 0);
  for (const OpeningContours& opening : openings) {
    for (const std::size_t k : opening) taken[k] = 1;
    if (opening.size() > 1)
      warnings.push_back(
          {"island", numbers_of(opening) + " bound one opening, and what stands in it is joined to the mesh around",
           place_of_contour(base, all[opening[1]])});
  }
  for (std::size_t k = 0; k < all.size(); ++k)
    if (taken[k] == 0)
      warnings.push_back({"left-open",
                          number_of(k) + " around " + text_of(all[k].centre) + " is left open: " +
                              (all[k].is_hole ? "elements along it are not linear triangles"
                                              : "it is an outer border, or the end of a pipe; name it to fill it"),
                          place_of_contour(base, all[k])});
  const auto open = no_contour(base, edges);
  if (open) warnings.push_back(*open);
  if (openings.empty()) return nothing_to_fill(base, all, open, hidden);
  return openings;
}

}  // namespace meshgraft
