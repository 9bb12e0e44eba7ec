#include "cli/commands.hpp"
#include "cli/mesh_command.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft::cli {

ExitCode run(const MergeArguments& arguments) {
  MeshCommand command;
  command.inputs = {{"BASE", arguments.base}};
  for (const std::string& part : arguments.parts) command.inputs.push_back({"PART", part});
  command.n_parts = arguments.parts.size();
  command.run = [&](std::span<const Model> inputs, const Stopwatch::Progress& progress) {
    MergeOptions options = arguments.options;
    options.progress = progress;
    return merge(inputs.front(), inputs.subspan(1), options);
  };
  return run(command, arguments);
}

}  // namespace meshgraft::cli
