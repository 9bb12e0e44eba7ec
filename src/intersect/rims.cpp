#include "intersect/rims.hpp"

#include <algorithm>
#include <numeric>
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

bool are_of_several(const Complex& complex, const std::vector<FaceId>& faces) {
  return std::ranges::any_of(
      faces, [&](FaceId f) { return complex.component[f.value] != complex.component[faces.front().value]; });
}

}  // namespace

Rims find_rims(const Complex& complex, std::span<const NearFaces> near, std::span<const double> size,
               const SnapRule& snap, const CorefineOptions& options) {
  Rims rims;
  constexpr std::size_t kFewest = 3;  // meshes: one with a rim, one beneath it, one that it ends on
  if (near.size() < kFewest) return rims;
  Extensions& all = rims.extensions;
  const std::vector<Surroundings> around = surroundings(complex, near);
  const Joins& joins = complex.joins;
  for (std::uint32_t c = 1; c < around.size(); ++c) {
    if (joins.mesh_of(c) == joins.mesh_of(0)) continue;
    const auto& [own, others] = around[c];
    if (!are_of_several(complex, others)) continue;
    const Contacts contacts = find_contacts(complex, own, others, size, {options, snap});
    std::vector<std::uint8_t> is_elsewhere(complex.n_faces());  // own faces that lie on nothing
    for (const FaceId f : own) is_elsewhere[f.value] = 1;
    for (std::size_t i = 0; i < contacts.pairs.size(); ++i)
      if (contacts.on_each_other[i] != 0) is_elsewhere[contacts.pairs[i][0].value] = 0;
    if (std::ranges::all_of(own, [&](FaceId f) { return is_elsewhere[f.value] != 0; })) continue;
    std::vector<std::uint8_t> owns(complex.n_faces());
    for (std::size_t f = 0; f < owns.size(); ++f) {
      const std::uint32_t d = complex.component[f];
      owns[f] = d == c || (joins.mesh_of(d) == joins.mesh_of(c) && !joins.are_joined(d, c));
    }
    ExtendRule rule{options.tolerance, snap};
    rule.least_angle = options.contact_angle;
    const Extensions of_one = extensions(complex, own, others, owns, size, is_elsewhere, rule);
    all.moved.insert(all.moved.end(), of_one.moved.begin(), of_one.moved.end());
    all.bends.insert(all.bends.end(), of_one.bends.begin(), of_one.bends.end());
    for (const std::uint32_t d : of_one.ended_on) rims.ends.push_back({c, d});
  }
  return rims;
}

std::vector<std::uint32_t> ranks(std::size_t n_components, std::span<const std::array<std::uint32_t, 2>> ends) {
  std::vector<std::uint32_t> before(n_components), order(n_components), rank(n_components);
  std::iota(before.begin(), before.end(), 0u), std::iota(order.begin(), order.end(), 0u);
  for (const auto& [rim, on] : ends) before[on] = std::min(before[on], rim);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t c) { return std::pair(before[c], before[c] == c); });
  for (std::uint32_t k = 0; k < order.size(); ++k) rank[order[k]] = k;
  return rank;
}

}  // namespace meshgraft
