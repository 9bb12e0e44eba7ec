// Surfaces made of cells small enough that a cut through them is cheap.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "meshgraft/model.hpp"

namespace meshgraft {

/// Ascending places from `low` to `high`, evenly spaced by about `step` (but at most kMostSteps) where
/// this overlaps [near_low, near_high], with nothing in between elsewhere.
[[nodiscard]] std::vector<double> ticks(double low, double high, double near_low, double near_high, double step);

inline constexpr std::size_t kMostSteps = 200;

/// Adds nodes by name, so that patches beside each other share them.
class LatticeBuilder {
 public:
  using Name = std::array<std::size_t, 3>;

  /// The node of that name; made at `p` if there is none.
  NodeId node(const Name& name, Vec3 p);
  void add_face(NodeId a, NodeId b, NodeId c) { builder_.add_face(a, b, c), ++n_faces_; }
  /// a, b, c, d counter-clockwise.
  void add_cell(NodeId a, NodeId b, NodeId c, NodeId d) { add_face(a, b, c), add_face(a, c, d); }
  [[nodiscard]] std::size_t n_faces() const { return n_faces_; }
  /// Its elements have no labels.
  [[nodiscard]] Model build(const std::string& path);

 private:
  ModelBuilder builder_;
  std::map<Name, NodeId> nodes_;
  std::size_t n_faces_ = 0;
};

}  // namespace meshgraft
