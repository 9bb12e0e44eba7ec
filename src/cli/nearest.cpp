#include "cli/nearest.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace meshgraft::cli {
namespace {

constexpr std::size_t kLettersPerEdit = 3;

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows of the table of distances between the beginnings of a and b: two back, last, current.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest(std::string_view typed, std::span<const std::string> names) {
  std::optional<std::string> best;
  std::size_t least = std::max<std::size_t>(1, typed.size() / kLettersPerEdit) + 1;
  for (const std::string& name : names) {
    const bool begins = typed.size() >= 2 && name.starts_with(typed);
    const std::size_t d = begins ? 0 : edit_distance(typed, name);
    if (d >= least || d >= name.size()) continue;
    least = d;
    best = name;
  }
  return best;
}

}  // namespace meshgraft::cli
