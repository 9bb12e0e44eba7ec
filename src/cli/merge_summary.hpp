// A merge in a few lines.
#pragma once

#include <string_view>

#include "cli/arguments.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft::cli {

/// `written`: the last line, a file or why there is none.
void print_summary(const Report& report, const MergeArguments& arguments, std::string_view written);

}  // namespace meshgraft::cli
