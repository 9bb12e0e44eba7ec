// meshgraft, the program: arguments in, one of the commands, exit code out.
#include <tbb/global_control.h>

#include <csignal>
#include <cstdio>
#include <new>
#include <optional>
#include <span>

#include "cli/commands.hpp"
#include "cli/print.hpp"

namespace meshgraft::cli {

ExitCode failed(const Error& error) {
  print_error(error);
  return exit_code(error.code);
}

ExitCode run(const Answer& answer) {
  say(stdout, "{}", answer.text);
  return kDone;
}

namespace {

unsigned threads(const Answer&) { return 0; }
template <class A>
unsigned threads(const A& arguments) {
  return arguments.common.threads;
}

ExitCode run_command(std::span<const char* const> arguments) {
  const auto understood = command(arguments);
  if (!understood) return failed(understood.error());
  const ExitCode code = std::visit(
      [](const auto& a) {
        std::optional<tbb::global_control> limit;
        if (threads(a) > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads(a));
        return run(a);
      },
      *understood);
  if (const auto arrived = results_arrived(); !arrived) return failed(arrived.error());
  return code;
}

}  // namespace
}  // namespace meshgraft::cli

int main(int argc, char** argv) {
  using namespace meshgraft::cli;
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is a failed write, not the end
  try {
    return run_command(std::span(argv, static_cast<std::size_t>(argc)).subspan(argc > 0 ? 1 : 0));
  } catch (const std::bad_alloc&) {
    std::fputs("meshgraft: error: out of memory\n", stderr);
    return kInputInvalid;
  }
}
