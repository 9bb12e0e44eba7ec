#include "io/coordinate_systems.hpp"

#include <algorithm>
#include <array>

#include "io/unv_numbers.hpp"

namespace meshgraft::unv {
namespace {

using Systems = std::optional<std::vector<CoordinateSystem>>;

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
Systems current_systems(Reader reader) {
  std::vector<CoordinateSystem> systems;
  std::vector<std::int64_t> header;
  reader.line(), reader.line();  // part and its name
  while (!reader.at_end()) {
    const std::string_view line = reader.line();
    if (trimmed(line).empty()) continue;
    if (parse_integers(line, header) == Cut::kNone || header.size() < 2) return std::nullopt;
    reader.line();
    CoordinateSystem system;
    system.label = header[0], system.type = header[1];
    for (std::size_t row = 0; row < 4; ++row) {
      Reals reals;
      if (parse_reals(reader.line(), kRealWidth, reals) == Cut::kNone || reals.count != 3) return std::nullopt;
      std::ranges::copy(reals.value, system.axes.begin() + static_cast<std::ptrdiff_t>(3 * row));
    }
    systems.push_back(system);
  }
  return systems;
}

/// Rows of the rotation, then the origin, from the origin, a point on +x and one in the plane +xz.
std::array<double, 12> axes_of(Vec3 origin, Vec3 on_x, Vec3 in_xz) {
  const Vec3 x = normalized(on_x - origin), y = normalized(cross(in_xz - origin, x)), z = cross(x, y);
  return {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, origin.x, origin.y, origin.z};
}

/// 18: number, type, ...; name; origin, point on +x, point in +xz: nine values on two lines.
Systems old_systems(Reader reader) {
  std::vector<CoordinateSystem> systems;
  std::vector<std::int64_t> header;
  while (!reader.at_end()) {
    const std::string_view line = reader.line();
    if (trimmed(line).empty()) continue;
    if (parse_integers(line, header) == Cut::kNone || header.size() < 2) return std::nullopt;
    reader.line();
    std::vector<double> values;
    for (int k = 0; k < 2; ++k) {
      for (std::string_view rest = right_trimmed(reader.line()); !rest.empty();
           rest.remove_prefix(std::min(rest.size(), kShortRealWidth))) {
        const auto value = parse_real(trimmed(rest.substr(0, kShortRealWidth)));
        if (!value) return std::nullopt;
        values.push_back(*value);
      }
    }
    constexpr std::size_t kValues = 9;
    if (values.size() != kValues) return std::nullopt;
    const auto point = [&](std::size_t k) { return Vec3{values[k], values[k + 1], values[k + 2]}; };
    systems.push_back({header[0], header[1], axes_of(point(0), point(3), point(6)), NodeId()});
  }
  return systems;
}

}  // namespace

Systems coordinate_systems(const LineScanner& lines, const Dataset& dataset) {
  return dataset.number == 18 ? old_systems(Reader(lines, dataset)) : current_systems(Reader(lines, dataset));
}

}  // namespace meshgraft::unv
