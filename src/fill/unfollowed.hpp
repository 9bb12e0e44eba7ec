// 1D elements in a hole that its filling does not follow, and why.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshgraft/id.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft {

/// Why a 1D element in a hole is no edge of what fills it.
enum class Obstacle : std::uint8_t {
  kNoLength,
  kSamePlace,  // in the place of a node of it another is followed
  kBeside,     // it passes over faces around the hole
  kTooSteep,
  kTooLong,
  kCutOff,     // only others with an obstacle lead from it to a rim
  kNoFaces,    // no faces can be made along it
  kPoorFaces,  // those that can are poor, or break another promise
};

struct UnfollowedBeam {
  ElementId element;
  Obstacle why{};
};

/// Warnings beam-not-followed, one for each obstacle: how many elements, the first with its place, and advice.
[[nodiscard]] std::vector<Warning> warnings_about(std::span<const UnfollowedBeam> beams, const Model& base);

}  // namespace meshgraft
