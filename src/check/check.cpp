#include "meshgraft/check.hpp"

#include <algorithm>
#include <numeric>

#include "check/checks.hpp"
#include "check/face_pairs.hpp"
#include "geometry/coincident_nodes.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kCoincident = 1e-9;  // of the box of the model: below what file formats write
constexpr double kFirstPercentile = 0.01;

/// Sorts out the faces: those without area are listed, those without a node cannot be looked at further.
Faces faces_of(const Model& model, const CheckOptions& options, CheckResult& result) {
  const auto degenerate = [&](ElementId e) {
    if (++result.n_degenerate_faces <= options.max_places) result.degenerate_faces.push_back(e);
  };
  Faces faces;
  for (std::size_t i = 0; i < model.n_elements(); ++i) {
    const ElementId e(i);
    if (!model.is_face(e)) continue;
    ++result.faces;
    const auto v = model.nodes_of(e);
    if (!std::ranges::all_of(v, &NodeId::valid)) {
      degenerate(e);
      continue;
    }
    faces.element.push_back(e);
    faces.corner.push_back({v[0].value, v[1].value, v[2].value});
    if (is_degenerate(faces.corner.back(), model.corners(e))) degenerate(e);
  }
  return faces;
}

}  // namespace

void check_quality(const Model& model, const Faces& faces, const CheckOptions& options, CheckResult& result) {
  const std::size_t m = faces.element.size();
  if (m == 0) return;
  std::vector<double> q(m);
  for (std::size_t f = 0; f < m; ++f) {
    const Triangle t = model.corners(faces.element[f]);
    q[f] = aspect_ratio(t);
    result.area += area(t);
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t f = 0; f < m; ++f)
    if (q[f] < options.min_quality) order.push_back(f);
  result.below_min_quality = order.size();
  const auto worst = order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), options.max_places));
  std::ranges::partial_sort(order, worst, {}, [&](std::uint32_t f) { return std::pair(q[f], f); });
  for (auto f = order.begin(); f != worst; ++f) result.worst_faces.emplace_back(faces.element[*f], q[*f]);

  result.mean_q = std::accumulate(q.begin(), q.end(), 0.0) / static_cast<double>(m);
  const auto p01 = q.begin() + static_cast<std::ptrdiff_t>(kFirstPercentile * static_cast<double>(m - 1));
  std::ranges::nth_element(q, p01);
  result.p01_q = *p01;
  result.min_q = *std::min_element(q.begin(), p01 + 1);
}

void check_duplicates(const Faces& faces, const CheckOptions& options, CheckResult& result) {
  std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> sorted;  // nodes ascending, face
  sorted.reserve(faces.corner.size());
  for (std::uint32_t f = 0; f < faces.corner.size(); ++f) {
    auto nodes = faces.corner[f];
    std::ranges::sort(nodes);
    sorted.emplace_back(nodes, f);
  }
  std::ranges::sort(sorted);
  for (std::size_t i = 1, first = 0; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[first].first)
      first = i;
    else if (++result.n_duplicate_faces <= options.max_places)
      result.duplicate_faces.emplace_back(faces.element[sorted[first].second], faces.element[sorted[i].second]);
  }
}

void check_places(const Model& model, const Faces& faces, const CheckOptions& options, CheckResult& result) {
  const auto pairs = coincident_nodes(model.position, kCoincident * result.box.diagonal());
  std::vector<std::uint32_t> one(model.n_nodes());
  std::iota(one.begin(), one.end(), 0u);
  for (const auto& [first, second] : pairs) {
    one[second] = first;
    if (result.coincident_nodes.size() < options.max_places)
      result.coincident_nodes.emplace_back(NodeId(std::size_t{first}), NodeId(std::size_t{second}));
  }
  result.n_coincident_nodes = pairs.size();

  std::vector<std::array<std::uint32_t, 3>> corner = faces.corner;
  for (auto& v : corner)
    for (std::uint32_t& n : v) n = one[n];
  auto meeting = intersecting_pairs(model.position, corner);
  std::erase_if(meeting, [&](const auto& pair) {  // duplicates are counted as such
    return std::ranges::is_permutation(faces.corner[pair[0]], faces.corner[pair[1]]);
  });
  result.intersections = meeting.size();
  for (std::size_t i = 0; i < std::min(meeting.size(), options.max_places); ++i)
    result.intersecting_faces.emplace_back(faces.element[meeting[i][0]], faces.element[meeting[i][1]]);
}

void check_orphans(const Model& model, const CheckOptions& options, CheckResult& result) {
  std::vector<std::uint8_t> used(model.n_nodes(), 0);
  for (const NodeId n : model.nodes)
    if (n.valid()) used[n.value] = 1;
  for (const OrientationNode& o : model.orientation_nodes)
    if (o.node.valid()) used[o.node.value] = 1;
  for (std::size_t n = 0; n < used.size(); ++n) {
    if (used[n]) continue;
    ++result.n_orphan_nodes;
    if (result.orphan_nodes.size() < options.max_places) result.orphan_nodes.emplace_back(n);
  }
}

void check_groups(const Model& model, CheckResult& result) {
  for (const Group& g : model.groups) {
    result.dangling_group_entries += g.n_dangling;
    if (g.n_nodes + g.n_elements + g.n_other == 0) ++result.empty_groups;
  }
}

CheckResult check(const Model& model, const CheckOptions& options) {
  CheckResult result;
  for (const Vec3 p : model.position) result.box.add(p);
  const Faces faces = faces_of(model, options, result);
  check_edges(model, faces, options, result);
  check_quality(model, faces, options, result);
  check_duplicates(faces, options, result);
  check_lines(model, options, result);
  check_places(model, faces, options, result);
  check_orphans(model, options, result);
  check_groups(model, result);
  return result;
}

}  // namespace meshgraft
