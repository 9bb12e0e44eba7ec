#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

#include "geometry/quality.hpp"
#include "merge/inputs.hpp"
#include "meshgraft/fill.hpp"

namespace meshgraft {
namespace {

// The faces around a hole look one way in the mean, those around the end of a pipe outwards, each another way.
constexpr double kHoleCosine = 0.5;  // of that way to the area of the contour: 60 degrees
constexpr double kOneWay = 0.25;     // of the length of the mean normal: a cone of 30 degrees at its tip

/// One side of one surface element.
struct Side {
  NodeId from, to;
  ElementId element;
};

class Finder {
 public:
  explicit Finder(const Model& model) : model_(model) { find_free_sides(); }

  FreeEdges run() {
    used_.assign(free_.size(), 0);
    for (std::size_t k = 0; k < free_.size(); ++k)
      if (used_[k] == 0) walk(k);
    std::ranges::sort(contours_, [&](const Contour& a, const Contour& b) {
      return a.length != b.length ? a.length > b.length : label(a.nodes.front()) < label(b.nodes.front());
    });
    return {std::move(contours_), std::move(others_), doubled()};
  }

 private:
  [[nodiscard]] std::int64_t label(NodeId n) const { return model_.node_label[n.value]; }
  [[nodiscard]] Vec3 at(NodeId n) const { return model_.position[n.value]; }

  using Edge = std::array<NodeId, 2>;
  static Edge edge(NodeId a, NodeId b) { return {std::min(a, b), std::max(a, b)}; }

  /// Sides that no other element has, each turned so that what is open is on its left.
  void find_free_sides() {
    for (std::size_t e = 0; e < model_.n_elements(); ++e) {
      const Corners c = corners_of(model_.shape(ElementId(e)), model_.nodes_of(ElementId(e)));
      for (std::size_t k = 0; k < c.n && c.is_surface(); ++k) {
        const NodeId a = c.node[k], b = c.node[(k + 1) % c.n];
        if (a.valid() && b.valid()) sides_.push_back({edge(a, b), {b, a, ElementId(e)}});
      }
    }
    std::ranges::stable_sort(sides_, {}, &std::pair<Edge, Side>::first);
    for (const auto& side : sides_)
      if (at_edge(side.first).size() == 1) free_.push_back(side.second);
    std::ranges::sort(free_,
                      [](const Side& a, const Side& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  }

  [[nodiscard]] std::vector<NodeId> corners_ascending(ElementId e) const {
    const Corners c = corners_of(model_.shape(e), model_.nodes_of(e));
    std::vector<NodeId> nodes(c.node.begin(), c.node.begin() + static_cast<std::ptrdiff_t>(c.n));
    std::ranges::sort(nodes);
    return nodes;
  }

  [[nodiscard]] std::vector<std::array<ElementId, 2>> doubled() const {
    std::vector<std::array<ElementId, 2>> pairs;
    for (auto it = sides_.begin(); it != sides_.end();) {
      const auto there = at_edge(it->first);
      it += static_cast<std::ptrdiff_t>(there.size());
      const ElementId first = there.front().second.element;
      const auto is_other = [&](const auto& side) { return side.second.element != first; };
      const auto on_same_nodes = [&](const auto& side) {
        return corners_ascending(side.second.element) == corners_ascending(first);
      };
      if (const auto other = std::ranges::find_if(there, is_other);
          other != there.end() && std::ranges::all_of(there, on_same_nodes))
        pairs.push_back({first, other->second.element});
    }
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  [[nodiscard]] std::span<const std::pair<Edge, Side>> at_edge(const Edge& e) const {
    const auto [begin, end] = std::ranges::equal_range(sides_, e, {}, &std::pair<Edge, Side>::first);
    return {begin, end};
  }

  /// The free side that ends the fan of elements which begins at side k, around the node that k leads to.
  [[nodiscard]] std::size_t across_fan(std::size_t k) const {
    const NodeId centre = free_[k].to;
    NodeId spoke = free_[k].from;
    ElementId e = free_[k].element;
    for (std::size_t turns = 0; turns < sides_.size(); ++turns) {
      const Corners c = corners_of(model_.shape(e), model_.nodes_of(e));
      const auto at = static_cast<std::size_t>(std::ranges::find(c.node, centre) - c.node.begin());
      const NodeId before = c.node[(at + c.n - 1) % c.n], after = c.node[(at + 1) % c.n];
      spoke = before == spoke ? after : before;
      const auto there = at_edge(edge(centre, spoke));
      if (there.size() == 1) return position_of(centre, spoke);
      if (there.size() != 2) break;
      e = there[0].second.element == e ? there[1].second.element : there[0].second.element;
    }
    return free_.size();
  }

  [[nodiscard]] std::size_t position_of(NodeId from, NodeId to) const {
    const auto it = std::ranges::find_if(free_, [&](const Side& s) { return s.from == from && s.to == to; });
    return static_cast<std::size_t>(it - free_.begin());
  }

  /// The side with which the contour goes on after side k. Where fans of elements touch in a node, what is open lies
  /// between two of them: it goes on with the first side of another fan, clockwise.
  [[nodiscard]] std::size_t next(std::size_t k) const {
    const NodeId at_node = free_[k].to;
    std::vector<std::size_t> all;
    for (auto it = std::ranges::lower_bound(free_, at_node, {}, &Side::from); it != free_.end() && it->from == at_node;
         ++it)
      all.push_back(static_cast<std::size_t>(it - free_.begin()));
    if (all.size() > 1) std::erase(all, across_fan(k));
    if (all.empty()) return free_.size();
    const Vec3 back = at(free_[k].from) - at(at_node);
    const Vec3 normal = model_.is_face(free_[k].element) ? unit_normal(model_.corners(free_[k].element)) : Vec3{};
    const auto clockwise = [&](std::size_t j) {
      const Vec3 onward = at(free_[j].to) - at(at_node);
      const double angle = std::atan2(dot(normal, cross(onward, back)), dot(back, onward));
      return angle > 0 ? angle : angle + 2 * std::numbers::pi;
    };
    return *std::ranges::min_element(all, {}, clockwise);
  }

  /// Follows free sides until they close.
  void walk(std::size_t first) {
    std::vector<std::size_t> way;
    for (std::size_t k = first; k != free_.size() && used_[k] == 0; k = next(k)) {
      used_[k] = 1;
      way.push_back(k);
    }
    constexpr std::size_t kLeastSides = 3;
    if (next(way.back()) == first && way.size() >= kLeastSides)
      add(way);
    else
      for (const std::size_t k : way) others_.push_back({free_[k].from, free_[k].to});
  }

  void add(std::span<const std::size_t> way) {
    Contour c;
    Vec3 normal, area;
    for (const std::size_t k : way) {
      const Side& s = free_[k];
      c.nodes.push_back(s.from), c.centre += at(s.from), c.length += distance(at(s.from), at(s.to));
      c.is_fillable = c.is_fillable && model_.is_face(s.element);
      if (model_.is_face(s.element)) normal += distance(at(s.from), at(s.to)) * unit_normal(model_.corners(s.element));
    }
    c.centre = c.centre / static_cast<double>(way.size());
    for (const std::size_t k : way) area += 0.5 * cross(at(free_[k].from) - c.centre, at(free_[k].to) - c.centre);
    c.is_hole = dot(normalized(area), normalized(normal)) > kHoleCosine && norm(normal) > kOneWay * c.length;
    std::ranges::rotate(c.nodes, std::ranges::min_element(c.nodes, {}, [&](NodeId n) { return label(n); }));
    contours_.push_back(std::move(c));
  }

  const Model& model_;
  std::vector<std::pair<Edge, Side>> sides_;  // of all surface elements, ascending by edge
  std::vector<Side> free_;                    // ascending
  std::vector<std::uint8_t> used_;
  std::vector<Contour> contours_;
  std::vector<std::array<NodeId, 2>> others_;
};

}  // namespace

FreeEdges free_edges_of(const Model& model) { return Finder(model).run(); }

std::vector<Contour> contours_of(const Model& model) { return free_edges_of(model).contours; }

}  // namespace meshgraft
