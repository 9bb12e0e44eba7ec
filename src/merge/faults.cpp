#include "merge/faults.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/quality.hpp"
#include "merge/mesh_distance.hpp"

namespace meshgraft {
namespace {

constexpr double kNoHeight = 1e-6;  // of a face, over its longest side: it has no area

std::string hint_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kOverlap:
      return "give a --tolerance clearly above the distance of the two surfaces there, or clearly below it; contact is "
             "refused by --mode face-edge";
    case ErrorCode::kDegenerateFace:
      return "remove the face or give it an area; meshgraft check -v lists all of them";
    case ErrorCode::kDuplicateFace:
      return "remove one of the two; meshgraft check -v lists all of them";
    case ErrorCode::kUnsupportedElement:
      return "split the elements there into three-node triangles, or move the part or the tool";
    default:
      return "look at this place in both meshes; another --tolerance, or a part moved by a little, may help";
  }
}

}  // namespace

Error to_error(Inputs inputs, const JunctionFault& fault) {
  Error error{fault.code, fault.what, fault.hint.empty() ? hint_of(fault.code) : fault.hint, {}};
  std::vector<std::string> elements;
  for (const ElementRef e : fault.elements) elements.push_back(text_of(inputs, e));
  if (!elements.empty()) error.what += ": " + joined(elements);
  error.what += " at " + text_of(fault.at);
  if (!fault.elements.empty()) {
    const ElementRef first = fault.elements.front();
    error.place = place_of(*inputs[first.input], first.element);
  }
  return error;
}

std::optional<Error> flat_face_error(Inputs inputs, const Graft& graft) {
  std::optional<ElementRef> first;
  for (const NewElement& e : graft.new_elements) {
    const Model& model = *inputs[e.parent.input];
    if (!model.is_face(e.parent.element) || (first && *first <= e.parent)) continue;
    const Triangle t = model.corners(e.parent.element);
    const double longest = std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
    if (2 * area(t) <= kNoHeight * longest * longest) first = e.parent;
  }
  if (!first) return std::nullopt;
  return to_error(inputs, {ErrorCode::kDegenerateFace,
                           "a face without area would have to be remeshed",
                           {*first},
                           centroid(inputs[first->input]->corners(first->element))});
}

namespace {

/// What can be done about a gap that is left open.
std::string hint_of(Inputs inputs, const Corefined::OpenGap& gap) {
  if (gap.faces[gap.feature].input == 0 && inputs.size() > 1)
    return "what ends there is of " + inputs[0]->path +
           ", the base, whose nodes are never moved; give that as the part, and the other mesh as the base";
  return "only free edges are drawn over gaps of more than a quarter of the edge length, and none where details are "
         "smaller than the tolerance; a smaller --tolerance, or meshes that meet exactly there";
}

}  // namespace

namespace {

/// The place of an input that is least out of reach, and how many there are.
std::pair<Corefined::HalfReached, std::size_t> nearest_half_reached(std::span<const Corefined::HalfReached> places,
                                                                    std::uint32_t input) {
  std::pair<Corefined::HalfReached, std::size_t> found{{{}, {}, std::numeric_limits<double>::infinity()}, 0};
  for (const Corefined::HalfReached& place : places) {
    if (place.face.input != input) continue;
    if (place.distance < found.first.distance) found.first = place;
    ++found.second;
  }
  return found;
}

}  // namespace

std::vector<Error> open_gap_errors(Inputs inputs, std::span<const Corefined::OpenGap> gaps) {
  std::vector<Error> errors;
  for (const Corefined::OpenGap& gap : gaps) {
    const JunctionFault fault{ErrorCode::kJunctionNotResolved,
                              "a gap of " + text_of(gap.distance) + ", less than the tolerance, is left open",
                              {gap.faces.begin(), gap.faces.end()},
                              gap.at};
    errors.push_back(to_error(inputs, fault));
    errors.back().hint = hint_of(inputs, gap);
  }
  return errors;
}

std::vector<Warning> half_reached_warnings(Inputs inputs, std::span<const Corefined::HalfReached> places) {
  std::vector<Warning> warnings;
  for (std::uint32_t k = 0; k < inputs.size(); ++k) {
    const auto [nearest, n] = nearest_half_reached(places, k);
    if (n == 0) continue;
    std::string text = "the free edge at " + text_of(inputs, nearest.face) +
                       " is within the tolerance of another mesh in part, and joined as far as that: at " +
                       text_of(nearest.at) + " it is " + text_of(nearest.distance) + " away";
    if (n > 1) text += "; so are others at " + std::to_string(n - 1) + (n > 2 ? " more places" : " more place");
    warnings.push_back({"partly-in-reach", std::move(text), place_of(*inputs[k], nearest.face.element)});
  }
  return warnings;
}

std::vector<Warning> joined_seam_warnings(Inputs inputs, std::span<const Corefined::JoinedSeam> seams) {
  std::vector<std::vector<Corefined::JoinedSeam>> of_input(inputs.size());
  for (const Corefined::JoinedSeam& seam : seams) of_input[seam.face.input].push_back(seam);
  std::vector<Warning> warnings;
  for (const auto& found : of_input) {
    if (found.empty()) continue;
    const auto& [face, at] = found.front();
    std::string text = "the junction passes over an open seam at " + text_of(inputs, face) + ", " + text_of(at) +
                       ": the sides of the seam share its node there";
    if (found.size() > 1) text += "; so do those at " + std::to_string(found.size() - 1) + " more places";
    warnings.push_back({"seam-joined", std::move(text), place_of(*inputs[face.input], face.element)});
  }
  return warnings;
}

std::vector<std::uint32_t> parts_apart(const Components& components,
                                       std::span<const std::array<std::uint32_t, 2>> met) {
  std::vector<std::vector<std::uint32_t>> meets(components.input_order.size());
  for (const auto& [a, b] : met) {
    meets[components.input[a]].push_back(components.input[b]);
    meets[components.input[b]].push_back(components.input[a]);
  }
  std::vector<bool> reached(meets.size());
  std::vector<std::uint32_t> open{0};
  reached[0] = true;
  while (!open.empty()) {
    const std::uint32_t k = open.back();
    open.pop_back();
    for (const std::uint32_t other : meets[k])
      if (!reached[other]) reached[other] = true, open.push_back(other);
  }
  std::vector<std::uint32_t> apart;
  for (std::uint32_t k = 1; k < reached.size(); ++k)
    if (!reached[k]) apart.push_back(k);
  return apart;
}

std::optional<Error> nothing_joined(Inputs inputs, const Components& components,
                                    std::span<const std::array<std::uint32_t, 2>> met,
                                    const std::vector<JoinedGroups>& joins) {
  const std::string& path = inputs[0]->path;
  for (std::size_t j = 0; j < joins.size(); ++j) {
    const auto is_met = [&](const auto& pair) {
      return components.joined_by(pair[0], pair[1], static_cast<std::uint32_t>(j));
    };
    if (std::ranges::any_of(met, is_met)) continue;
    return Error{ErrorCode::kPartsApart,
                 "faces of group " + joins[j].a + " and of group " + joins[j].b + " do not meet",
                 "check the names, give a larger --tolerance, or --allow-apart to leave them unjoined",
                 {path, 0}};
  }
  if (inputs.size() > 1 || !met.empty()) return std::nullopt;
  if (components.size() == 1)
    return Error{ErrorCode::kPartsApart,
                 "all faces of " + path + " hang together already, so there is nothing to join",
                 "name the PARTs to graft onto it, or two groups of it that shall be joined: --join GROUP_A:GROUP_B",
                 {path, 0}};
  return Error{ErrorCode::kPartsApart,
               "the " + std::to_string(components.size()) + " connected meshes of " + path + " do not meet each other",
               "check their positions, or give a larger --tolerance",
               {path, 0}};
}

Error apart_error(Inputs inputs, std::span<const std::uint32_t> apart, const Corefined& corefined) {
  std::vector<std::string> missing, meeting;
  for (std::uint32_t k = 1; k < inputs.size(); ++k) {
    if (!std::ranges::binary_search(apart, k)) {
      meeting.push_back(inputs[k]->path);
      continue;
    }
    missing.push_back(inputs[k]->path + " (" + text_of(distance_between(*inputs[0], *inputs[k])) + " away)");
  }
  Error error{ErrorCode::kPartsApart,
              joined(missing) + (missing.size() == 1 ? " does" : " do") + " not meet " + inputs[0]->path,
              "check position and units, give a larger --tolerance, or --allow-apart to add what is apart unjoined",
              {inputs[apart.front()]->path, 0}};
  if (!meeting.empty()) error.what += "; " + joined(meeting) + (meeting.size() == 1 ? " does" : " do");
  for (const std::uint32_t k : apart)
    if (const auto [nearest, n] = nearest_half_reached(corefined.half_reached, k); n > 0) {
      error.hint =
          "no free edge is within the tolerance with both its ends, and the other end of one that is with one "
          "end, at " +
          text_of(nearest.at) + ", is " + text_of(nearest.distance) + " away; " + error.hint;
      return error;
    }
  for (const Corefined::OpenGap& gap : corefined.left_open)
    if (std::ranges::any_of(gap.faces, [&](ElementRef f) { return std::ranges::binary_search(apart, f.input); })) {
      error.hint = "the gap is within the tolerance, but " + hint_of(inputs, gap);
      break;
    }
  return error;
}

}  // namespace meshgraft
