// More than two meshes over one place: what lies on what lies on a face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "intersect/lying.hpp"

namespace meshgraft {

/// Where faces of several components of the first side lie over one face of the second (a plate between two
/// others), the second can be laid on one of them only. Takes the contacts with the others out.
///   returns   their components, ascending: the largest, as what was laid on the first comes between
///
///   lying_at  by face, its corners as contact is told by them, see find_contacts()
[[nodiscard]] std::vector<std::uint32_t> take_out_behind(const Complex& complex, std::span<const Triangle> lying_at,
                                                         Contacts& contacts);

/// Faces of one component, not neighbours, that lie over each other on one face of the other side, as those of a
/// U-profile over the edge of a plate: the plate cannot be one with both.
[[nodiscard]] std::optional<JunctionFault> find_two_layers(const Complex& complex, std::span<const Triangle> lying_at,
                                                           const Contacts& contacts);

/// Draws the side that goes towards the one that stays by what lay between them (Reach), where they are in contact: in
/// its chart, not in the complex. Where some of it is bent there, all of it is drawn onto the other from where it lay
/// before, so that nothing stands askew.
void draw_together(LyingMeeting& lying);

/// Height of the plane of `other` above the middle of a face, along its normal.
[[nodiscard]] double height_above(const Triangle& face, const Triangle& other);

}  // namespace meshgraft
