// The account of every group: members, area and length before and after, and by which rule.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "merge/dropped.hpp"
#include "merge/inputs.hpp"
#include "meshgraft/graft.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

struct LedgerOptions {
  /// Change of area or length of a group that the remeshing of curved surfaces may bring about.
  double max_change = 0.02;
};

struct Ledger {
  std::vector<GroupEntry> groups;  // in the order of Graft::groups
  std::vector<Error> broken;       // kPromiseBroken: groups that became empty or changed in size
  std::vector<Warning> warnings;   // groups that became empty because all their members were dropped
};

/// What a set of entities amounts to.
struct GroupSum {
  enum Kind : std::size_t { kNodes, kFaces, kLines, kOthers, kKinds };
  std::array<std::int64_t, kKinds> members{};
  double area = 0, length = 0;

  void add(const GroupSum& other, int sign = 1) {
    for (std::size_t k = 0; k < kKinds; ++k) members[k] += sign * other.members[k];
    area += sign * other.area, length += sign * other.length;
  }
  [[nodiscard]] std::uint64_t count() const {
    std::int64_t n = 0;
    for (const std::int64_t m : members) n += m;
    return static_cast<std::uint64_t>(n);
  }
};

/// All groups of the inputs, [input][group of it]. Cost: one pass over the elements and nodes that are in groups,
/// independent of how many groups overlap.
[[nodiscard]] std::vector<std::vector<GroupSum>> group_sums(Inputs inputs);

/// Adds the change up over the graft alone; what was dropped is expected to be missing.
///
///   before    of group_sums
[[nodiscard]] Ledger ledger_of(Inputs inputs, std::span<const std::vector<GroupSum>> before, const Graft& graft,
                               const Dropped& dropped = {}, const LedgerOptions& options = {});
/// The same with the sums of the inputs made here.
[[nodiscard]] Ledger ledger_of(Inputs inputs, const Graft& graft, const Dropped& dropped = {},
                               const LedgerOptions& options = {});

}  // namespace meshgraft
