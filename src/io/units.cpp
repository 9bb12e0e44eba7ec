#include "io/units.hpp"

#include "io/unv_format.hpp"
#include "io/unv_numbers.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::size_t kDescriptionWidth = 20;
constexpr std::int64_t kAbsoluteTemperature = 2;  // as most writers have it

std::string_view description(std::int64_t code) {
  switch (code) {
    case 1:
      return "Meter (newton)";
    case 2:
      return "Foot (pound f)";
    case 3:
      return "Meter (kilogram f)";
    case 4:
      return "Foot (poundal)";
    case 5:
      return "mm (milli newton)";
    case 6:
      return "cm (centi newton)";
    case 7:
      return "Inch (pound f)";
    case 8:
      return "mm (kilogram f)";
    case 10:
      return "mm (newton)";
    default:
      return "User defined";
  }
}

tl::unexpected<Fault> bad(const LineScanner& lines, const Line& line) {
  return tl::unexpected(Fault{ErrorCode::kBadNumber, line.begin,
                              "dataset 164 (units): cannot read '" + std::string(trimmed(lines.view(line))) + "'",
                              "export the file with units, or remove dataset 164"});
}

}  // namespace

tl::expected<Units, Fault> read_units(const LineScanner& lines, const Dataset& dataset) {
  if (dataset.body >= dataset.body_end)
    return tl::unexpected(Fault{ErrorCode::kMalformed, dataset.number_line, "dataset 164 (units) is empty", {}});
  Units units;
  Line line = lines.at(dataset.body, dataset.body_end);
  // The description touches the code, so the code is cut by column.
  const auto code = parse_integer(trimmed(lines.view(line).substr(0, kIntegerWidth)));
  if (!code) return bad(lines, line);
  units.code = *code;
  Reals reals;
  double* const factors[] = {&units.length, &units.force, &units.temperature, &units.temperature_offset};
  int have = 0;
  while (have < 4 && line.next < dataset.body_end) {
    line = lines.at(line.next, dataset.body_end);
    if (trimmed(lines.view(line)).empty()) continue;
    if (parse_reals(lines.view(line), kRealWidth, reals) == Cut::kNone || have + reals.count > 4)
      return bad(lines, line);
    for (int k = 0; k < reals.count; ++k) *factors[have++] = reals.value[static_cast<std::size_t>(k)];
  }
  if (have == 0) return bad(lines, line);
  if (units.length <= 0 || units.force <= 0)
    return tl::unexpected(Fault{ErrorCode::kBadNumber, dataset.body, "dataset 164 (units) has a factor of 0 or less",
                                "export the file with units, or remove dataset 164"});
  return units;
}

std::string units_text(const Units& units) {
  std::string text;
  append_integer(units.code, text);
  std::string name(description(units.code));
  name.resize(kDescriptionWidth, ' ');
  text += name;
  append_integer(kAbsoluteTemperature, text);
  text += '\n';
  for (const double factor : {units.length, units.force, units.temperature}) append_real(factor, 'D', text);
  text += '\n';
  append_real(units.temperature_offset, 'D', text);
  text += '\n';
  return text;
}

}  // namespace meshgraft::unv
