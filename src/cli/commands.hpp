// One function per command. Each prints its results, warnings and errors, and returns the exit code.
#pragma once

#include "cli/arguments.hpp"
#include "cli/exit_codes.hpp"

namespace meshgraft::cli {

[[nodiscard]] ExitCode run(const Answer& answer);
[[nodiscard]] ExitCode run(const MergeArguments& arguments);
[[nodiscard]] ExitCode run(const CutArguments& arguments);
[[nodiscard]] ExitCode run(const FillArguments& arguments);
[[nodiscard]] ExitCode run(const CheckArguments& arguments);
[[nodiscard]] ExitCode run(const InfoArguments& arguments);
[[nodiscard]] ExitCode run(const ConvertArguments& arguments);

/// Prints the error; its exit code.
[[nodiscard]] ExitCode failed(const Error& error);

}  // namespace meshgraft::cli
