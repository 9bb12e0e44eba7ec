#include "io/coordinate_systems.hpp"

#include <array>
#include <optional>

#include "io/unv_numbers.hpp"

namespace meshgraft::unv {
namespace {

constexpr double kIdentity[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

class Reader {
 public:
  Reader(const LineScanner& lines, const Dataset& dataset)
      : lines_(lines), at_(dataset.body), limit_(dataset.body_end) {}
  [[nodiscard]] bool at_end() const { return at_ >= limit_; }
  std::string_view line() {
    if (at_end()) return {};
    const Line line = lines_.at(at_, limit_);
    at_ = line.next;
    return lines_.view(line);
  }

 private:
  const LineScanner& lines_;
  std::size_t at_, limit_;
};

/// 2420: label, type, colour; name; three rotation rows and the translation.
std::vector<CoordinateSystem> current_systems(Reader reader) {
  std::vector<CoordinateSystem> systems;
  std::vector<std::int64_t> header;
  reader.line(), reader.line();  // part and its name
  while (!reader.at_end()) {
    const std::string_view line = reader.line();
    if (trimmed(line).empty()) continue;
    if (parse_integers(line, header) == Cut::kNone || header.size() < 2) return {};
    reader.line();
    CoordinateSystem system{header[0], header[1] == 0};
    for (std::size_t row = 0; row < 4; ++row) {
      Reals reals;
      if (parse_reals(reader.line(), kRealWidth, reals) == Cut::kNone || reals.count != 3) return {};
      for (std::size_t k = 0; k < 3; ++k) system.global = system.global && reals.value[k] == kIdentity[3 * row + k];
    }
    systems.push_back(system);
  }
  return systems;
}

/// 18: number, type, ...; name; origin, point on +x, point in +xz: nine values on two lines.
std::vector<CoordinateSystem> old_systems(Reader reader) {
  std::vector<CoordinateSystem> systems;
  std::vector<std::int64_t> header;
  while (!reader.at_end()) {
    const std::string_view line = reader.line();
    if (trimmed(line).empty()) continue;
    if (parse_integers(line, header) == Cut::kNone || header.size() < 2) return {};
    reader.line();
    std::vector<double> values;
    for (int k = 0; k < 2; ++k) {
      for (std::string_view rest = right_trimmed(reader.line()); !rest.empty();
           rest.remove_prefix(std::min(rest.size(), kShortRealWidth))) {
        const auto value = parse_real(trimmed(rest.substr(0, kShortRealWidth)));
        if (!value) return {};
        values.push_back(*value);
      }
    }
    constexpr std::size_t kValues = 9;
    if (values.size() != kValues) return {};
    const bool origin = values[0] == 0 && values[1] == 0 && values[2] == 0;
    const bool x = values[3] > 0 && values[4] == 0 && values[5] == 0;
    const bool xz = values[7] == 0 && values[8] > 0;
    systems.push_back({header[0], header[1] == 0 && origin && x && xz});
  }
  return systems;
}

}  // namespace

std::vector<CoordinateSystem> coordinate_systems(const LineScanner& lines, const Dataset& dataset) {
  return dataset.number == 18 ? old_systems(Reader(lines, dataset)) : current_systems(Reader(lines, dataset));
}

}  // namespace meshgraft::unv
