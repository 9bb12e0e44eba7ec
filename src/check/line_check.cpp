#include <algorithm>
#include <tuple>

#include "check/checks.hpp"

namespace meshgraft {
namespace {

/// A 1D element by what makes two of them the same: end and middle nodes in any direction, and the kind.
struct LineKey {
  std::array<NodeId, 3> nodes;  // ascending; the last ones invalid
  std::int64_t type;
  ElementId element;
  [[nodiscard]] bool is_on(const LineKey& other) const { return nodes == other.nodes && type == other.type; }
};

}  // namespace

void check_lines(const Model& model, const CheckOptions& options, CheckResult& result) {
  std::vector<LineKey> lines;
  for (std::size_t i = 0; i < model.n_elements(); ++i) {
    const ElementId e(i);
    const Shape shape = model.shape(e);
    const auto nodes = model.nodes_of(e);
    if ((shape != Shape::kLine && shape != Shape::kLine3) || nodes.size() > 3) continue;
    LineKey key{{}, model.attributes_of(e).type, e};
    std::ranges::copy(nodes, key.nodes.begin());
    std::ranges::sort(key.nodes);
    lines.push_back(key);
  }
  std::ranges::sort(lines, {}, [](const LineKey& k) { return std::tie(k.nodes, k.type, k.element); });
  for (std::size_t i = 1, first = 0; i < lines.size(); ++i) {
    if (!lines[i].is_on(lines[first])) {
      first = i;
      continue;
    }
    ++result.n_doubled_lines;
    if (result.doubled_lines.size() < options.max_places)
      result.doubled_lines.emplace_back(lines[first].element, lines[i].element);
  }
}

}  // namespace meshgraft
