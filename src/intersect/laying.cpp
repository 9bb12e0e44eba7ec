#include "intersect/laying.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/text.hpp"
#include "geometry/angles.hpp"
#include "geometry/quality.hpp"
#include "intersect/common_area.hpp"

namespace meshgraft {
namespace {

constexpr double kFarthest = 0.25;         // of the edge length: beyond it features are not snapped either
constexpr double kSteepest = radians(60);  // from which faces are two surfaces
constexpr double kWithinAngle = 0.9, kWithinDistance = 0.8;  // share of the common area that is within the options
constexpr double kRoom = 1.01;                               // the tolerance over the distance
constexpr double kInDegrees = 180 / std::numbers::pi;

/// A face over another: how far off it is, at most, how much it leans, and over what area.
struct Over {
  double angle = 0, distance = 0, area = 0;
};

Over over(const Triangle& t, const Triangle& u, double gap) {
  const Vec3 n = unit_normal(t);
  const std::vector<Vec3> shared = within(part_over(u, t), t, {-gap, gap});
  Over found{std::acos(std::min(1.0, std::abs(dot(n, unit_normal(u))))), 0, area_of(shared)};
  for (const Vec3 p : shared) found.distance = std::max(found.distance, std::abs(dot(n, p - t[0])));
  return found;
}

/// Options in numbers; all 0 where nothing lies on anything.
struct Laying {
  double distance = 0, angle = 0;
};

Laying laying(const Complex& complex, const std::array<std::vector<FaceId>, 2>& sides, std::span<const double> size,
              const ContactRule& rule) {
  const Contacts contacts = find_contacts(complex, sides[0], sides[1], size, rule);
  std::vector<Over> all;
  double area = 0;
  for (std::size_t i = 0; i < contacts.pairs.size(); ++i) {
    if (contacts.on_each_other[i] == 0) continue;
    const auto [f, g] = contacts.pairs[i];
    all.push_back(over(complex.corners(f), complex.corners(g), rule.gap(std::min(size[f.value], size[g.value]))));
    area += all.back().area;
  }
  const auto up_to = [&](double share, double Over::*measure) {
    std::ranges::sort(all, {}, measure);
    double within = 0, least = 0;
    for (const Over& o : all)
      if (within < share * area) within += o.area, least = o.*measure;
    return least;
  };
  return {up_to(kWithinDistance, &Over::distance), up_to(kWithinAngle, &Over::angle)};
}

}  // namespace

std::optional<LayingAdvice> laying_advice(const Complex& complex,
                                          std::span<const std::array<std::vector<FaceId>, 2>> all,
                                          std::span<const double> size, const SnapRule& snap,
                                          const CorefineOptions& options) {
  CorefineOptions wide = options;
  wide.tolerance = {kFarthest, true}, wide.contact_angle = kSteepest;
  Laying needed{0, options.contact_angle};
  for (const auto& sides : all) {
    const Laying of_sides = laying(complex, sides, size, {wide, snap});
    needed.distance = std::max(needed.distance, of_sides.distance);
    needed.angle = std::max(needed.angle, of_sides.angle);
  }
  if (needed.distance <= 0) return std::nullopt;
  const double tolerance = kRoom * needed.distance, degrees = std::ceil(needed.angle * kInDegrees);
  std::string text =
      "if both are to be one surface there, as a bolt and the wall of its hole, lay them on each other: ";
  text += "--tolerance " + text_of(tolerance) + " --angle " + text_of(degrees);
  return LayingAdvice{tolerance, radians(degrees), std::move(text)};
}

}  // namespace meshgraft
