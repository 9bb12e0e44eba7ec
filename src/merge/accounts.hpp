// What the last steps of an operation need of the inputs alone.
#pragma once

#include <tbb/task_group.h>

#include <vector>

#include "merge/inputs.hpp"
#include "merge/ledger.hpp"
#include "meshgraft/graft.hpp"

namespace meshgraft {

/// Sums of groups, and labels, made beside all other work: they cost a pass over the inputs, however small the zone.
class Accounts {
 public:
  explicit Accounts(Inputs inputs);
  ~Accounts() noexcept;  // said, as that of a task group may throw
  Accounts(const Accounts&) = delete;
  Accounts& operator=(const Accounts&) = delete;

  /// As group_sums gives them.
  [[nodiscard]] const std::vector<std::vector<GroupSum>>& sums();
  /// As labels_of gives them.
  [[nodiscard]] const Labels& labels();

 private:
  tbb::task_group making_;
  std::vector<std::vector<GroupSum>> sums_;
  Labels labels_;
};

}  // namespace meshgraft
