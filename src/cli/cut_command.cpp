#include <algorithm>

#include "cli/commands.hpp"
#include "cli/mesh_command.hpp"
#include "cli/nearest.hpp"
#include "cli/print.hpp"
#include "meshgraft/cut.hpp"

namespace meshgraft::cli {
namespace {

/// A group that is not there is often one that was mistyped.
Result<void> check_group(const Model& base, const Drop& drop) {
  if (drop.what != Drop::What::kGroup) return {};
  std::vector<std::string> names;
  for (const Group& group : base.groups) names.push_back(group.name);
  if (std::ranges::find(names, drop.group) != names.end()) return {};
  const auto near = nearest(drop.group, names);
  return failure(ErrorCode::kUsage,
                 "--drop: there is no group '" + printable(drop.group) + "' in " + printable(base.path) +
                     (near ? "; did you mean '" + printable(*near) + "'?" : ""),
                 "--drop takes inside, outside, or the name of a group of BASE", {});
}

}  // namespace

ExitCode run(const CutArguments& arguments) {
  MergeArguments mesh = arguments.mesh;
  mesh.common = arguments.common;
  MeshCommand command;
  command.inputs = {{"BASE", arguments.mesh.base}};
  if (!arguments.tool_file.empty()) command.inputs.push_back({"TOOL", arguments.tool_file});
  command.run = [&](std::span<const Model> inputs, const Stopwatch::Progress& progress) -> Result<Merged> {
    if (const auto good = check_group(inputs[0], arguments.drop); !good) return Failure(good.error());
    CutOptions options{arguments.drop, arguments.mesh.options};
    options.zone.progress = progress;
    return cut(inputs[0], inputs.size() > 1 ? CutTool(&inputs[1]) : arguments.tool, options);
  };
  return run(command, mesh);
}

}  // namespace meshgraft::cli
