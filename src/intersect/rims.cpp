#include "intersect/rims.hpp"

#include <algorithm>
#include <utility>

#include "core/distinct.hpp"
#include "intersect/contact.hpp"

namespace meshgraft {
namespace {

/// The faces of one component near others, and those of the others near it.
struct Surroundings {
  std::vector<FaceId> own, others;  // ascending
};

std::vector<Surroundings> surroundings(const Complex& complex, std::span<const NearFaces> near) {
  std::vector<Surroundings> of(near.size());
  for (std::size_t c = 0; c < near.size(); ++c) {
    of[c].own.insert(of[c].own.end(), near[c].own.begin(), near[c].own.end());
    of[c].others.insert(of[c].others.end(), near[c].earlier.begin(), near[c].earlier.end());
    std::vector<std::uint32_t> earlier;
    for (const FaceId f : near[c].earlier) {
      earlier.push_back(complex.component[f.value]);
      of[earlier.back()].own.push_back(f);
    }
    make_distinct(earlier);
    for (const std::uint32_t d : earlier)
      of[d].others.insert(of[d].others.end(), near[c].own.begin(), near[c].own.end());
  }
  for (Surroundings& s : of) make_distinct(s.own), make_distinct(s.others);
  return of;
}

bool are_of_several(const Complex& complex, std::span<const FaceId> faces) {
  return std::ranges::any_of(
      faces, [&](FaceId f) { return complex.component[f.value] != complex.component[faces.front().value]; });
}

/// Those of the first side, ascending.
std::vector<FaceId> lying_faces(const Contacts& contacts) {
  std::vector<FaceId> lying;
  for (std::size_t i = 0; i < contacts.pairs.size(); ++i)
    if (contacts.on_each_other[i] != 0) lying.push_back(contacts.pairs[i][0]);
  make_distinct(lying);
  return lying;
}

/// By face of the complex, whether it is of `own` and has no vertex of a lying face. Those that have one are drawn with
/// it, lest corners between free edges be drawn by half.
std::vector<std::uint8_t> not_beside(const Complex& complex, std::span<const FaceId> own,
                                     std::span<const FaceId> lying) {
  std::vector<VertexId> corners;
  for (const FaceId f : lying)
    corners.insert(corners.end(), complex.face[f.value].begin(), complex.face[f.value].end());
  make_distinct(corners);
  std::vector<std::uint8_t> is_not(complex.n_faces());
  for (const FaceId f : own)
    is_not[f.value] =
        std::ranges::none_of(complex.face[f.value], [&](VertexId v) { return std::ranges::binary_search(corners, v); });
  return is_not;
}

/// Extensions to others that `own` does not lie on; see extensions().
Extensions across(const Complex& complex, std::uint32_t component, std::span<const FaceId> own,
                  std::span<const FaceId> others, std::span<const double> size, std::span<const std::uint8_t> exact,
                  const SnapRule& snap, const CorefineOptions& options) {
  ExtendRule rule{options.tolerance, snap};
  rule.least_angle = options.contact_angle;
  return extensions(complex, own, others, faces_with(complex, component), size, exact, rule);
}

}  // namespace

Extensions rim_extensions(const Complex& complex, std::uint32_t component, std::span<const FaceId> own,
                          std::span<const FaceId> others, std::span<const double> size, const SnapRule& snap,
                          const CorefineOptions& options) {
  if (!are_of_several(complex, others)) return {};
  const std::vector<FaceId> lying = lying_faces(find_contacts(complex, own, others, size, {options, snap}));
  if (lying.empty()) return {};
  return across(complex, component, own, others, size, not_beside(complex, own, lying), snap, options);
}

Rims find_rims(const Complex& complex, std::span<const NearFaces> near, std::span<const double> size,
               const SnapRule& snap, const CorefineOptions& options) {
  Rims rims;
  constexpr std::size_t kFewest = 3;  // meshes: one with a rim, one beneath it, one that it ends on
  if (near.size() < kFewest) return rims;
  Extensions& all = rims.extensions;
  const std::vector<Surroundings> around = surroundings(complex, near);
  for (std::uint32_t c = 1; c < around.size(); ++c) {
    if (complex.joins.mesh_of(c) == complex.joins.mesh_of(0)) continue;
    const auto& [own, others] = around[c];
    if (!are_of_several(complex, others)) continue;
    const Extensions of_one = rim_extensions(complex, c, own, others, size, snap, options);
    all.moved.insert(all.moved.end(), of_one.moved.begin(), of_one.moved.end());
    all.bends.insert(all.bends.end(), of_one.bends.begin(), of_one.bends.end());
    for (const std::uint32_t d : of_one.ended_on) rims.ends.push_back({c, d});
    for (const std::uint32_t d : across(complex, c, own, others, size, {}, snap, options).ended_on)
      rims.ends.push_back({c, d});
  }
  make_distinct(rims.ends);
  return rims;
}

std::vector<std::uint32_t> ranks(std::size_t n_components, std::span<const std::array<std::uint32_t, 2>> ends) {
  std::vector<std::uint8_t> begun(n_components);
  std::vector<std::uint32_t> rank(n_components);
  std::uint32_t next = 0;
  const auto join = [&](auto&& self, std::uint32_t c) -> void {
    if (std::exchange(begun[c], std::uint8_t{1}) != 0) return;  // also where meshes end on each other in a circle
    for (const auto& [ending, on] : std::ranges::equal_range(ends, c, {}, [](const auto& e) { return e[0]; }))
      self(self, on);
    rank[c] = next++;
  };
  for (std::uint32_t c = 0; c < n_components; ++c) join(join, c);
  return rank;
}

}  // namespace meshgraft
