#include <fmt/format.h>

#include <limits>
#include <span>

#include "cli/commands.hpp"
#include "cli/print.hpp"
#include "cli/progress.hpp"
#include "meshgraft/check.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft::cli {
namespace {

/// "14 (line 220)": the label the user knows, and where it stands in the file.
template <class Id>
std::string place(const Model& model, std::int64_t label, Id id) {
  const Place at = place_of(model, id);
  return at.line > 0 ? fmt::format("{} (line {})", label, at.line) : fmt::format("{}", label);
}
std::string named(const Model& model, ElementId e) {
  return fmt::format("element {}", place(model, model.element_label[e.value], e));
}
std::string named(const Model& model, NodeId n) {
  return fmt::format("node {}", place(model, model.node_label[n.value], n));
}
template <class Id>
std::string named(const Model& model, const std::pair<Id, Id>& pair) {
  return fmt::format("{} and {}", named(model, pair.first), named(model, pair.second));
}

/// The number of findings and the first places, one below the other.
template <class T>
std::string findings(const Model& model, std::uint64_t n, std::span<const T> places) {
  std::string text = fmt::format("{}", n);
  for (const T& p : places) text += fmt::format("\n{}", named(model, p));
  if (n > places.size() && !places.empty()) text += fmt::format("\n... and {} more, which -v lists", n - places.size());
  return text;
}

void print_quality(const Model& model, const CheckResult& r, double min_quality) {
  if (r.faces == 0) return print_line("quality", "no triangles");
  std::string text = fmt::format("worst Q {:.4f}, 1 % below {:.4f}, mean {:.4f}; {} of {} below {}", r.min_q, r.p01_q,
                                 r.mean_q, r.below_min_quality, r.faces, min_quality);
  for (const auto& [face, q] : r.worst_faces)
    if (q < min_quality) text += fmt::format("\n{}: Q {:.4f}", named(model, face), q);
  print_line("quality", text);
}

Warning doubled(const Model& model, const CheckResult& r) {
  const auto& [a, b] = r.doubled_lines.front();
  return {
      "doubled-line",
      fmt::format("{} of one type on the same nodes, the first are elements {} and {}; their stiffness counts twice",
                  counted(r.n_doubled_lines, "pair of 1D elements", "pairs of 1D elements"),
                  model.element_label[a.value], model.element_label[b.value]),
      place_of(model, b)};
}

const char* verdict(const CheckResult& r) {
  if (r.faces == 0) return "nothing to check: no triangles";
  return r.sound() ? "sound: no degenerate or duplicate triangle, no intersection"
                   : "not sound: degenerate, duplicate or intersecting triangles";
}

void print_check(const Model& model, const CheckResult& r, double min_quality) {
  print_line("triangles", fmt::format("{}, area {}", r.faces, figure(r.area)));
  if (model.n_elements() > r.faces)
    print_line("", fmt::format("not checked: {} of other kinds",
                               counted(model.n_elements() - r.faces, "element", "elements")));
  print_line(
      "edges",
      fmt::format("mean length {}; {} free, {} non-manifold, {} sharp, {} between opposite orientations",
                  figure(r.mean_edge_length), r.free_edges, r.non_manifold_edges, r.sharp_edges, r.flipped_edges));
  print_quality(model, r, min_quality);
  print_line("degenerate", findings<ElementId>(model, r.n_degenerate_faces, r.degenerate_faces));
  print_line("duplicate", findings<std::pair<ElementId, ElementId>>(model, r.n_duplicate_faces, r.duplicate_faces));
  print_line("doubled 1D", findings<std::pair<ElementId, ElementId>>(model, r.n_doubled_lines, r.doubled_lines));
  print_line("intersecting", findings<std::pair<ElementId, ElementId>>(model, r.intersections, r.intersecting_faces));
  print_line("coincident", findings<std::pair<NodeId, NodeId>>(model, r.n_coincident_nodes, r.coincident_nodes));
  print_line("unused nodes", findings<NodeId>(model, r.n_orphan_nodes, r.orphan_nodes));
  print_line("groups", fmt::format("{}; {} empty; {} of things that do not exist", model.groups.size(), r.empty_groups,
                                   counted(r.dangling_group_entries, "entry", "entries")));
  print_line("verdict", verdict(r));
}

}  // namespace

ExitCode run(const CheckArguments& arguments) {
  const bool quiet = arguments.common.talk == Talk::kQuiet;
  Progress progress(!quiet);
  progress.show("reading", 0);
  const auto model = read_unv(arguments.file, {.threads = arguments.common.threads, .unclosed = true});
  progress.clear();
  if (!model) return failed(model.error());
  progress.show("checking", 0.5);
  CheckOptions options;
  options.min_quality = arguments.min_quality;
  if (arguments.common.talk == Talk::kVerbose) options.max_places = std::numeric_limits<std::size_t>::max();
  const CheckResult result = check(*model, options);
  progress.clear();
  std::vector<Warning> warnings = model->warnings;
  if (result.n_doubled_lines > 0) warnings.push_back(doubled(*model, result));
  if (!quiet) {
    print_warnings(warnings, arguments.common.talk);
    print_line("file", printable(arguments.file));
    print_check(*model, result, arguments.min_quality);
  }
  return result.sound() ? kDone : kPromiseNotMet;
}

}  // namespace meshgraft::cli
