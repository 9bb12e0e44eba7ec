// meshgraft_orders: how the error of filled holes falls with the edge length on known surfaces, as a table in Markdown;
// or, with --wide, what holes take that are many edges wide.
#include <fmt/format.h>

#include <ctime>
#include <iostream>
#include <string_view>

#include "support/known_surfaces.hpp"

namespace meshgraft::validation {
namespace {

struct NamedBlend {
  const char* name;
  Blend blend;
};
constexpr std::array kBlends{NamedBlend{"position", Blend::kPosition}, NamedBlend{"tangency", Blend::kTangency},
                             NamedBlend{"curvature", Blend::kCurvature}};

/// The errors of all sizes, then the order with which they fall.
std::string cells(std::span<const scenes::Refill> refills, double scenes::Refill::*error) {
  std::string text;
  for (const scenes::Refill& r : refills) text += fmt::format(" {:.1e} |", r.*error);
  return text + fmt::format(" {:.1f} |", scenes::order_of(refills, error));
}

/// Of all threads, in seconds.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A hole of one width, meshed finer and finer.
int run_wide() {
  constexpr double kRadius = 0.8;
  std::cout << "| surface | contour nodes | new triangles | worst Q | mean Q | distance | processor time |\n"
               "|---|---|---|---|---|---|---|\n";
  for (const scenes::KnownSurface& surface : scenes::known_surfaces()) {
    for (const double edges : {14.0, 45.0, 140.0}) {
      const double start = processor_time();
      const auto refill = scenes::refilled(surface, kRadius / edges, Blend::kTangency, edges);
      if (!refill) return std::cerr << to_string(refill.error()) << '\n', 1;
      const double seconds = processor_time() - start;
      const Report& r = refill->merged.report;
      std::cout << fmt::format("| {} | {} | {} | {:.3f} | {:.3f} | {:.1e} | {:.1f} s |\n", surface.name,
                               r.junction.front().nodes, r.zone.faces_created, r.quality.min, r.quality.mean,
                               refill->distance, seconds)
                << std::flush;
    }
  }
  return 0;
}

int run() {
  std::string head = "| surface | continuity |", line = "|---|---|";
  for (const char* what : {"distance", "normals"}) {
    for (const double size : scenes::kRefillSizes) head += fmt::format(" {}, edges {} |", what, size), line += "---|";
    head += " order |", line += "---|";
  }
  std::cout << head << '\n' << line << '\n';
  for (const scenes::KnownSurface& surface : scenes::known_surfaces())
    for (const NamedBlend& blend : kBlends) {
      std::vector<scenes::Refill> refills;
      for (const double size : scenes::kRefillSizes) {
        auto refill = scenes::refilled(surface, size, blend.blend);
        if (!refill) return std::cerr << to_string(refill.error()) << '\n', 1;
        refills.push_back(std::move(*refill));
      }
      std::cout << fmt::format("| {} | {} |", surface.name, blend.name) << cells(refills, &scenes::Refill::distance)
                << cells(refills, &scenes::Refill::normal) << '\n';
    }
  return 0;
}

}  // namespace
}  // namespace meshgraft::validation

int main(int argc, char** argv) {
  return argc > 1 && std::string_view(argv[1]) == "--wide" ? meshgraft::validation::run_wide()
                                                           : meshgraft::validation::run();
}
