#include "intersect/cut_face.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

VertexId id(std::size_t v) { return VertexId(v); }

struct Problem {
  std::vector<Vec3> position{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  FaceToCut face{{id(0), id(1), id(2)}, {}, {}, {}};
  VertexId add(Vec3 p) {
    position.push_back(p);
    return id(position.size() - 1);
  }
};

/// The pieces cover the face, turn its way, and have every segment and piece of an edge as an edge.
void expect_valid(const Problem& p) {
  const auto pieces = cut(p.face, p.position);
  RC_ASSERT(pieces.has_value());
  double sum = 0;
  std::set<std::array<VertexId, 2>> edges;
  std::set<VertexId> used;
  for (const auto& v : *pieces) {
    const Vec3 n = area_vector({p.position[v[0].value], p.position[v[1].value], p.position[v[2].value]});
    RC_ASSERT(n.z > 0);
    sum += n.z;
    for (std::size_t k = 0; k < 3; ++k) {
      edges.insert({std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])});
      used.insert(v[k]);
    }
  }
  RC_ASSERT(std::abs(sum - 0.5) < 1e-12);
  RC_ASSERT(used.size() == p.position.size());
  for (auto s : p.face.segments) {
    std::sort(s.begin(), s.end());
    RC_ASSERT(edges.contains(s));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<VertexId> chain{p.face.corner[k]};
    chain.insert(chain.end(), p.face.on_edge[k].begin(), p.face.on_edge[k].end());
    chain.push_back(p.face.corner[(k + 1) % 3]);
    for (std::size_t i = 1; i < chain.size(); ++i)
      RC_ASSERT(edges.contains({std::min(chain[i - 1], chain[i]), std::max(chain[i - 1], chain[i])}));
  }
}

/// n points inside each edge, off the straight line by as much as rounding puts them.
void add_edge_points(Problem& p, std::array<std::size_t, 3> n) {
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 1; i <= n[k]; ++i) {
      const Vec3 a = p.position[p.face.corner[k].value], b = p.position[p.face.corner[(k + 1) % 3].value];
      p.face.on_edge[k].push_back(p.add(lerp(a, b, double(i) / double(n[k] + 1))));
    }
}

RC_GTEST_PROP(CutFace, PointsOnEdgesAndAFanOfSegments, ()) {
  Problem p;
  const auto count = [] { return std::size_t(*rc::gen::inRange(0, 30)); };
  add_edge_points(p, {count(), count(), count()});
  const VertexId centre = p.add({0.31, 0.27, 0});
  p.face.inside.push_back(centre);
  for (const auto& on : p.face.on_edge)
    for (const VertexId v : on)
      if (*rc::gen::inRange(0, 4) == 0) p.face.segments.push_back({v, centre});
  expect_valid(p);
}

RC_GTEST_PROP(CutFace, AChainAcrossIsNearlyStraight, ()) {
  Problem p;
  const std::size_t n = std::size_t(*rc::gen::inRange(1, 60));
  p.face.on_edge[0].push_back(p.add({1.0 / 3, 0, 0}));
  p.face.on_edge[1].push_back(p.add({2.0 / 3, 1 - 2.0 / 3, 0}));
  VertexId last = p.face.on_edge[0][0];
  for (std::size_t i = 1; i <= n; ++i) {
    const VertexId next = p.add(lerp(p.position[3], p.position[4], double(i) / double(n + 1)));
    p.face.inside.push_back(next);
    p.face.segments.push_back({last, next});
    last = next;
  }
  p.face.segments.push_back({last, p.face.on_edge[1][0]});
  expect_valid(p);
}

RC_GTEST_PROP(CutFace, PiecesInsideAreBridged, ()) {
  Problem p;
  const std::size_t rings = std::size_t(*rc::gen::inRange(1, 4)), n = *rc::gen::element<std::size_t>(1, 3, 4, 7, 14);
  for (std::size_t r = 0; r < rings; ++r) {
    const std::size_t first = p.position.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * double(i) / double(n), radius = 0.05 * double(r + 1);
      p.face.inside.push_back(p.add({0.3 + radius * std::cos(angle), 0.3 + radius * std::sin(angle), 0}));
      if (n > 1) p.face.segments.push_back({id(first + i), id(first + (i + 1) % n)});
    }
  }
  expect_valid(p);
}

TEST(CutFace, CrossingSegmentsAreRefused) {
  Problem p;
  for (const Vec3 q : {Vec3{0.2, 0.2, 0}, Vec3{0.4, 0.4, 0}, Vec3{0.4, 0.2, 0}, Vec3{0.2, 0.4, 0}})
    p.face.inside.push_back(p.add(q));
  p.face.segments = {{id(3), id(4)}, {id(5), id(6)}};
  EXPECT_FALSE(cut(p.face, p.position).has_value());
}

}  // namespace
}  // namespace meshgraft
