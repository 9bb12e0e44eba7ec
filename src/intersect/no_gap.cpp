#include "intersect/no_gap.hpp"

#include <algorithm>

#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

bool would_flatten(const Meeting& m, std::size_t s, VertexId v, LocalFace g) {
  const auto is_on = [&](VertexId w) {
    return w == v || m.any_symbol(s, w, [&](const Symbol& symbol) { return m.on_face(symbol, 1 - s, g); });
  };
  const auto faces = m.side[s].faces_at(v);
  return std::any_of(faces.begin(), faces.end(), [&](LocalFace f) {
    const auto& corners = m.side[s].corners(f);
    return std::all_of(corners.begin(), corners.end(), is_on);
  });
}

}  // namespace

bool would_flatten(const Meeting& m, std::size_t s, VertexId v, const Carrier& on) {
  if (on.kind == Carrier::kFace) return would_flatten(m, s, v, on.id);
  const auto faces = m.side[1 - s].faces_at_edge(on.id);
  return std::any_of(faces.begin(), faces.end(), [&](LocalFace g) { return would_flatten(m, s, v, g); });
}

bool have_met(const Meeting& m, std::size_t s, VertexId v, LocalEdge e) {
  constexpr double kOff = 0.5;  // sine of the angle from which edges with a common end do not run along each other
  const Side &own = m.side[s], &other = m.side[1 - s];
  if (!other.is_free(e)) return false;
  const auto& [low, high] = other.ends(e);
  const Vec3 along = normalized(m.at(high) - m.at(low));
  const auto distance_of = [&](VertexId w) {
    return distance(m.at(w), closest_on_segment(m.at(w), m.at(low), m.at(high)).point);
  };
  const auto comes_by = [&](VertexId w) {
    const LocalEdge f = own.find(v, w);
    return f != kNowhere && (own.is_free(f) || own.n_faces_at(f) > 2) &&
           norm(cross(along, normalized(m.at(v) - m.at(w)))) > kOff && distance_of(w) < distance_of(v) &&
           (m.any_symbol(s, w, [&](const Symbol& symbol) { return m.on_edge(symbol, 1 - s, e); }) ||
            have_met(m, s, w, e));
  };
  return std::ranges::any_of(own.faces_at(v),
                             [&](LocalFace f) { return std::ranges::any_of(own.corners(f), comes_by); });
}

bool is_beyond_own_face(const Meeting& m, std::size_t s, VertexId v, LocalEdge e) {
  const Side& own = m.side[s];
  const auto& [low, high] = m.side[1 - s].ends(e);
  const LocalEdge same = own.find(low, high);
  if (same == kNowhere) return false;
  const auto component = [&](LocalFace f) { return m.complex.component[own.face(f).value]; };
  // In reach, even where a face that could not be cut is not to be drawn for now.
  const auto is_in_reach = [&](VertexId w) {
    const double gap = distance(m.at(w), closest_on_segment(m.at(w), m.at(low), m.at(high)).point);
    const auto size = [&](std::size_t side, LocalFace f) { return m.size[m.side[side].face(f).value]; };
    return std::ranges::any_of(own.faces_at(w), [&](LocalFace f) {
      return std::ranges::any_of(m.side[1 - s].faces_at_edge(e), [&](LocalFace g) {
        return gap <= m.rule.at(std::min(size(s, f), size(1 - s, g))).feature;
      });
    });
  };
  const auto may_land = [&](VertexId w) {
    return w == v || m.any_symbol(s, w, [&](const Symbol& symbol) { return m.on_edge(symbol, 1 - s, e); }) ||
           (m.ending.vertex[s][w.value] != 0 && is_in_reach(w));
  };
  return std::ranges::any_of(own.faces_at_edge(same), [&](LocalFace f) {
    const auto is_of_its_mesh = [&](LocalFace g) { return component(f) == component(g); };
    return std::ranges::any_of(own.faces_at(v), is_of_its_mesh) && !std::ranges::all_of(own.corners(f), may_land);
  });
}

}  // namespace meshgraft
