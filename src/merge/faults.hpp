// What the rooms of the pipeline report, in the words of the user: labels, files, places.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/components.hpp"
#include "intersect/corefine.hpp"
#include "merge/inputs.hpp"
#include "meshgraft/graft.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// A junction that could not be made, as an error with labels.
[[nodiscard]] Error to_error(Inputs inputs, const JunctionFault& fault);

/// kDegenerateFace for the first face without area that new elements replace: nothing that was made there can be right.
[[nodiscard]] std::optional<Error> flat_face_error(Inputs inputs, const Graft& graft);

/// Places within the tolerance at which the parts were not joined, as broken promises with labels.
[[nodiscard]] std::vector<Error> open_gap_errors(Inputs inputs, std::span<const Corefined::OpenGap> gaps);

/// One warning for each input with free edges that are in reach of another mesh in part, with the nearest place that is
/// not.
[[nodiscard]] std::vector<Warning> half_reached_warnings(Inputs inputs, std::span<const Corefined::HalfReached> places);

/// One warning for each input with open seams that the junction joins, with the first place.
[[nodiscard]] std::vector<Warning> joined_seam_warnings(Inputs inputs, std::span<const Corefined::JoinedSeam> seams);

/// The parts that no chain of meetings joins to the base, ascending.
/// `met`: pairs of components that meet.
[[nodiscard]] std::vector<std::uint32_t> parts_apart(const Components& components,
                                                     std::span<const std::array<std::uint32_t, 2>> met);

/// Where an input is joined with itself, or groups are: what was to be joined and meets nowhere.
/// Nothing if all is well.
///   one input        no component meets another
///   MergeOptions::joins   two groups have no faces that meet
[[nodiscard]] std::optional<Error> nothing_joined(Inputs inputs, const Components& components,
                                                  std::span<const std::array<std::uint32_t, 2>> met,
                                                  const std::vector<JoinedGroups>& joins);

/// kPartsApart naming the parts apart, those that are not, and how far away they are. What was left open tells why a
/// part within the tolerance is apart all the same.
[[nodiscard]] Error apart_error(Inputs inputs, std::span<const std::uint32_t> apart, const Corefined& corefined = {});

}  // namespace meshgraft
