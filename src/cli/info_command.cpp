#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "cli/commands.hpp"
#include "cli/print.hpp"
#include "cli/progress.hpp"
#include "io/unv_document.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft::cli {
namespace {

constexpr std::size_t kGroupsShown = 30;
constexpr std::int64_t kUnitsDataset = 164;

const char* plural(Shape shape) {
  switch (shape) {
    case Shape::kPoint:
      return "points";
    case Shape::kLine:
      return "lines";
    case Shape::kLine3:
      return "parabolic lines";
    case Shape::kTriangle:
      return "triangles";
    case Shape::kTriangle6:
      return "parabolic triangles";
    case Shape::kQuad:
      return "quadrilaterals";
    case Shape::kQuad8:
      return "parabolic quadrilaterals";
    case Shape::kSolid:
      return "solids";
    case Shape::kOther:
      break;
  }
  return "others";
}

std::string elements_by_kind(const Model& model) {
  std::map<Shape, std::uint64_t> n;
  for (std::size_t e = 0; e < model.n_elements(); ++e) ++n[model.shape(ElementId(e))];
  std::string text = fmt::format("{}", model.n_elements());
  for (const auto& [shape, count] : n)
    text += fmt::format("{} {} {}", &n.at(shape) == &n.begin()->second ? ":" : ",", count, plural(shape));
  return text;
}

/// Corners of an element whose sides are edges of the mesh, in order around it; none for other kinds.
std::vector<NodeId> corners(const Model& model, ElementId element) {
  const Shape shape = model.shape(element);
  const bool parabolic = shape == Shape::kLine3 || shape == Shape::kTriangle6 || shape == Shape::kQuad8;
  const bool linear = shape == Shape::kLine || shape == Shape::kTriangle || shape == Shape::kQuad;
  std::vector<NodeId> out;
  const auto nodes = model.nodes_of(element);
  for (std::size_t k = 0; (linear || parabolic) && k < nodes.size(); k += parabolic ? 2 : 1)
    if (nodes[k].valid()) out.push_back(nodes[k]);
  return out;
}

/// Mean over the sides of all surface elements, or of all lines where there are none.
std::string mean_edge(const Model& model) {
  struct Mean {
    double sum = 0;
    std::uint64_t n = 0;
    void add(double length) { sum += length, ++n; }
    [[nodiscard]] std::string text() const { return figure(sum / static_cast<double>(n)); }
  } surface, line;
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    const std::vector<NodeId> c = corners(model, ElementId(e));
    const auto length = [&](std::size_t a, std::size_t b) {
      return distance(model.position[c[a].value], model.position[c[b].value]);
    };
    if (c.size() == 2) line.add(length(0, 1));
    for (std::size_t k = 0; c.size() > 2 && k < c.size(); ++k) surface.add(length(k, (k + 1) % c.size()));
  }
  if (surface.n > 0) return surface.text() + ", mean over the sides of all surface elements";
  if (line.n > 0) return line.text() + ", mean over the lines";
  return "unknown: no surface elements and no lines";
}

std::string units(const Model& model) {
  if (!model.units) return "not stated (no dataset 164)";
  const Units& u = *model.units;
  return fmt::format("code {}; factors from SI: length {:.10g}, force {:.10g}, temperature {:.10g}", u.code, u.length,
                     u.force, u.temperature);
}

std::string box(const Model& model) {
  Box b;
  for (const Vec3& p : model.position) b.add(p);
  if (b.empty()) return "empty";
  return fmt::format("x {} to {}, y {} to {}, z {} to {}", figure(b.low.x), figure(b.high.x), figure(b.low.y),
                     figure(b.high.y), figure(b.low.z), figure(b.high.z));
}

std::string members(const Group& g) {
  std::string text;
  const auto add = [&](std::uint64_t n, const char* one, const char* many) {
    if (n > 0) text += (text.empty() ? "" : ", ") + counted(n, one, many);
  };
  add(g.n_nodes, "node", "nodes");
  add(g.n_elements, "element", "elements");
  add(g.n_other, "other entity", "other entities");
  add(g.n_dangling, "entry of nothing that exists", "entries of nothing that exists");
  return text.empty() ? "empty" : text;
}

void print_groups(const Model& model, Talk talk) {
  print_line("groups", fmt::format("{}", model.groups.size()));
  const std::size_t shown = talk == Talk::kVerbose ? model.groups.size() : std::min(kGroupsShown, model.groups.size());
  std::size_t width = 0;
  for (std::size_t g = 0; g < shown; ++g) width = std::max(width, model.groups[g].name.size());
  for (std::size_t g = 0; g < shown; ++g) {
    const Group& group = model.groups[g];
    say(stdout, "{:>10}  {:<{}}  {}\n", group.number, printable(group.name), width, members(group));
  }
  if (shown < model.groups.size())
    say(stdout, "{:>10}  and {} more; -v shows all\n", "...", model.groups.size() - shown);
}

/// Datasets that are passed on as text, by number.
void print_datasets(const Model& model) {
  const auto* document = dynamic_cast<const unv::Document*>(model.source.get());
  if (document == nullptr) return;
  struct Kind {
    std::size_t n = 0, bytes = 0;
    std::uint64_t line = 0;
  };
  std::map<std::pair<std::int64_t, bool>, Kind> kinds;
  for (const unv::Dataset& d : document->datasets) {
    if (d.kind() != unv::DatasetKind::kOther || d.number == kUnitsDataset) continue;
    Kind& kind = kinds[{d.number, d.binary}];
    if (kind.n++ == 0) kind.line = document->line_of(d.number_line);
    kind.bytes += d.end - d.open;
  }
  if (kinds.empty()) return print_line("other data", "none");
  std::string text = "datasets that are not interpreted; merge and convert pass them on as they are";
  for (const auto& [key, kind] : kinds)
    text += fmt::format("\n{}{}: {} from line {}, {}", key.first, key.second ? "b" : "",
                        counted(kind.n, "dataset", "datasets"), kind.line, bytes(kind.bytes));
  print_line("other data", text);
}

}  // namespace

ExitCode run(const InfoArguments& arguments) {
  Progress progress(true);
  progress.show("reading", 0);
  const auto model = read_unv(arguments.file, {.threads = arguments.common.threads, .unclosed = true});
  progress.clear();
  if (!model) return failed(model.error());
  print_warnings(model->warnings, arguments.common.talk);

  print_line("file", printable(arguments.file));
  print_line("format", "I-DEAS universal file (UNV)");
  print_line("units", units(*model));
  print_line("nodes", fmt::format("{}", model->n_nodes()));
  print_line("elements", elements_by_kind(*model));
  print_line("box", box(*model));
  print_line("edge length", mean_edge(*model));
  print_groups(*model, arguments.common.talk);
  print_datasets(*model);
  return kDone;
}

}  // namespace meshgraft::cli
