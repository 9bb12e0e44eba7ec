// What is wrong with a filling, beyond the checks of every result.
#pragma once

#include <span>
#include <vector>

#include "core/complex.hpp"
#include "fill/unfollowed.hpp"
#include "meshgraft/model.hpp"
#include "meshgraft/options.hpp"

namespace meshgraft {

struct FillingFlaws {
  std::vector<Error> broken;
  std::vector<Warning> warnings;
};

/// Errors kPromiseBroken, one for each kind, if faces of `complex` from `first` on
///   - make more than 90 degrees with a neighbour among them: the filling is folded back;
///   - lie on a surface element of `base` within the tolerance: no sign of coordinates that are rounded tells that they
///     meet;
///   - cross a surface element that is no linear triangle.
/// A warning if 1D elements other than those `unfollowed` lie on them, within the tolerance: they are not joined to
/// what they lie on.
///
///   unfollowed   told of already; ascending
///
/// Cost: one look at each element of the base.
[[nodiscard]] FillingFlaws flaws_of(const Model& base, const Complex& complex, std::size_t first,
                                    std::span<const UnfollowedBeam> unfollowed, const Tolerance& tolerance);

}  // namespace meshgraft
