#include "merge/result_check.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numbers>
#include <span>

#include "check/face_pairs.hpp"
#include "core/connected.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"
#include "merge/edges.hpp"
#include "merge/free_edges.hpp"
#include "zone/open_seams.hpp"

namespace meshgraft {
namespace {

constexpr double kMetReach = 0.1;  // of the edge length: as far as new faces may be from the old

/// Findings of one kind; beyond a number of them they are only counted.
class Findings {
 public:
  Findings(std::size_t max_listed, const char* hint) : hint_(hint), max_listed_(max_listed) {}

  void add(const std::string& what, Place place) {
    if (++n_ <= max_listed_) errors_.push_back({ErrorCode::kPromiseBroken, what, hint_, std::move(place)});
  }
  [[nodiscard]] std::vector<Error> all() const {
    std::vector<Error> errors = errors_;
    if (n_ > max_listed_)
      errors.push_back(
          {ErrorCode::kPromiseBroken, std::to_string(n_ - max_listed_) + " more findings like the last one", "", {}});
    return errors;
  }

 private:
  const char* hint_;
  std::vector<Error> errors_;
  std::size_t max_listed_, n_ = 0;
};

ResultVerdict together(const Findings& first, const Findings& second) {
  ResultVerdict both{first.all(), {}};
  std::ranges::move(second.all(), std::back_inserter(both.broken));
  return both;
}

class ResultCheck {
 public:
  ResultCheck(const Outcome& outcome, SetTranslation& translated, const Tolerance& tolerance,
              const ResultCheckLimits& limits)
      : outcome_(outcome),
        complex_(outcome.final_complex),
        translated_(translated),
        tolerance_(tolerance),
        limits_(limits) {}

  /// All checks at the same time; their findings stand in the order of the checks.
  ResultVerdict run() {
    std::array<ResultVerdict, 7> found;
    tbb::parallel_invoke([&] { found[0] = intersections(); }, [&] { found[1] = duplicates(); },
                         [&] { found[2] = free_edges(); }, [&] { found[3] = parents(); },
                         [&] { found[4] = lost_nodes(); }, [&] { found[5] = doubled_lines(); },
                         [&] { found[6] = folds(); });
    ResultVerdict all;
    for (ResultVerdict& v : found) {
      std::ranges::move(v.broken, std::back_inserter(all.broken));
      std::ranges::move(v.warnings, std::back_inserter(all.warnings));
    }
    return all;
  }

 private:
  using ParentPair = std::array<ElementRef, 2>;

  [[nodiscard]] Findings no_findings() const { return {limits_.max_listed, hint_for_place(outcome_.kind)}; }

  static ParentPair parents_of(const Complex& complex, const std::array<FaceId, 2>& pair) {
    const ElementRef a = complex.parent[pair[0].value], b = complex.parent[pair[1].value];
    return {std::min(a, b), std::max(a, b)};
  }

  static std::array<std::uint32_t, 2> components_of(const Complex& complex, const std::array<FaceId, 2>& pair) {
    const std::uint32_t a = complex.component[pair[0].value], b = complex.component[pair[1].value];
    return {std::min(a, b), std::max(a, b)};
  }

  /// Holds all points in which the faces meet.
  static Box place_of_meeting(const Complex& complex, const std::array<FaceId, 2>& pair) {
    std::array<Box, 2> box;
    for (const std::size_t k : {0, 1})
      for (const Vec3 p : complex.corners(pair[k])) box[k].add(p);
    const auto& [a, b] = box;
    return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
            {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
  }

  /// Pairs of faces that are not joined and met already before the merge.
  class MetBefore {
   public:
    MetBefore() = default;
    explicit MetBefore(const Complex& before) {
      find_meshes(before);
      std::vector<Box> places;
      for (const auto& pair : intersecting_faces(before, std::vector<std::uint8_t>(before.n_faces(), 1))) {
        const auto components = components_of(before, pair);
        if (before.joins.are_joined(components[0], components[1])) continue;
        parents_.push_back(parents_of(before, pair));
        meshes_.push_back(meshes_of(before, pair)), places.push_back(place_of_meeting(before, pair));
      }
      std::ranges::sort(parents_);
      tree_ = BoxTree(places);
    }

    /// A new face has one parent, and may be where others were that met the other mesh: of two meshes it counts
    /// whether they met within `reach`.
    [[nodiscard]] bool holds(const Complex& now, const std::array<FaceId, 2>& pair, double reach) const {
      if (parents_.empty()) return false;
      if (std::ranges::binary_search(parents_, parents_of(now, pair))) return true;
      const auto meshes = meshes_of(now, pair);
      if (meshes[0] == meshes[1]) return false;
      bool found = false;
      tree_.overlapping(place_of_meeting(now, pair).grown(reach),
                        [&](std::uint32_t i) { found = found || meshes_[i] == meshes; });
      return found;
    }

   private:
    /// Component, and the least vertex of what hangs together there.
    using Mesh = std::array<std::uint32_t, 2>;

    void find_meshes(const Complex& before) {
      const std::vector<std::uint32_t> mesh = connected_meshes(before);
      for (std::size_t f = 0; f < before.n_faces(); ++f)
        mesh_of_.emplace(before.parent[f], Mesh{before.component[f], mesh[f]});
    }

    [[nodiscard]] std::array<Mesh, 2> meshes_of(const Complex& complex, const std::array<FaceId, 2>& pair) const {
      const Mesh a = mesh_of_.at(complex.parent[pair[0].value]), b = mesh_of_.at(complex.parent[pair[1].value]);
      return {std::min(a, b), std::max(a, b)};
    }

    std::map<ElementRef, Mesh> mesh_of_;
    std::vector<ParentPair> parents_;          // ascending
    std::vector<std::array<Mesh, 2>> meshes_;  // by pair, as in the tree
    BoxTree tree_;
  };

  /// One of the layers lies on the other, as was asked for: on the same nodes, of two components.
  bool are_layers(FaceId f, FaceId g) const {
    return outcome_.all_layers && complex_.component[f.value] != complex_.component[g.value] &&
           are_on_the_same_nodes(f, g);
  }

  /// Faces on both sides of an open seam meet there as neighbours do: in nodes in one place, or along a free edge.
  void leave_out_seams(std::vector<std::array<FaceId, 2>>& pairs) const {
    if (pairs.empty()) return;
    std::vector<VertexId> corners;
    for (const auto& pair : pairs)
      for (const FaceId f : pair)
        corners.insert(corners.end(), complex_.face[f.value].begin(), complex_.face[f.value].end());
    const std::vector<VertexId> place = place_of_nodes(complex_, std::move(corners));
    const EdgeTable edges(complex_);
    const auto places = [&](FaceId f) {
      const auto& v = complex_.face[f.value];
      return std::array{place[v[0].value].value, place[v[1].value].value, place[v[2].value].value};
    };
    std::erase_if(pairs, [&](const auto& pair) {
      const auto [f, g] = pair;
      if (complex_.component[f.value] != complex_.component[g.value]) return false;
      return is_beyond_free_edge(edges, f, g) || is_beyond_free_edge(edges, g, f) ||
             !meet_beyond_shared(places(f), complex_.corners(f), places(g), complex_.corners(g));
    });
  }

  /// Whether all of g lies beyond a free edge of f, up to rounding, seen in the plane of f.
  [[nodiscard]] bool is_beyond_free_edge(const EdgeTable& edges, FaceId f, FaceId g) const {
    constexpr double kRounding = 1e-6;  // of the mean edge length
    const Triangle t = complex_.corners(f), u = complex_.corners(g);
    const double reach = kRounding * mean_edge_length(t);
    for (std::size_t k = 0; k < 3; ++k) {
      if (edges.uses(edges.of(f, k)).size() != 1) continue;
      const Vec3 outward = normalized(cross(t[(k + 1) % 3] - t[k], area_vector(t)));
      if (std::ranges::all_of(u, [&](Vec3 p) { return dot(outward, p - t[k]) >= -reach; })) return true;
    }
    return false;
  }

  [[nodiscard]] ResultVerdict intersections() const {
    auto pairs = intersecting_faces(complex_, outcome_.stitched.changed);
    leave_out_seams(pairs);
    if (pairs.empty()) return {};
    // Faces that fill a hole replace nothing: what the faces around met before is no excuse for them.
    const MetBefore met_before = outcome_.kind == OperationKind::kFill ? MetBefore() : MetBefore(outcome_.original);
    Findings findings = no_findings();
    std::vector<std::array<FaceId, 2>> met;
    for (const auto& pair : pairs)
      if (met_before.holds(complex_, pair, kMetReach * outcome_.input_edge_length(pair[0])))
        met.push_back(pair);
      else if (!are_layers(pair[0], pair[1]))
        findings.add(outcome_.text(pair[0]) + " and " + outcome_.text(pair[1]) + " intersect",
                     outcome_.parent_place(pair[0]));
    return {findings.all(), warning("input-intersects", met, " intersect in the input, and still do")};
  }

  /// One warning for all pairs, with the parents of the first.
  [[nodiscard]] std::vector<Warning> warning(const std::string& name, std::span<const std::array<FaceId, 2>> pairs,
                                             const std::string& what) const {
    if (pairs.empty()) return {};
    const auto& [a, b] = pairs.front();
    const auto parent = [&](FaceId f) { return text_of(outcome_.inputs, complex_.parent[f.value]); };
    std::string text = parent(a) + " and " + parent(b) + " at " + text_of(centroid(complex_.corners(b))) + what;
    if (pairs.size() > 1) text += "; so do " + std::to_string(pairs.size() - 1) + " more pairs";
    return {{name, std::move(text), outcome_.parent_place(b)}};
  }

  /// Whether something at a corner of the face changed.
  [[nodiscard]] bool is_at_zone(FaceId f) const {
    return std::ranges::any_of(complex_.face[f.value],
                               [&](VertexId v) { return outcome_.changed_vertex[v.value] != 0; });
  }

  [[nodiscard]] ResultVerdict duplicates() const {
    std::vector<std::pair<std::array<VertexId, 3>, FaceId>> keys;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f) {
      if (!is_at_zone(FaceId(f))) continue;
      auto v = complex_.face[f];
      std::sort(v.begin(), v.end());
      keys.emplace_back(v, FaceId(f));
    }
    std::sort(keys.begin(), keys.end());
    Findings findings = no_findings();
    std::vector<std::array<FaceId, 2>> left;
    for (std::size_t k = 1; k < keys.size(); ++k) {
      const FaceId a = keys[k - 1].second, b = keys[k].second;
      if (keys[k - 1].first != keys[k].first || are_layers(a, b)) continue;
      if (outcome_.is_changed(a) || outcome_.is_changed(b))
        findings.add(outcome_.text(a) + " and " + outcome_.text(b) + " are on the same nodes",
                     outcome_.parent_place(b));
      else
        left.push_back({a, b});
    }
    return {findings.all(), warning("doubled-face", left, " stand on the same nodes and were left as they are")};
  }

  /// Faces that turn back onto a neighbour, which crosses nothing and hides half of the surface.
  [[nodiscard]] ResultVerdict folds() const {
    std::vector<std::uint8_t> at_changed(complex_.n_vertices());
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      if (outcome_.is_changed(FaceId(f)))
        for (const VertexId v : complex_.face[f]) at_changed[v.value] = 1;
    Findings findings = no_findings();
    for_each_edge(edge_uses(complex_, at_changed), [&](std::span<const FaceOnEdge> uses) {
      for (std::size_t i = 0; i < uses.size(); ++i)
        for (std::size_t j = i + 1; j < uses.size(); ++j) {
          const FaceId f = uses[i].face, g = uses[j].face;
          if (!outcome_.is_changed(f) && !outcome_.is_changed(g)) continue;
          if (fold_angle(complex_, uses[i], uses[j]) <= std::numbers::pi - limits_.fold_angle ||
              are_on_the_same_nodes(f, g))
            continue;
          findings.add(outcome_.text(g) + " is folded onto " + outcome_.text(f), outcome_.parent_place(g));
        }
    });
    return {findings.all(), {}};
  }

  [[nodiscard]] bool are_on_the_same_nodes(FaceId f, FaceId g) const {
    return std::ranges::is_permutation(complex_.face[f.value], complex_.face[g.value]);
  }

  /// 1D elements on the same nodes: those of one input that descend from elements in two places; and, as a warning,
  /// those of one type that lie on each other where meshes are joined along both.
  [[nodiscard]] ResultVerdict doubled_lines() const {
    std::vector<std::pair<std::array<VertexId, 2>, ElementRef>> keys;
    for (const Complex::Line& line : complex_.lines)
      keys.push_back({{std::min(line.ends[0], line.ends[1]), std::max(line.ends[0], line.ends[1])}, line.parent});
    std::sort(keys.begin(), keys.end());
    Findings findings = no_findings();
    Warning warning;
    std::size_t n_met = 0;
    for (std::size_t k = 1; k < keys.size(); ++k) {
      const auto& [ends, parent] = keys[k];
      const Vec3 at = midpoint(complex_.position[ends[0].value], complex_.position[ends[1].value]);
      const Place place = place_of(*outcome_.inputs[parent.input], parent.element);
      for (std::size_t j = k; j > 0 && keys[j - 1].first == ends; --j) {
        const ElementRef other = keys[j - 1].second;
        const std::string both = text_of(outcome_.inputs, other) + " and " + text_of(outcome_.inputs, parent);
        if (other == parent || (other.input == parent.input && !were_in_one_place(other, parent))) {
          if (j == k)
            findings.add("two 1D elements around " + text_of(at) + ", of " + both + ", are on the same nodes", place);
        } else if (type_of(other) == type_of(parent) && !were_on_the_same_nodes(other, parent) && n_met++ == 0) {
          warning = {"doubled-line", both + " lie on one edge at " + text_of(at), place};
        }
      }
    }
    if (n_met == 0) return {findings.all(), {}};
    if (n_met > 1) warning.what += "; so do " + std::to_string(n_met - 1) + " more pairs";
    warning.what += "; both were kept, so that their stiffness counts twice";
    return {findings.all(), {std::move(warning)}};
  }

  [[nodiscard]] std::int64_t type_of(ElementRef line) const {
    return outcome_.inputs[line.input]->attributes_of(line.element).type;
  }

  /// Of 1D elements, in one input.
  [[nodiscard]] bool were_on_the_same_nodes(ElementRef a, ElementRef b) const {
    const Model& model = *outcome_.inputs[a.input];
    return a.input == b.input && std::ranges::is_permutation(model.nodes_of(a.element), model.nodes_of(b.element));
  }

  /// Of 1D elements.
  [[nodiscard]] bool were_in_one_place(ElementRef a, ElementRef b) const {
    const auto ends = [&](ElementRef e) {
      const Model& model = *outcome_.inputs[e.input];
      const auto nodes = model.nodes_of(e.element);
      return std::array{model.position[nodes[0].value], model.position[nodes[1].value]};
    };
    const auto [a0, a1] = ends(a);
    const auto [b0, b1] = ends(b);
    return distance(midpoint(a0, a1), midpoint(b0, b1)) < 0.5 * distance(a0, a1);  // neighbours: all of it
  }

  [[nodiscard]] ResultVerdict free_edges() const {
    const FreeEdgeChanges changes = free_edge_changes(outcome_, tolerance_, limits_.free_edge_distance);
    Findings cracks = no_findings(), closed = no_findings();
    for (const FaceOnEdge& e : changes.cracks)
      cracks.add("the edge of " + outcome_.text(e.face) + " around " +
                     text_of(midpoint(complex_.position[e.low.value], complex_.position[e.high.value])) +
                     " is free and was not",
                 outcome_.parent_place(e.face));
    const Complex& before = outcome_.original;
    for (const FaceOnEdge& e : changes.closed) {
      const ElementRef parent = before.parent[e.face.value];
      closed.add("the free edge of " + text_of(outcome_.inputs, parent) + " around " +
                     text_of(midpoint(before.position[e.low.value], before.position[e.high.value])) + " is gone",
                 place_of(*outcome_.inputs[parent.input], parent.element));
    }
    return together(cracks, closed);
  }

  [[nodiscard]] ResultVerdict parents() {
    Findings turned = no_findings(), groups = no_findings();
    for (std::size_t k = 0; k < complex_.n_faces(); ++k) {
      const FaceId f(k);
      if (!outcome_.is_changed(f)) continue;
      const ElementRef parent = complex_.parent[k];
      const Model& model = *outcome_.inputs[parent.input];
      const bool replaces =
          outcome_.kind != OperationKind::kFill;  // a cap may be turned any way against the faces around
      if (replaces && dot(area_vector(complex_.corners(f)), area_vector(model.corners(parent.element))) <= 0)
        turned.add(outcome_.text(f) + " is turned against " + text_of(outcome_.inputs, parent) + ", which it replaces",
                   outcome_.parent_place(f));
      GroupSetId wanted = translated_.of(parent);
      if (!outcome_.all_layers)
        for (const Complex::Layer& layer : complex_.layers_of(f))
          wanted = translated_.unite(wanted, translated_.of(layer.parent));
      const GroupSetId has = complex_.face_groups[k];
      if (outcome_.kind == OperationKind::kFill ? translated_.unite(wanted, has) != wanted : has != wanted)
        groups.add(
            outcome_.text(f) + " is not in the groups of " + text_of(outcome_.inputs, parent) + ", which it replaces",
            outcome_.parent_place(f));
    }
    return together(turned, groups);
  }

  [[nodiscard]] ResultVerdict lost_nodes() const {
    Findings findings = no_findings();
    for (const NodeRef n : outcome_.stitched.lost_nodes) {
      const Model& model = *outcome_.inputs[n.input];
      findings.add("node " + std::to_string(model.node_label[n.node.value]) + " of " + model.path + " at " +
                       text_of(model.position[n.node.value]) +
                       " is used by other elements and was not kept in the mesh",
                   place_of(model, n.node));
    }
    return {findings.all(), {}};
  }

  const Outcome& outcome_;
  const Complex& complex_;
  SetTranslation& translated_;
  const Tolerance& tolerance_;
  const ResultCheckLimits& limits_;
};

}  // namespace

ResultVerdict check_result(const Outcome& outcome, SetTranslation& translated, const Tolerance& tolerance,
                           const ResultCheckLimits& limits) {
  return ResultCheck(outcome, translated, tolerance, limits).run();
}

}  // namespace meshgraft
