// The options of all commands that remesh a zone.
#pragma once

#include "cli/command_reader.hpp"

namespace meshgraft::cli {

/// A worst Q to be reached or reported.
[[nodiscard]] Result<double> quality(const Typed& typed);

/// How an area is filled.
[[nodiscard]] Result<Method> method(const Typed& typed);
/// The continuity of a deformed area with its surroundings.
[[nodiscard]] Result<Blend> blend(const Typed& typed);

/// Where the result goes.
void add_output_options(Arguments& a);
void add_method_option(Arguments& a);
/// `when`: what the option depends on, or nothing.
void add_blend_option(Arguments& a, const std::string& when);
/// What is promised of the new faces, and whether a result that breaks a promise is written.
void add_quality_options(Arguments& a, MergeArguments& out);
/// How the zone is remeshed, and whether a result that breaks a promise is written.
void add_zone_options(Arguments& a, const std::string& tolerance_help, MergeArguments& out);
/// Stores the values of the output and quality options.
[[nodiscard]] Result<void> read_output_options(const Arguments& a, MergeArguments& out);
/// Stores the values of all of them. Error kUsage if there is no output.
[[nodiscard]] Result<void> read_zone_options(const Arguments& a, MergeArguments& out);

}  // namespace meshgraft::cli
