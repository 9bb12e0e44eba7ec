// Finite-element descriptor ids of universal files.
#pragma once

#include <cstdint>

#include "meshgraft/model.hpp"

namespace meshgraft::unv {

/// Shape of an element with descriptor `id` and n nodes. If n does not fit the id, the element has
/// no shape we rely on: kOther.
[[nodiscard]] Shape shape_of(std::int64_t id, std::int64_t n);

/// Whether a record of this id is plausible: the id is known and n fits it.
[[nodiscard]] bool is_known_type(std::int64_t id, std::int64_t n);

/// Whether n is no number of nodes for this id: none at all, or one that a known id does not have.
[[nodiscard]] bool is_odd_count(std::int64_t id, std::int64_t n);

/// Ids whose record has a beam line (orientation node, two section numbers) after the header.
[[nodiscard]] constexpr bool has_beam_record(std::int64_t id) { return id == 11 || (id >= 21 && id <= 24); }

/// Ids for which writers disagree about the beam line; only the following lines can tell.
[[nodiscard]] constexpr bool may_have_beam_record(std::int64_t id) { return id == 25 || id == 31 || id == 32; }

/// Dataset 71 has graphical codes: the descriptor id of a code (0 if unknown), and back.
[[nodiscard]] std::int64_t descriptor_of_graphical(std::int64_t code);
[[nodiscard]] std::int64_t graphical_of_descriptor(std::int64_t id);

/// The descriptor to write for an element that has none (type 0), by shape and number of nodes.
[[nodiscard]] std::int64_t default_descriptor(Shape shape, std::size_t n);

}  // namespace meshgraft::unv
