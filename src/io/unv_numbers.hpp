// Numbers of universal files: Fortran columns first, blank-separated tokens second.
#pragma once

#include <fast_float/fast_float.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

namespace meshgraft::unv {

inline constexpr std::size_t kIntegerWidth = 10;    // I10
inline constexpr std::size_t kRealWidth = 25;       // 1P3D25.16
inline constexpr std::size_t kShortRealWidth = 13;  // 1P3E13.5, dataset 15

/// An integer with optional sign and nothing around it; 64 bits.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view token);

/// A finite Fortran real with nothing around it: exponent letters E, D, Q in either case or none
/// before a signed exponent, no digit needed on one side of the point. Never depends on a locale.
[[nodiscard]] std::optional<double> parse_real(std::string_view token);

/// Why `token` is not a number, for a message: "'1,5' has a decimal comma".
[[nodiscard]] std::string_view number_fault(std::string_view token);

/// How the fields of a line were cut.
enum class Cut : std::uint8_t { kColumns, kTokens, kNone };

/// All integers of a line; kNone (and values unspecified) if it holds anything else. A number that
/// straddles a column border, an empty column or a tab make it a line of tokens.
Cut parse_integers(std::string_view line, std::vector<std::int64_t>& values);

/// All reals of a line, at most 3; on kNone `bad` is the token at fault (empty: too many or none).
struct Reals {
  std::array<double, 3> value{};
  int count = 0;
  std::string_view bad;
};
Cut parse_reals(std::string_view line, std::size_t width, Reals& reals);

/// Whether `n` fields of ten columns hold the same characters.
inline bool same_fields(const char* a, const char* b, std::size_t n = 1) {
  for (; n > 0; --n, a += kIntegerWidth, b += kIntegerWidth) {
    std::uint64_t x = 0, y = 0;
    std::uint16_t u = 0, v = 0;
    std::memcpy(&x, a, sizeof x), std::memcpy(&y, b, sizeof y);
    std::memcpy(&u, a + sizeof x, sizeof u), std::memcpy(&v, b + sizeof y, sizeof v);
    if (x != y || u != v) return false;
  }
  return true;
}

/// Fast path: a field of ten columns holding at most eight digits, right-justified.
inline bool fast_integer(const char* field, std::int64_t& value) {
  if constexpr (std::endian::native != std::endian::little) return false;
  if (field[0] != ' ' || field[1] != ' ') return false;
  std::uint64_t x = 0;
  std::memcpy(&x, field + 2, sizeof x);
  // Digits have bit 4 set and blanks have not; blanks become zeros if they are all in front.
  const std::uint64_t blank = ((~x >> 4) & 0x0101010101010101ull) * 0xFF;
  if ((x & blank) != (0x2020202020202020ull & blank) || (blank & (blank + 1)) != 0 || ~blank == 0) return false;
  x |= blank & 0x1010101010101010ull;
  if (!fast_float::is_made_of_eight_digits_fast(x)) return false;
  value = fast_float::parse_eight_digits_unrolled(x);
  return true;
}

/// Fast path: a field of 25 columns as Fortran writes it, `  -1.2345678901234567D+00`.
inline bool fast_real(const char* field, double& value) {
  if constexpr (std::endian::native != std::endian::little) return false;
  const auto digit = [field](int k) { return static_cast<unsigned>(field[k] - '0'); };
  if (field[0] != ' ' || field[1] != ' ' || (field[2] != ' ' && field[2] != '-') || field[4] != '.') return false;
  if (digit(3) > 9 || digit(23) > 9 || digit(24) > 9) return false;
  const char letter = static_cast<char>(field[21] & ~0x20);
  if ((letter != 'E' && letter != 'D') || (field[22] != '+' && field[22] != '-')) return false;
  std::uint64_t high = 0, low = 0;
  std::memcpy(&high, field + 5, sizeof high), std::memcpy(&low, field + 13, sizeof low);
  if (!fast_float::is_made_of_eight_digits_fast(high) || !fast_float::is_made_of_eight_digits_fast(low)) return false;
  constexpr std::uint64_t kTenTo8 = 100'000'000;
  constexpr int kFraction = 16, kMantissaBits = 52;
  const std::uint64_t mantissa = digit(3) * kTenTo8 * kTenTo8 +
                                 fast_float::parse_eight_digits_unrolled(high) * kTenTo8 +
                                 fast_float::parse_eight_digits_unrolled(low);
  const int exponent = static_cast<int>(digit(23) * 10 + digit(24));
  const auto scaled = fast_float::compute_float<fast_float::binary_format<double>>(
      (field[22] == '-' ? -exponent : exponent) - kFraction, mantissa);
  if (scaled.power2 < 0) return false;  // the rare case that needs more digits
  value = std::bit_cast<double>(scaled.mantissa | (static_cast<std::uint64_t>(scaled.power2) << kMantissaBits) |
                                (field[2] == '-' ? std::uint64_t{1} << 63 : 0));
  return true;
}

}  // namespace meshgraft::unv
