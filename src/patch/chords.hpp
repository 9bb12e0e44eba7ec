// Straight ways across an opening that cross none of its contours.
#pragma once

#include <optional>
#include <vector>

#include "patch/opening.hpp"

namespace meshgraft {

/// A closed chain of corners with the opening on its left.
using Ring = std::vector<VertexId>;

struct Chord {
  std::size_t from = 0;  // corner of the first ring
  std::size_t to = 0;    // of the second ring
};

/// Looks for chords among the sides of all rings given. Signs are exact in the coordinate plane that the normal at
/// the chord points out of most; in a curved opening only sides near the chord count.
class Chords {
 public:
  Chords(const Opening& opening, std::vector<const Ring*> rings) : opening_(opening), rings_(std::move(rings)) {}

  /// The shortest from a corner of `a` to one of `b`; equal ones: the smaller corners.
  [[nodiscard]] std::optional<Chord> shortest_between(const Ring& a, const Ring& b) const;
  /// The shortest across a ring that leaves at least `least` of its sides on either side.
  [[nodiscard]] std::optional<Chord> shortest_across(const Ring& ring, std::size_t least) const;

 private:
  struct Candidate {
    double length;  // squared
    Chord chord;
  };
  [[nodiscard]] std::optional<Chord> first_clear(std::vector<Candidate>& candidates, const Ring& a,
                                                 const Ring& b) const;
  [[nodiscard]] bool is_clear(const Ring& a, std::size_t i, const Ring& b, std::size_t j) const;

  const Opening& opening_;
  std::vector<const Ring*> rings_;
};

}  // namespace meshgraft
