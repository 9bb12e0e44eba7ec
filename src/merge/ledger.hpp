// The account of every group: members, area and length before and after, and by which rule.
#pragma once

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

/// Adds up all groups; what was dropped is expected to be missing. Cost: one pass over the elements and nodes of each
/// input that are in groups, independent of how many groups overlap; the change is added up over the graft alone.
[[nodiscard]] Ledger ledger_of(Inputs inputs, const Graft& graft, const Dropped& dropped = {},
                               const LedgerOptions& options = {});

}  // namespace meshgraft
