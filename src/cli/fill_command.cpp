#include <fmt/format.h>

#include <optional>

#include "cli/commands.hpp"
#include "cli/mesh_command.hpp"
#include "cli/print.hpp"
#include "fill/chosen.hpp"
#include "meshgraft/fill.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft::cli {
namespace {

const char* kind_of(const Contour& c) {
  if (!c.is_fillable) return "along elements that are not linear triangles";
  return c.is_hole ? "hole" : "outer border or end of a pipe";
}

ExitCode list(const FillArguments& arguments) {
  const auto model = read_unv(arguments.mesh.base, ReadOptions{.threads = arguments.common.threads});
  if (!model) return failed(model.error());
  print_warnings(model->warnings, arguments.common.talk);
  const FreeEdges edges = free_edges_of(*model);
  if (const auto hidden = doubled_at_rims(*model, edges)) print_warnings({&*hidden, 1}, arguments.common.talk);
  const std::vector<Contour>& contours = edges.contours;
  std::vector<std::optional<std::size_t>> around(contours.size());  // the hole in which a contour stands
  for (const OpeningContours& opening : openings_of(*model, contours))
    for (std::size_t k = 1; k < opening.size(); ++k) around[opening[k]] = opening.front();
  for (std::size_t k = 0; k < contours.size(); ++k) {
    const Contour& c = contours[k];
    print_line(fmt::format("contour {}", k + 1),
               fmt::format("{}{}; {} nodes from node {}, length {}, around ({}, {}, {})", kind_of(c),
                           around[k] ? fmt::format(", within contour {}", *around[k] + 1) : "", c.nodes.size(),
                           model->node_label[c.nodes.front().value], figure(c.length), figure(c.centre.x),
                           figure(c.centre.y), figure(c.centre.z)));
  }
  if (contours.empty() && edges.others.empty()) print_line("contours", "none: the mesh has no free edges");
  if (!edges.others.empty()) print_line("no contour", fmt::format("closed by {} free edges", edges.others.size()));
  return kDone;
}

}  // namespace

ExitCode run(const FillArguments& arguments) {
  if (arguments.list) return list(arguments);
  MergeArguments mesh = arguments.mesh;
  mesh.common = arguments.common;
  MeshCommand command;
  command.inputs = {{"FILE", arguments.mesh.base}};
  command.run = [&](std::span<const Model> inputs, const Stopwatch::Progress& progress) {
    FillOptions options{arguments.openings, arguments.mesh.options};
    options.zone.progress = progress;
    return fill(inputs[0], options);
  };
  return run(command, mesh);
}

}  // namespace meshgraft::cli
