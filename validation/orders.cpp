// meshgraft_orders: how the error of filled holes falls with the edge length on known surfaces, as a table in Markdown.
#include <fmt/format.h>

#include <iostream>

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

int main() { return meshgraft::validation::run(); }
