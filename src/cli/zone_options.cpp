#include "cli/zone_options.hpp"

#include <array>

namespace meshgraft::cli {
namespace {

constexpr double kHighestMinQuality = 0.9;  // a sheet of triangles all better than this is rarely possible

}  // namespace

Result<double> quality(const Typed& typed) {
  return number_in(typed, {.low = 0, .high = kHighestMinQuality, .allowed = "an aspect ratio Q from 0 to 0.9"});
}

Result<Method> method(const Typed& typed) {
  static const std::vector<std::string> kNames{"adaptive", "paper"};
  static constexpr std::array kMethods{Method::kAdaptive, Method::kPaper};
  return choice(typed, kNames).map([](std::size_t k) { return kMethods[k]; });
}

Result<Blend> blend(const Typed& typed) {
  static const std::vector<std::string> kNames{"position", "tangency", "curvature"};
  static constexpr std::array kBlends{Blend::kPosition, Blend::kTangency, Blend::kCurvature};
  return choice(typed, kNames).map([](std::size_t k) { return kBlends[k]; });
}

void add_method_option(Arguments& a) {
  a.value("--method", "METHOD",
          "how the area is meshed: adaptive (improved step by step) or paper (filled, refined, deformed, and no more) "
          "[default: adaptive]");
}

void add_blend_option(Arguments& a, const std::string& when) {
  a.value("--blend", "CONTINUITY",
          "how filled curved areas meet their surroundings: position, tangency or curvature" + when +
              " [default: tangency]");
}

void add_output_options(Arguments& a) {
  a.value("-o,--output", "OUT", "file written (UNV); appears whole or not at all; required");
  a.value("--report", "FILE", "JSON file with the ledger and all figures [default: none]");
}

void add_zone_options(Arguments& a, const std::string& tolerance_help, MergeArguments& out) {
  a.value("--tolerance", "LEN|N%", tolerance_help);
  a.value("--size", "LEN|auto",
          "edge length along the junction, in file units; auto: mean edge length there [default: auto]");
  a.value("--bandwidth", "N|auto", "neighbourhoods of the junction remeshed on both sides, a count [default: auto]");
  add_quality_options(a, out);
}

void add_quality_options(Arguments& a, MergeArguments& out) {
  a.value("--min-quality", "Q", "worst aspect ratio accepted in new faces, 0 to 0.9; 1 is equilateral [default: 0.5]");
  a.flag("--allow-poor", out.allow_poor, "write the result although a promise is not met [default: no]");
}

Result<void> read_output_options(const Arguments& a, MergeArguments& out) {
  const auto text = [](const Typed& typed) { return Result<std::string>(typed.text); };
  Result<void> done = store(a, "--output", text, out.output);
  if (done) done = store(a, "--report", text, out.report);
  if (done) done = store(a, "--min-quality", quality, out.options.min_quality);
  return done;
}

Result<void> read_zone_options(const Arguments& a, MergeArguments& out) {
  MergeOptions& o = out.options;
  Result<void> done = read_output_options(a, out);
  if (done) done = store(a, "--tolerance", tolerance, o.tolerance);
  if (done) done = store(a, "--size", size, o.size);
  if (done) done = store(a, "--bandwidth", bandwidth, o.bandwidth);
  if (done && out.output.empty()) return a.missing("-o OUT, the file to write,");
  return done;
}

}  // namespace meshgraft::cli
