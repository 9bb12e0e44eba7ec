#include <fmt/format.h>

#include <array>

#include "cli/commands.hpp"
#include "cli/formats.hpp"
#include "cli/outputs.hpp"
#include "cli/print.hpp"
#include "cli/progress.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft::cli {

ExitCode run(const ConvertArguments& arguments) {
  const bool quiet = arguments.common.talk == Talk::kQuiet;
  if (const auto known = writable_format(arguments.output); !known) return failed(known.error());
  const std::array inputs{NamedFile{"IN", arguments.input}};
  const std::array outputs{NamedFile{"OUT", arguments.output}};
  if (const auto good = check_outputs(inputs, outputs); !good) return failed(good.error());

  Progress progress(!quiet);
  progress.show("reading", 0);
  const auto model = read_unv(arguments.input, {.threads = arguments.common.threads, .unclosed = true});
  progress.clear();
  if (!model) return failed(model.error());
  print_warnings(model->warnings, arguments.common.talk);

  progress.show("writing", 0.5);
  const bool stdout_is_taken = is_stdout(arguments.output);
  const auto written = write_unv(*model, arguments.output);
  progress.clear();
  if (!written) return failed(written.error());
  if (!quiet && !stdout_is_taken) print_line("written", printable(arguments.output));
  return kDone;
}

}  // namespace meshgraft::cli
