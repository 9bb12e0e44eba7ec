#include "merge/report_summary.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "merge/junction_summary.hpp"
#include "merge/labels.hpp"
#include "merge/new_junction.hpp"
#include "merge/result_check.hpp"

namespace meshgraft {
namespace {

constexpr double kRounding = 1.0 / (1L << 36);  // of a place: a node that moves less has not been moved

std::uint64_t count_faces(const Model& model, const std::vector<ElementId>& elements) {
  return static_cast<std::uint64_t>(std::ranges::count_if(elements, [&](ElementId e) { return model.is_face(e); }));
}

void count_changes(const Outcome& outcome, Report& report) {
  const Graft& graft = outcome.graft;
  for (std::size_t k = 0; k < outcome.inputs.size(); ++k) {
    const Model& model = *outcome.inputs[k];
    report.zone.faces_removed += count_faces(model, graft.removed_elements[k]);
    report.zone.nodes_removed += graft.removed_nodes[k].size();
    report.untouched.nodes += model.n_nodes() - graft.removed_nodes[k].size();
    report.untouched.elements += model.n_elements() - graft.removed_elements[k].size();
  }
  report.untouched.nodes -= graft.moved_nodes.size();
  report.zone.nodes_created = graft.new_nodes.size();
  report.zone.faces_created = static_cast<std::uint64_t>(
      std::ranges::count_if(graft.new_elements, [](const NewElement& e) { return e.nodes[2].valid(); }));
}

template <class Id>
void list_shifts(const std::vector<std::int64_t>& label, const std::vector<Id>& shifted, std::int64_t shift,
                 std::uint32_t input, const char* kind, std::vector<LabelShift>& list) {
  for (const Id id : shifted) list.push_back({input, kind, label[id.value], label[id.value] + shift});
}

void list_labels(const Outcome& outcome, Report& report) {
  const Labels& labels = outcome.labels;
  for (std::uint32_t k = 0; k < outcome.inputs.size(); ++k) {
    const Model& model = *outcome.inputs[k];
    list_shifts(model.node_label, labels.shifted_nodes[k], labels.node_shift[k], k, "node", report.labels);
    list_shifts(model.element_label, labels.shifted_elements[k], labels.element_shift[k], k, "element", report.labels);
  }
  const Model& base = *outcome.inputs[0];
  for (const NodeId n : outcome.graft.removed_nodes[0]) report.removed_nodes.push_back(base.node_label[n.value]);
  for (const ElementId e : outcome.graft.removed_elements[0])
    report.removed_elements.push_back(base.element_label[e.value]);
}

void list_moves(const Outcome& outcome, Report& report) {
  for (const auto& [node, to] : outcome.places.moved()) {
    const Model& model = *outcome.inputs[node.input];
    const Vec3 from = model.position[node.node.value];
    if (distance(from, to) <= kRounding * norm(from)) continue;
    report.moved.push_back({node.input, model.node_label[node.node.value], from, to, distance(from, to)});
  }
}

}  // namespace

void summarise(const Outcome& outcome, Report& report) {
  count_changes(outcome, report);
  report.junction = polylines_of(outcome.final_complex, new_junction(outcome, ResultCheckLimits{}.free_edge_distance),
                                 outcome.components);
  list_labels(outcome, report);
  list_moves(outcome, report);
}

std::uint64_t peak_memory_bytes() {
  // ru_maxrss would do, if it did not begin with the memory of the process that started this one.
  constexpr std::uint64_t kUnit = 1024;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::uint64_t kibibytes = 0; word == "VmHWM:" && status >> kibibytes) return kibibytes * kUnit;
  return 0;
}

}  // namespace meshgraft
