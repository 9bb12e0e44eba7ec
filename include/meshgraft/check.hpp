// What is wrong with a mesh: the checks that every merge result passes, for any model.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "meshgraft/model.hpp"

namespace meshgraft {

struct CheckOptions {
  double min_quality = 0.5;                 // Q below this is listed
  double sharp_angle = 0.5235987755982988;  // radians (30 degrees): edges folded more are sharp
  std::size_t max_places = 10;              // of each kind listed
};

/// Lists have at most CheckOptions::max_places entries; the numbers beside them count all.
struct CheckResult {
  std::uint64_t faces = 0, free_edges = 0, non_manifold_edges = 0, sharp_edges = 0;
  std::uint64_t flipped_edges = 0;  // two faces, opposite orientation
  double area = 0, mean_edge_length = 0;
  Box box;
  double min_q = 1, p01_q = 1, mean_q = 1;
  std::uint64_t below_min_quality = 0;
  std::vector<std::pair<ElementId, double>> worst_faces;
  std::vector<ElementId> degenerate_faces;  // no area, or a repeated node
  std::uint64_t n_degenerate_faces = 0;
  std::vector<std::pair<ElementId, ElementId>> duplicate_faces;  // on the same nodes
  std::uint64_t n_duplicate_faces = 0;
  std::vector<std::pair<ElementId, ElementId>> doubled_lines;  // 1D elements of one type on the same nodes
  std::uint64_t n_doubled_lines = 0;
  /// Faces that meet beyond shared nodes and edges, but not those on the same nodes.
  std::vector<std::pair<ElementId, ElementId>> intersecting_faces;
  std::uint64_t intersections = 0;
  std::vector<std::pair<NodeId, NodeId>> coincident_nodes;
  std::uint64_t n_coincident_nodes = 0;
  std::vector<NodeId> orphan_nodes;  // of no element
  std::uint64_t n_orphan_nodes = 0;
  std::uint64_t dangling_group_entries = 0, empty_groups = 0;
  /// No degenerate or duplicate face, no intersection. Two 1D elements on one edge may be meant.
  [[nodiscard]] bool sound() const { return n_degenerate_faces + n_duplicate_faces + intersections == 0; }
};

/// Runs all checks. Signs come from exact predicates. Cost O(m log m).
[[nodiscard]] CheckResult check(const Model& model, const CheckOptions& options = {});

}  // namespace meshgraft
