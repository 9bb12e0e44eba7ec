#include "checks.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "geometry/predicates.hpp"
#include "geometry/quality.hpp"

namespace meshgraft::checks {
namespace {

using Edge = std::array<VertexId, 2>;

Edge edge_of(const std::array<VertexId, 3>& f, std::size_t k) {
  return {std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])};
}

bool has(const std::array<VertexId, 3>& f, VertexId v) { return std::find(f.begin(), f.end(), v) != f.end(); }

class Checker {
 public:
  Checker(const Complex& before, const Corefined& after, const CorefineOptions& options, const Check& check)
      : before_(before), after_(after), c_(after.complex), options_(options), check_(check) {}

  std::vector<std::string> run() {
    check_conforming();
    check_faithful();
    check_complete();
    check_joined();
    check_bounded();
    return std::move(faults_);
  }

 private:
  template <class... T>
  void fault(const T&... parts) {
    std::ostringstream text;
    ((text << parts), ...);
    if (faults_.size() < 10) faults_.push_back(text.str());
  }
  [[nodiscard]] Vec3 at(VertexId v) const { return c_.position[v.value]; }
  [[nodiscard]] double weld(std::size_t f, std::size_t g) const {
    return 0.5 * options_.weld_share * std::min(parent_size(f), parent_size(g));
  }
  [[nodiscard]] double parent_size(std::size_t f) const { return mean_edge_length(before_.corners(parent(f))); }
  [[nodiscard]] FaceId parent(std::size_t f) const {
    if (by_parent_.empty())
      for (std::size_t g = 0; g < before_.n_faces(); ++g) by_parent_.emplace(before_.parent[g], FaceId(g));
    return by_parent_.at(c_.parent[f]);
  }

  void check_conforming() {
    std::vector<Box> boxes;
    for (std::size_t f = 0; f < c_.n_faces(); ++f) {
      boxes.emplace_back();
      for (const Vec3 p : c_.corners(FaceId(f))) boxes.back().add(p);
    }
    const BoxTree tree(boxes);
    for (std::size_t f = 0; f < c_.n_faces(); ++f)
      tree.overlapping(boxes[f].grown(options_.weld_share * parent_size(f)), [&](std::uint32_t g) {
        if (c_.component[f] != c_.component[g]) check_pair(f, g);
      });
  }

  void check_pair(std::size_t f, std::size_t g) {
    const auto &v = c_.face[f], &w = c_.face[g];
    const Triangle t = c_.corners(FaceId(g));
    std::size_t shared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      shared += has(w, v[k]);
      const VertexId a = v[k], b = v[(k + 1) % 3];
      if (!has(w, a) && distance(at(a), closest_on_triangle(at(a), t).point) < weld(f, g))
        fault("vertex ", a.value, " of face ", f, " lies on face ", g);
      if (has(w, a) || has(w, b)) continue;
      const int sa = orientation_sign(t[0], t[1], t[2], at(a)), sb = orientation_sign(t[0], t[1], t[2], at(b));
      const int s0 = orientation_sign(at(a), at(b), t[0], t[1]), s1 = orientation_sign(at(a), at(b), t[1], t[2]),
                s2 = orientation_sign(at(a), at(b), t[2], t[0]);
      if (sa * sb < 0 && s0 == s1 && s1 == s2) fault("edge ", a.value, "-", b.value, " passes through face ", g);
      for (std::size_t l = 0; l < 3; ++l) {
        if (has(v, w[l]) || has(v, w[(l + 1) % 3])) continue;
        const SegmentPair near = closest_between_segments(at(a), at(b), t[l], t[(l + 1) % 3]);
        if (distance(near.first.point, near.second.point) < weld(f, g))
          fault("edge ", a.value, "-", b.value, " meets an edge of face ", g);
      }
    }
    if (shared == 2) check_not_folded(f, g);
    if (shared == 3) fault("faces ", f, " and ", g, " are the same");
  }

  /// Two faces on one edge, on the same side of it and flat to each other, overlap.
  void check_not_folded(std::size_t f, std::size_t g) {
    std::vector<Vec3> edge, apex;
    for (const VertexId v : c_.face[f]) (has(c_.face[g], v) ? edge : apex).push_back(at(v));
    for (const VertexId v : c_.face[g])
      if (!has(c_.face[f], v)) apex.push_back(at(v));
    const Vec3 along = normalized(edge[1] - edge[0]);
    const auto aside = [&](Vec3 p) { return normalized((p - edge[0]) - dot(p - edge[0], along) * along); };
    if (distance(aside(apex[0]), aside(apex[1])) < 1e-4) fault("faces ", f, " and ", g, " lie on each other");
  }

  void check_faithful() {
    std::map<std::uint32_t, double> area_of;
    for (std::size_t f = 0; f < c_.n_faces(); ++f) {
      const FaceId p = parent(f);
      const Triangle t = c_.corners(FaceId(f)), of = before_.corners(p);
      const Vec3 n = unit_normal(of);
      if (dot(area_vector(t), n) <= 0) fault("face ", f, " is turned over or has no area");
      if (c_.component[f] != 0) continue;
      area_of[p.value] += area(t);
      for (const Vec3 q : t)
        if (distance(q, closest_on_triangle(q, of).point) > rounding()) fault("face ", f, " leaves its parent");
    }
    for (const auto& [p, a] : area_of)
      if (std::abs(a - area(before_.corners(FaceId(std::size_t{p})))) > 1e-9 * a + rounding() * rounding())
        fault("the pieces of face ", p, " have another area");
  }

  /// Far above what arithmetic on these coordinates costs, far below the weld length.
  [[nodiscard]] double rounding() const {
    double largest = 0;
    for (const Vec3 p : before_.position) largest = std::max(largest, norm(p));
    return 1e-13 * largest;
  }

  /// Length of the edges with a given number of faces, by component.
  static std::map<std::pair<std::uint32_t, std::size_t>, double> lengths(const Complex& c) {
    std::map<std::pair<std::uint32_t, Edge>, std::size_t> uses;
    for (std::size_t f = 0; f < c.n_faces(); ++f)
      for (std::size_t k = 0; k < 3; ++k) ++uses[{c.component[f], edge_of(c.face[f], k)}];
    std::map<std::pair<std::uint32_t, std::size_t>, double> sum;
    for (const auto& [edge, n] : uses)
      if (n != 2) sum[{edge.first, n}] += distance(c.position[edge.second[0].value], c.position[edge.second[1].value]);
    return sum;
  }

  void check_complete() {
    const auto old = lengths(before_), now = lengths(c_);
    for (const auto& [key, length] : now)
      if (!old.contains(key)) fault("component ", key.first, " has new edges with ", key.second, " faces");
    for (const auto& [key, length] : old) {
      const double slack = key.first == 0 ? 1e-9 : check_.slack;
      const double is = now.contains(key) ? now.at(key) : 0;
      if (std::abs(is - length) > slack * length)
        fault("edges with ", key.second, " faces of component ", key.first, " had length ", length, ", have ", is);
    }
  }

  void check_joined() {
    std::map<Edge, std::set<std::uint32_t>> components;
    std::map<std::pair<std::uint32_t, Edge>, std::size_t> uses;
    for (std::size_t f = 0; f < c_.n_faces(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        components[edge_of(c_.face[f], k)].insert(c_.component[f]);
        ++uses[{c_.component[f], edge_of(c_.face[f], k)}];
      }
    std::vector<Edge> expected;
    for (const auto& [edge, of] : components)
      if (of.size() > 1) expected.push_back(edge);
    if (expected != after_.junction_edges) fault("junction edges are not the edges of several components");
    if (check_.may_end) return;

    std::map<VertexId, int> degree;
    for (const auto& e : after_.junction_edges) ++degree[e[0]], ++degree[e[1]];
    std::set<VertexId> free;
    for (const auto& [edge, n] : uses)
      if (n == 1) free.insert(edge.second.begin(), edge.second.end());
    for (const auto& [v, n] : degree)
      if (n == 1 && !free.contains(v)) fault("the junction breaks off at vertex ", v.value);
  }

  void check_bounded() {
    std::map<NodeRef, double> size;  // largest of the faces at a node
    for (std::size_t f = 0; f < before_.n_faces(); ++f)
      for (const VertexId v : before_.face[f]) {
        double& s = size[before_.node[v.value]];
        s = std::max(s, mean_edge_length(before_.corners(FaceId(f))));
      }
    std::set<NodeRef> listed;
    for (const auto& m : after_.moves) {
      listed.insert(m.node);
      if (distance(m.from, m.to) > 2.000001 * options_.tolerance.at(size[m.node]) + rounding())
        fault("node ", m.node.node.value, " moved by ", distance(m.from, m.to));
    }
    for (const auto& r : after_.replaced) listed.insert(r.node);
    for (std::size_t v = 0; v < before_.n_vertices(); ++v)
      if (c_.position[v] != before_.position[v] && !listed.contains(before_.node[v]))
        fault("vertex ", v, " moved and is not listed");
    for (const NodeRef n : listed)
      if (n.input == 0) fault("a node of the first component moved");
  }

  const Complex& before_;
  const Corefined& after_;
  const Complex& c_;
  const CorefineOptions& options_;
  const Check& check_;
  mutable std::map<ElementRef, FaceId> by_parent_;
  std::vector<std::string> faults_;
};

}  // namespace

Complex complex_of(const std::vector<Model>& models, GroupSets& sets) {
  Complex c;
  for (std::uint32_t k = 0; k < models.size(); ++k) {
    const Model& m = models[k];
    const std::size_t first = c.n_vertices();
    const auto groups = [&](GroupSetId set) {
      std::vector<GroupId> members;
      for (const GroupId g : m.group_sets.members(set)) members.emplace_back(100 * k + g.value);
      return sets.intern(std::move(members));
    };
    const auto vertex = [&](NodeId n) { return VertexId(first + n.value); };
    for (std::size_t v = 0; v < m.n_nodes(); ++v)
      c.add_vertex(m.position[v], {k, NodeId(v)}, VertexState::kOpen, groups(m.node_groups[v]));
    for (ElementId e(std::size_t{0}); e.value < m.n_elements(); ++e.value) {
      const auto nodes = m.nodes_of(e);
      if (m.shape(e) == Shape::kLine)
        c.lines.push_back({{vertex(nodes[0]), vertex(nodes[1])}, {k, e}, groups(m.element_groups[e.value]), {}});
      if (!m.is_face(e)) continue;
      c.face.push_back({vertex(nodes[0]), vertex(nodes[1]), vertex(nodes[2])});
      c.parent.push_back({k, e});
      c.component.push_back(k);
      c.face_groups.push_back(groups(m.element_groups[e.value]));
      c.face_attributes.emplace_back(std::size_t{0});
    }
  }
  return c;
}

std::vector<std::string> faults(const Complex& before, const Corefined& after, const CorefineOptions& options,
                                const Check& check) {
  return Checker(before, after, options, check).run();
}

double junction_length(const Corefined& c) {
  double sum = 0;
  for (const auto& [a, b] : c.junction_edges) sum += distance(c.complex.position[a.value], c.complex.position[b.value]);
  return sum;
}

double junction_distance(const Corefined& a, const Corefined& b) {
  double farthest = 0;
  for (const auto& edge : a.junction_edges)
    for (const VertexId v : edge) {
      const Vec3 p = a.complex.position[v.value];
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& [c, d] : b.junction_edges)
        nearest = std::min(
            nearest,
            distance(p, closest_on_segment(p, b.complex.position[c.value], b.complex.position[d.value]).point));
      farthest = std::max(farthest, nearest);
    }
  return farthest;
}

}  // namespace meshgraft::checks
