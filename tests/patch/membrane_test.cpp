// Membranes over triangulations that are far from any smooth surface.
#include "patch/membrane.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

/// A round rim, a ring of free nodes inside and one more in the middle, all of them at places that mean nothing.
struct Tangle {
  static constexpr std::uint32_t kSides = 12;
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::uint8_t> is_free;

  template <class Place>
  explicit Tangle(Place&& place) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double a = 2 * std::numbers::pi * i / kSides;
      position.push_back({std::cos(a), std::sin(a), 0.3 * std::cos(2 * a)});
    }
    for (std::uint32_t i = 0; i <= kSides; ++i) position.push_back(place());
    is_free.assign(position.size(), 1);
    std::fill_n(is_free.begin(), kSides, std::uint8_t{0});
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t j = (i + 1) % kSides;
      faces.push_back({i, j, kSides + j}), faces.push_back({i, kSides + j, kSides + i});
      faces.push_back({kSides + i, kSides + j, 2 * kSides});
    }
  }
};

TEST(Membrane, NoFaceIsFoldedInARoundRimHoweverTheNodesLie) {
  rc::check([] {
    const auto coordinate = [] { return 0.001 * *rc::gen::inRange(-2000, 2000); };
    const Tangle tangle([&] { return Vec3{coordinate(), coordinate(), coordinate()}; });
    const auto position = on_membrane(tangle.faces, tangle.position, tangle.is_free);
    for (std::size_t v = 0; v < Tangle::kSides; ++v) RC_ASSERT(position[v] == tangle.position[v]);
    for (const auto& f : tangle.faces) {
      const double seen = area_vector({position[f[0]], position[f[1]], position[f[2]]}).z;
      // Nodes that all but coincide hold each other with weights beyond any measure.
      RC_ASSERT(seen > -1e-9);
    }
    for (const Vec3 p : position) RC_ASSERT(std::abs(p.z) <= 0.3 + 1e-9);
  });
}

TEST(Membrane, FreeNodesOfAPlaneMeshStayWhereTheyAre) {
  std::uint32_t next = 0;
  const Tangle tangle([&] {
    const double r = next < Tangle::kSides ? 0.3 + 0.05 * (next % 4) : 0,
                 a = 2 * std::numbers::pi * next / Tangle::kSides;
    ++next;
    return Vec3{0.1 + r * std::cos(a), r * std::sin(a), 0};
  });
  auto flat = tangle.position;
  for (Vec3& p : flat) p.z = 0.5 * p.x;
  const auto position = on_membrane(tangle.faces, flat, tangle.is_free);
  for (std::size_t v = 0; v < flat.size(); ++v) EXPECT_LT(distance(position[v], flat[v]), 1e-12);
}

}  // namespace
}  // namespace meshgraft
