#include "intersect/stacks.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/distinct.hpp"
#include "core/text.hpp"
#include "geometry/closest.hpp"
#include "geometry/quality.hpp"
#include "intersect/common_area.hpp"

namespace meshgraft {
namespace {

/// Pairs of components that lie over one face of the second side, ascending.
std::vector<std::array<std::uint32_t, 2>> over_each_other(const Complex& complex, std::span<const Triangle> lying_at,
                                                          const Contacts& contacts) {
  std::map<FaceId, std::vector<FaceId>> on;  // by face of the second side
  for (std::size_t i = 0; i < contacts.pairs.size(); ++i)
    if (contacts.on_each_other[i] != 0) on[contacts.pairs[i][1]].push_back(contacts.pairs[i][0]);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (const auto& [g, faces] : on)
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const std::uint32_t a = complex.component[faces[i].value], b = complex.component[faces[j].value];
        if (a != b && have_common_area(lying_at[faces[i].value], lying_at[faces[j].value]) &&
            have_common_area(complex.corners(faces[i]), complex.corners(faces[j])))
          pairs.push_back({std::min(a, b), std::max(a, b)});
      }
  make_distinct(pairs);
  return pairs;
}

bool are_neighbours(const Complex& complex, FaceId f, FaceId g) {
  const auto &v = complex.face[f.value], &w = complex.face[g.value];
  return std::ranges::find_first_of(v, w) != v.end();
}

bool lie_over_each_other(const Triangle& t, const Triangle& u) {
  constexpr double kShare = 0.05;  // of the smaller area; facets of one curved surface have less in common
  return area_of(part_over(u, t, 0)) > kShare * std::min(area(t), area(u));
}

}  // namespace

std::optional<JunctionFault> find_two_layers(const Complex& complex, std::span<const Triangle> lying_at,
                                             const Contacts& contacts) {
  for (const std::size_t s : {0, 1}) {
    std::map<FaceId, std::vector<FaceId>> on;  // by face of the other side
    for (std::size_t i = 0; i < contacts.pairs.size(); ++i)
      if (contacts.on_each_other[i] != 0) on[contacts.pairs[i][1 - s]].push_back(contacts.pairs[i][s]);
    for (const auto& [g, faces] : on)
      for (std::size_t i = 0; i < faces.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const FaceId a = faces[j], b = faces[i];
          if (complex.component[a.value] != complex.component[b.value] || are_neighbours(complex, a, b) ||
              !lie_over_each_other(lying_at[a.value], lying_at[b.value]) ||
              !lie_over_each_other(complex.corners(a), complex.corners(b)))
            continue;
          const Vec3 middle = centroid(lying_at[b.value]);
          const double apart = distance(middle, closest_on_triangle(middle, lying_at[a.value]).point);
          return JunctionFault{ErrorCode::kOverlap,
                               "two layers of one mesh, " + text_of(apart) + " apart, lie on one face of another",
                               {complex.parent[a.value], complex.parent[b.value], complex.parent[g.value]},
                               centroid(complex.corners(g)),
                               "one plate cannot be one with both: give a --tolerance below its distance to the "
                               "farther layer, or cut that "
                               "layer off as a mesh of its own"};
        }
  }
  return std::nullopt;
}

std::vector<std::uint32_t> take_out_behind(const Complex& complex, std::span<const Triangle> lying_at,
                                           Contacts& contacts) {
  std::vector<std::uint32_t> behind;
  for (const auto& [first, second] : over_each_other(complex, lying_at, contacts))
    if (!std::ranges::binary_search(behind, first)) {
      behind.push_back(second);
      make_distinct(behind);
    }
  if (behind.empty()) return behind;
  Contacts left;
  for (std::size_t i = 0; i < contacts.pairs.size(); ++i) {
    if (std::ranges::binary_search(behind, complex.component[contacts.pairs[i][0].value])) continue;
    left.pairs.push_back(contacts.pairs[i]), left.on_each_other.push_back(contacts.on_each_other[i]);
  }
  contacts = std::move(left);
  return behind;
}

void draw_together(LyingMeeting& l) {
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  // of where it lay
    Vec3 to;
  };
  const std::size_t s = l.goes();
  const double all_the_way = std::numeric_limits<double>::infinity();
  const bool is_bent = std::ranges::any_of(l.pairs, [&](const FacePair& p) {
    const FaceId g = l.meeting.side[s].face(p[s]);
    return l.unbent[g.value] != l.meeting.complex.corners(g);
  });
  std::map<VertexId, Nearest> nearest;
  for (const FacePair& p : l.pairs) {
    const FaceId f = l.meeting.side[l.stays].face(p[l.stays]), g = l.meeting.side[s].face(p[s]);
    const Triangle t = l.triangle(l.stays, p[l.stays]);
    const Vec3 n = unit_normal(t);
    const Triangle& u = l.unbent[g.value];
    Reach between;
    if (is_bent) {
      between = {-all_the_way, all_the_way};
    } else if (!l.reach.empty()) {
      const Reach own = dot(n, unit_normal(u)) > 0 ? l.reach[g.value].turned() : l.reach[g.value];
      between = {l.reach[f.value].low + own.low, l.reach[f.value].high + own.high};
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = l.meeting.side[s].corners(p[s])[k];
      const double d = distance(u[k], closest_on_triangle(u[k], t).point);
      if (d >= nearest[v].distance) continue;
      nearest[v] = {d, u[k] - std::clamp(dot(n, u[k] - t[0]), between.low, between.high) * n};
    }
  }
  for (const auto& [v, drawn] : nearest) l.meeting.chart[s][v.value] = drawn.to;
}

double height_above(const Triangle& face, const Triangle& other) {
  const Vec3 n = unit_normal(face), m = unit_normal(other);
  return dot(m, other[0] - centroid(face)) / dot(m, n);
}

}  // namespace meshgraft
