#include "zone/chains.hpp"

#include <algorithm>
#include <cmath>

#include "zone/ruler.hpp"

namespace meshgraft {
namespace {

VertexId other_end(const EdgeTable& edges, EdgeId e, VertexId v) {
  const auto [a, b] = edges.ends(e);
  return a == v ? b : a;
}

/// Walks from `v` over `e` until a corner or the start edge.
void walk(Chain& chain, const EdgeTable& edges, const CurveDegree& degree, std::span<const std::uint8_t> corner) {
  const EdgeId start = chain.edges.front();
  while (!corner[chain.vertices.back().value]) {
    const VertexId v = chain.vertices.back();
    const auto& around = degree.around[v.value];
    const EdgeId e = around[0] == chain.edges.back() ? around[1] : around[0];
    if (e == start) {
      chain.closed = true;
      return;
    }
    chain.edges.push_back(e);
    chain.vertices.push_back(other_end(edges, e, v));
  }
}

void reverse(Chain& chain) {
  std::ranges::reverse(chain.vertices);
  std::ranges::reverse(chain.edges);
}

void start_at_smallest(Chain& chain) {
  chain.vertices.pop_back();
  const auto smallest = std::ranges::min_element(chain.vertices) - chain.vertices.begin();
  std::ranges::rotate(chain.vertices, chain.vertices.begin() + smallest);
  std::ranges::rotate(chain.edges, chain.edges.begin() + smallest);
  chain.vertices.push_back(chain.vertices.front());
  if (chain.vertices[1] > chain.vertices[chain.vertices.size() - 2]) reverse(chain);
}

Chain chain_through(EdgeId e, const EdgeTable& edges, const CurveDegree& degree, std::span<const std::uint8_t> corner) {
  const auto [a, b] = edges.ends(e);
  Chain chain{{a, b}, {e}, false};
  walk(chain, edges, degree, corner);
  if (chain.closed) {
    start_at_smallest(chain);
    return chain;
  }
  reverse(chain);
  // The walk began at `e`; go on from its other end.
  Chain back{{b, a}, {e}, false};
  walk(back, edges, degree, corner);
  chain.vertices.insert(chain.vertices.end(), back.vertices.begin() + 2, back.vertices.end());
  chain.edges.insert(chain.edges.end(), back.edges.begin() + 1, back.edges.end());
  const auto& v = chain.vertices;
  if (v.back() < v.front() || (v.back() == v.front() && v[v.size() - 2] < v[1])) reverse(chain);
  return chain;
}

}  // namespace

CurveDegree::CurveDegree(const EdgeTable& edges, const CurveEdges& curves, std::size_t n_vertices)
    : count(n_vertices, 0), around(n_vertices) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!curves.is_curve(EdgeId(i))) continue;
    for (const VertexId v : edges.ends(EdgeId(i)))
      if (const std::uint32_t k = count[v.value]++; k < 2) around[v.value][k] = EdgeId(i);
  }
}

bool CurveDegree::passes(VertexId v, const CurveEdges& curves) const {
  return count[v.value] == 2 && curves.kind[around[v.value][0].value] == curves.kind[around[v.value][1].value];
}

std::vector<Chain> chains(const EdgeTable& edges, const CurveEdges& curves, const CurveDegree& degree,
                          std::span<const std::uint8_t> corner) {
  std::vector<Chain> result;
  std::vector<std::uint8_t> used(edges.size(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!curves.is_curve(EdgeId(i)) || used[i]) continue;
    result.push_back(chain_through(EdgeId(i), edges, degree, corner));
    for (const EdgeId e : result.back().edges) used[e.value] = 1;
  }
  return result;
}

std::vector<VertexId> sharp_turns(const Chain& chain, std::span<const Vec3> position, std::span<const double> reach,
                                  double turn_angle) {
  std::vector<Vec3> points;
  for (const VertexId v : chain.vertices) points.push_back(position[v.value]);
  const std::vector<double> arc = arc_lengths(points);
  const double length = arc.back();
  const std::size_t n = points.size() - 1;  // edges

  const auto at = [&](double s) {
    if (chain.closed) s = s < 0 ? s + length : s > length ? s - length : s;
    return point_at(points, arc, std::clamp(s, 0.0, length));
  };
  // An end this near is the corner already; but a chain shorter than the reach is judged as it is.
  const auto is_at_end = [&](std::size_t i) {
    const double r = reach[chain.vertices[i].value];
    return !chain.closed && length > 2 * r && (arc[i] < r || length - arc[i] < r);
  };
  const auto turn = [&](std::size_t i) {
    const std::size_t before = i > 0 ? i - 1 : n - 1;
    const double r = reach[chain.vertices[i].value];
    const double back = std::max(r, arc[before + 1] - arc[before]), ahead = std::max(r, arc[i + 1] - arc[i]);
    if (chain.closed && back + ahead > length) return 0.0;  // all of it within reach: a dot, not a turn
    const Vec3 in = points[i] - at(arc[i] - back), out = at(arc[i] + ahead) - points[i];
    return std::atan2(norm(cross(in, out)), dot(in, out));
  };
  const std::size_t first = chain.closed ? 0 : 1;
  std::vector<double> turns(n, 0.0);
  for (std::size_t i = first; i < n; ++i) turns[i] = turn(i);

  std::vector<VertexId> result;
  for (std::size_t i = first; i < n; ++i) {
    if (turns[i] <= turn_angle || is_at_end(i)) continue;
    const double r = reach[chain.vertices[i].value];
    const auto outdone_by = [&](std::size_t j) {
      return turns[j] > turns[i] || (turns[j] == turns[i] && chain.vertices[j] < chain.vertices[i]);
    };
    // Walks along the chain in steps of `step` edges (n - 1 steps back) while within reach.
    const auto outdone_towards = [&](std::size_t step) {
      for (std::size_t j = (i + step) % n; j != i; j = (j + step) % n) {
        const bool wrapped = step == 1 ? j < i : j > i;
        if (wrapped && !chain.closed) return false;
        const double apart = std::abs(arc[i] - arc[j]);
        if ((wrapped ? length - apart : apart) >= r) return false;
        if (outdone_by(j)) return true;
      }
      return false;
    };
    if (!outdone_towards(1) && !outdone_towards(n - 1)) result.push_back(chain.vertices[i]);
  }
  return result;
}

}  // namespace meshgraft
