#include "intersect/thin_parts.hpp"

#include <algorithm>
#include <tuple>

#include "core/blocks.hpp"
#include "core/text.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kFaceBlock = 256;  // faces compared with the tree in one go

bool are_neighbours(const Complex& complex, FaceId f, FaceId g) {
  return std::ranges::find_first_of(complex.face[f.value], complex.face[g.value]) != complex.face[f.value].end();
}

/// Faces that are flat to others within the tolerance which are not their neighbours, ascending.
std::vector<FaceId> doubtful_faces(const Complex& complex, std::span<const FaceId> faces, std::span<const double> size,
                                   const ContactRule& rule) {
  std::vector<Box> boxes(faces.size());
  std::vector<Vec3> normal;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (const Vec3 p : complex.corners(faces[i])) boxes[i].add(p);
    normal.push_back(unit_normal(complex.corners(faces[i])));
  }
  const BoxTree tree(boxes);
  return collected<FaceId>(
      faces.size(),
      [&](std::size_t i, std::vector<FaceId>& doubtful) {
        bool found = false;
        tree.overlapping(boxes[i].grown(rule.gap(size[faces[i].value])), [&](std::uint32_t j) {
          found = found || (rule.is_flat(normal[i], normal[j]) && !are_neighbours(complex, faces[i], faces[j]));
        });
        if (found) doubtful.push_back(faces[i]);
      },
      kFaceBlock);
}

/// From the corners of each to the other.
double distance_between(const Triangle& t, const Triangle& u) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3 p : t) least = std::min(least, distance(p, closest_on_triangle(p, u).point));
  for (const Vec3 p : u) least = std::min(least, distance(p, closest_on_triangle(p, t).point));
  return least;
}

}  // namespace

std::optional<JunctionFault> find_thin_part(const Complex& complex, std::span<const FaceId> faces,
                                            std::span<const double> size, const ContactRule& rule) {
  const std::vector<FaceId> doubtful = doubtful_faces(complex, faces, size, rule);
  if (doubtful.empty()) return std::nullopt;
  const Contacts contacts = find_contacts(complex, doubtful, doubtful, size, rule);
  struct Found {
    double distance = std::numeric_limits<double>::infinity();
    std::array<FaceId, 2> pair;
  } nearest;
  for (std::size_t k = 0; k < contacts.pairs.size(); ++k) {
    const auto& [f, g] = contacts.pairs[k];
    if (contacts.on_each_other[k] == 0 || f >= g || are_neighbours(complex, f, g)) continue;
    const double d = distance_between(complex.corners(f), complex.corners(g));
    if (d > rule.weld(std::min(size[f.value], size[g.value])) && d < nearest.distance) nearest = {d, {f, g}};
  }
  const auto& [f, g] = nearest.pair;
  if (!f.valid()) return std::nullopt;
  const double gap = rule.gap(std::min(size[f.value], size[g.value]));
  return JunctionFault{ErrorCode::kUsage,
                       "the tolerance of " + text_of(gap) +
                           " would weld the two sides of one mesh together, which are " + text_of(nearest.distance) +
                           " apart",
                       {complex.parent[f.value], complex.parent[g.value]},
                       centroid(complex.corners(f)),
                       "give a --tolerance below that distance"};
}

}  // namespace meshgraft
