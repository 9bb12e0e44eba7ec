#include "cli/merge_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "cli/print.hpp"
#include "io/side_file.hpp"

namespace meshgraft::cli {
namespace {

constexpr std::size_t kPoorShown = 3;
constexpr const char* kSideFile = "side file";  // a fate of write_unv

/// The file of an input, without its folder.
std::string input_name(const MergeArguments& arguments, std::size_t input) {
  if (input > arguments.parts.size()) return fmt::format("input {}", input);
  const std::string& path = input == 0 ? arguments.base : arguments.parts[input - 1];
  return printable(std::filesystem::path(path).filename().string());
}

/// What polylines amount to.
struct Met {
  std::size_t curves = 0, points = 0, closed = 0;
  double length = 0;
  std::map<std::string, std::size_t> of_kind;  // curves

  void add(const PolylineSummary& p) {
    if (p.kind == "point") {
      ++points;
      return;
    }
    ++curves, ++of_kind[p.kind], closed += p.closed ? 1 : 0, length += p.length;
  }
  [[nodiscard]] std::string kinds() const {
    std::string text;
    for (const auto& [kind, n] : of_kind) text += fmt::format("{}{} {}", text.empty() ? " (" : ", ", n, kind);
    return text.empty() ? text : text + ")";
  }
  [[nodiscard]] std::string single_nodes() const {
    return points == 0 ? std::string{} : fmt::format("; {}", counted(points, "single node", "single nodes"));
  }
};

/// A line: how many of the components that were to be joined meet another one; where groups are named, others were not.
std::string met_components(const Report& report, const std::vector<JoinedGroups>& joins) {
  std::set<std::uint32_t> met;
  for (const PolylineSummary& p : report.junction) met.insert(p.components.begin(), p.components.end());
  const auto is_named = [&](const std::string& group) {
    return std::ranges::any_of(joins, [&](const JoinedGroups& j) { return j.a == group || j.b == group; });
  };
  std::size_t all = 0, joined = 0;
  for (std::uint32_t c = 0; c < report.components.size(); ++c) {
    if (!joins.empty() && std::ranges::none_of(report.components[c].groups, is_named)) continue;
    ++all, joined += met.contains(c) ? 1 : 0;
  }
  return fmt::format("\n{} of {} connected meshes{} met", joined, all,
                     joins.empty() ? "" : " of the groups to be joined");
}

/// Area in which an input lies on others.
double overlap_area(const Report& report, std::uint32_t input) {
  double area = 0;
  for (const OverlapEntry& o : report.overlaps)
    if (std::ranges::find(o.inputs, input) != o.inputs.end()) area += o.area;
  return area;
}

std::string junction(const Report& report, const MergeArguments& arguments) {
  Met all;
  for (const PolylineSummary& p : report.junction) all.add(p);
  std::string text = fmt::format("{}{}, total length {}; {} closed{}", counted(all.curves, "curve", "curves"),
                                 all.kinds(), figure(all.length), all.closed, all.single_nodes());
  for (std::size_t part = 1; part <= arguments.parts.size(); ++part) {
    Met of_part;
    for (const PolylineSummary& p : report.junction)
      if (std::ranges::find(p.inputs, part) != p.inputs.end()) of_part.add(p);
    const double lying = overlap_area(report, static_cast<std::uint32_t>(part));
    const bool in_nodes = of_part.curves + of_part.points > 0;
    text += fmt::format("\n{}: ", input_name(arguments, part));
    if (in_nodes)
      text += fmt::format("{}, length {}{}", counted(of_part.curves, "curve", "curves"), figure(of_part.length),
                          of_part.single_nodes());
    if (lying > 0) text += fmt::format("{}lies on others, area {}", in_nodes ? "; " : "", figure(lying));
    if (!in_nodes && lying == 0) text += "meets nothing";
  }
  if (!report.components.empty() && arguments.parts.empty()) text += met_components(report, arguments.options.joins);
  return text;
}

std::string dropped(const Report& report) {
  double area = 0;
  std::uint64_t faces = 0;
  for (const DroppedEntry& d : report.dropped) area += d.area, faces += d.faces;
  return fmt::format("{}, area {}, with {} or parts of them", counted(report.dropped.size(), "piece", "pieces"),
                     figure(area), counted(faces, "triangle", "triangles"));
}

std::string zone(const Report& report, const MergeArguments& arguments) {
  std::string text = fmt::format("{} removed, {} created; nodes: {} removed, {} created",
                                 counted(report.zone.faces_removed, "triangle", "triangles"), report.zone.faces_created,
                                 report.zone.nodes_removed, report.zone.nodes_created);
  if (!report.zone.bandwidth.empty()) text += "\nneighbourhoods remeshed:";
  for (std::size_t k = 0; k < report.zone.bandwidth.size(); ++k)
    text += fmt::format("{} {} of {}", k == 0 ? "" : ",", report.zone.bandwidth[k], input_name(arguments, k));
  if (report.zone.widened > 0) text += fmt::format("; widened {}", counted(report.zone.widened, "time", "times"));
  return text;
}

std::string quality(const Report& report, const MergeArguments& arguments) {
  const QualitySummary& q = report.quality;
  if (q.faces == 0) return "no new triangles";
  const double wanted = arguments.options.min_quality;
  std::string text =
      fmt::format("worst Q {:.3f}, mean {:.3f}; {} of {} below {}", q.min, q.mean, q.below, q.faces, wanted);
  std::size_t shown = 0;
  for (const QualityPlace& p : q.worst) {
    if (p.q >= wanted || shown++ == kPoorShown) break;
    text += fmt::format("\nelement {} at ({}, {}, {}): Q {:.3f}{}{}", p.element, figure(p.at.x), figure(p.at.y),
                        figure(p.at.z), p.q, p.cause.empty() ? "" : "; ", p.cause);
  }
  return text;
}

std::string surface(const Report& report) {
  if (!report.fidelity) return "no face was replaced, so there is none to be measured from";
  return fmt::format("new mesh at most {} from that of the inputs ({:.2g} % of the edge length there)",
                     figure(report.fidelity->max_distance), 100 * report.fidelity->max_distance_relative);
}

bool changed(const GroupEntry& g) {
  return g.rule != "untouched" || g.members_before != g.members_after || g.area_before != g.area_after ||
         g.length_before != g.length_after;
}

std::string groups(const Report& report) {
  const auto n = std::ranges::count_if(report.groups, changed);
  const auto lost = std::ranges::count_if(
      report.groups, [](const GroupEntry& g) { return g.members_before > 0 && g.members_after == 0; });
  return fmt::format("{} untouched, {} with changed members, {} emptied",
                     static_cast<std::ptrdiff_t>(report.groups.size()) - n, n - lost, lost);
}

std::string labels(const Report& report, const MergeArguments& arguments) {
  if (report.labels.empty()) return "all kept";
  std::map<std::tuple<std::uint32_t, std::string, std::int64_t>, std::size_t> n;  // input, kind, shift
  for (const LabelShift& l : report.labels) ++n[{l.input, l.kind, l.to - l.from}];
  std::string text = "base kept; in parts, where taken already:";
  for (const auto& [key, count] : n) {
    const auto& [input, kind, shift] = key;
    text += fmt::format("\n{}: {} + {}", input_name(arguments, input), counted(count, kind, kind + "s"), shift);
  }
  return text;
}

std::string moved(const Report& report, const MergeArguments& arguments) {
  if (report.moved.empty()) return "no node of an input";
  const auto furthest = std::ranges::max_element(report.moved, {}, &MovedEntry::distance);
  return fmt::format("{}, at most {} (node {} of {})", counted(report.moved.size(), "node", "nodes"),
                     figure(furthest->distance), furthest->node, input_name(arguments, furthest->input));
}

/// Text that is not interpreted, by what became of it.
std::string other_data(const Report& report, const MergeArguments& arguments) {
  std::map<std::string, std::size_t> fates;
  for (const DatasetEntry& d : report.datasets) ++fates[d.fate];
  std::string text;
  for (const auto& [fate, n] : fates)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", counted(n, "dataset", "datasets"), fate);
  if (fates.contains(kSideFile)) text += fmt::format(" {}", printable(side_path(arguments.output)));
  return text;
}

void print_details(const Report& report) {
  std::string text;
  for (const auto& [stage, seconds] : report.timings)
    text += fmt::format("{}{:<16}{:8.3f} s", text.empty() ? "" : "\n", stage, seconds);
  if (!text.empty()) print_line("timings", text);
  print_line("peak memory", bytes(report.peak_memory_bytes));
  text.clear();
  for (const GroupEntry& g : report.groups) {
    if (!changed(g)) continue;
    text += fmt::format("{}{} ({}): {} -> {} members", text.empty() ? "" : "\n", printable(g.name), g.kind,
                        g.members_before, g.members_after);
    if (g.area_before > 0 || g.area_after > 0)
      text += fmt::format(", area {} -> {}", figure(g.area_before), figure(g.area_after));
    if (g.length_before > 0 || g.length_after > 0)
      text += fmt::format(", length {} -> {}", figure(g.length_before), figure(g.length_after));
    text += "; " + g.rule;
  }
  if (!text.empty()) print_line("ledger", text);
}

}  // namespace

void print_summary(const Report& report, const MergeArguments& arguments, std::string_view written) {
  const bool is_cut = std::ranges::find(report.dropped, "cut", &DroppedEntry::cause) != report.dropped.end();
  const bool is_filled = std::ranges::find(report.junction, "filled", &PolylineSummary::kind) != report.junction.end();
  print_line(is_cut ? "cut" : is_filled ? "filled" : "parts met", junction(report, arguments));
  if (!report.dropped.empty()) print_line("dropped", dropped(report));
  print_line("zone", zone(report, arguments));
  print_line("quality", quality(report, arguments));
  print_line("surface", surface(report));
  print_line("groups", groups(report));
  print_line("labels", labels(report, arguments));
  print_line("moved", moved(report, arguments));
  print_line("untouched", fmt::format("{} nodes, {} elements, {} of text", report.untouched.nodes,
                                      report.untouched.elements, bytes(report.untouched.bytes)));
  if (const std::string text = other_data(report, arguments); !text.empty()) print_line("other data", text);
  print_line("warnings", fmt::format("{}", report.warnings.size()));
  if (arguments.common.talk == Talk::kVerbose) print_details(report);
  print_line("written", written);
}

}  // namespace meshgraft::cli
