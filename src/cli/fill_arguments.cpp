#include "cli/fill_arguments.hpp"

#include <array>
#include <limits>
#include <ranges>

#include "cli/zone_options.hpp"

namespace meshgraft::cli {

namespace {

constexpr std::array<std::string_view, 4> kWithList{"--list", "--threads", "--quiet", "--verbose"};

}  // namespace

FillReader::FillReader(CLI::App& app) : CommandReader(app, "fill", "close holes of the mesh in FILE") {
  a_.name("FILE", out_.mesh.base, "mesh with holes (UNV)");
  add_output_options(a_);
  a_.flag("--list", out_.list, "only list the contours, with their numbers; no -o then [default: no]");
  a_.repeated(
      "--contour", "N[+N...]|all", numbers_,
      "contour to fill, by its number in --list; 2+5: one opening between contours 2 and 5 (a hole and an island "
      "in it, two ends of a pipe); may be given several times; all: holes, each with the islands in it, not "
      "outer borders and ends of pipes [default: all]");
  add_method_option(a_);
  add_blend_option(a_, "");
  a_.value("--size", "LEN|auto",
           "edge length in the filled area, in file units; auto: that of the faces around [default: auto]");
  add_quality_options(a_, out_.mesh);
  common_.add(a_, "no progress and no summary; errors and warnings stay", "also timings and groups that changed");
}

Result<void> FillReader::read_own() {
  if (out_.mesh.base.empty()) return a_.missing("FILE, the mesh to fill,");
  MergeOptions& o = out_.mesh.options;
  Result<void> done = read_contours();
  if (done) done = store(a_, "--method", method, o.method);
  if (done) done = store(a_, "--blend", blend, o.blend);
  if (done) done = store(a_, "--size", size, o.size);
  if (done) done = read_output_options(a_, out_.mesh);
  if (done && out_.list)
    if (const auto option = a_.given_beside(kWithList))
      return failure(ErrorCode::kUsage, fmt::format("--list only lists all contours; {} does nothing then", *option),
                     a_.see_help());
  if (done && !out_.list && out_.mesh.output.empty()) return a_.missing("-o OUT, the file to write,");
  return done;
}

Result<void> FillReader::read_contours() {
  for (const std::string& text : numbers_) {
    if (text == "all" && numbers_.size() == 1) return {};
    OpeningContours& opening = out_.openings.emplace_back();
    for (const auto part : std::views::split(text, '+')) {
      const auto n =
          integer_in({"--contour", std::string(part.begin(), part.end())}, 1, std::numeric_limits<int>::max(),
                     "the number of a contour in --list, several with + between them, or all by itself");
      if (!n) return Failure(n.error());
      opening.push_back(static_cast<std::size_t>(*n) - 1);
    }
  }
  return {};
}

}  // namespace meshgraft::cli
