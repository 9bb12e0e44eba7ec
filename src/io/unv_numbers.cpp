#include "io/unv_numbers.hpp"

#include <charconv>
#include <cmath>
#include <string>

#include "io/line_scanner.hpp"

namespace meshgraft::unv {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Cuts a line into columns of `width` and calls f(field) with the blanks around removed. False
/// when columns cannot be what the writer meant: an empty one in the middle, a tab, a number that
/// straddles a border (touching neighbours are only right when the second fills its column).
template <class F>
bool cut_columns(std::string_view line, std::size_t width, F&& f) {
  for (std::size_t begin = 0; begin < line.size(); begin += width) {
    const std::string_view field = line.substr(begin, width);
    const std::string_view content = trimmed(field);
    if (content.empty() || content.find('\t') != std::string_view::npos) return false;
    if (begin > 0 && !is_blank(line[begin - 1]) && !is_blank(field.front()) && content.size() < width) return false;
    if (!f(content)) return false;
  }
  return true;
}

}  // namespace

std::optional<std::int64_t> parse_integer(std::string_view token) {
  if (token.starts_with('+') && token.size() > 1 && is_digit(token[1])) token.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc{} || end != token.data() + token.size()) return std::nullopt;
  return value;
}

std::optional<double> parse_real(std::string_view token) {
  std::string plain;  // as from_chars wants it; short enough to need no memory of its own is usual
  plain.reserve(32);
  std::size_t i = 0, digits = 0;
  if (i < token.size() && (token[i] == '-' || token[i] == '+')) {
    if (token[i] == '-') plain += '-';
    ++i;
  }
  for (; i < token.size() && is_digit(token[i]); ++i, ++digits) plain += token[i];
  if (digits == 0) plain += '0';
  if (i < token.size() && token[i] == '.') {
    plain += '.', ++i;
    const std::size_t before = digits;
    for (; i < token.size() && is_digit(token[i]); ++i, ++digits) plain += token[i];
    if (digits == before) plain += '0';
  }
  if (digits == 0) return std::nullopt;
  if (i < token.size()) {
    const bool letter = std::string_view("EeDdQq").find(token[i]) != std::string_view::npos;
    if (letter) ++i;
    const bool sign = i < token.size() && (token[i] == '-' || token[i] == '+');
    if (!letter && !sign) return std::nullopt;
    plain += 'e';
    if (sign) plain += token[i++];
    const std::size_t first = i;
    for (; i < token.size() && is_digit(token[i]); ++i) plain += token[i];
    if (i == first || i != token.size()) return std::nullopt;
  }
  double value = 0;
  const auto [end, error] = fast_float::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (end != plain.data() + plain.size() || !std::isfinite(value)) return std::nullopt;
  if (error != std::errc{} && error != std::errc::result_out_of_range) return std::nullopt;
  return value;
}

std::string_view number_fault(std::string_view token) {
  if (token.find('*') != std::string_view::npos) return "is an overflow of the program that wrote it";
  if (token.find(',') != std::string_view::npos) return "has a decimal comma";
  const std::size_t first = token.find_first_not_of("+- ");
  if (first != std::string_view::npos) {
    const char c = static_cast<char>(token[first] | 0x20);
    if (c == 'n' || c == 'i') return "is not a finite number";
  }
  const bool numeric = token.find_first_not_of("0123456789.+-eEdDqQ") == std::string_view::npos;
  return numeric && token.find_first_of("eEdDqQ") != std::string_view::npos ? "is not a number or too large"
                                                                            : "is not a number";
}

Cut parse_integers(std::string_view line, std::vector<std::int64_t>& values) {
  line = right_trimmed(line);
  const auto take = [&](std::string_view field) {
    const auto value = parse_integer(field);
    if (value) values.push_back(*value);
    return value.has_value();
  };
  values.clear();
  if (cut_columns(line, kIntegerWidth, take)) return values.empty() ? Cut::kNone : Cut::kColumns;
  values.clear();
  bool good = true;
  for_each_token(line, [&](std::string_view token) { return good = take(token); });
  return good && !values.empty() ? Cut::kTokens : Cut::kNone;
}

Cut parse_reals(std::string_view line, std::size_t width, Reals& reals) {
  line = right_trimmed(line);
  const auto take = [&](std::string_view field) {
    const auto value = parse_real(field);
    if (!value || reals.count == 3) {
      reals.bad = value ? std::string_view{} : field;
      return false;
    }
    reals.value[static_cast<std::size_t>(reals.count++)] = *value;
    return true;
  };
  reals = {};
  if (cut_columns(line, width, take)) return reals.count > 0 ? Cut::kColumns : Cut::kNone;
  reals = {};
  bool good = true;
  for_each_token(line, [&](std::string_view token) { return good = take(token); });
  return good && reals.count > 0 ? Cut::kTokens : Cut::kNone;
}

}  // namespace meshgraft::unv
