#include "cut/cut_edges.hpp"

#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"
#include "merge/edges.hpp"
#include "zone/ruler.hpp"

namespace meshgraft {
namespace {

constexpr double kOnCut = 1e-6;  // of the length of an edge: new nodes are put on the cut, but for rounding

class Border {
 public:
  explicit Border(std::span<const Dropped::Segment> segments) : segments_(segments) {
    std::vector<Box> boxes(segments.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (const Vec3 p : segments[i]) boxes[i].add(p);
    tree_ = BoxTree(boxes);
  }

  [[nodiscard]] bool has(Vec3 p, double within) const {
    Box box;
    box.add(p);
    bool found = false;
    tree_.overlapping(box.grown(within), [&](std::uint32_t i) {
      found = found || distance(p, closest_on_segment(p, segments_[i][0], segments_[i][1]).point) <= within;
    });
    return found;
  }

 private:
  std::span<const Dropped::Segment> segments_;
  BoxTree tree_;
};

}  // namespace

Junction cut_edges(const Complex& complex, std::span<const Dropped::Segment> segments) {
  const Border border(segments);
  Junction junction;
  const std::vector<FaceOnEdge> uses = edge_uses(complex);
  for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
    if (edge.size() != 1) return;
    const Vec3 a = complex.position[edge[0].low.value], b = complex.position[edge[0].high.value];
    const double length = distance(a, b);
    if (!border.has(a, kOnCut * length) || !border.has(b, kOnCut * length)) return;
    if (border.has(midpoint(a, b), 2 * RulerOptions{}.max_sagitta * length))
      junction.edges.push_back({{edge[0].low, edge[0].high}, {0}});
  });
  return junction;
}

}  // namespace meshgraft
