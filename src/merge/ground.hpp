// What merging, cutting and filling start from alike.
#pragma once

#include "merge/accounts.hpp"
#include "merge/group_table.hpp"
#include "meshgraft/merge.hpp"

namespace meshgraft {

/// One table of the groups of all inputs. The result gets the version, counts and warnings of the inputs, and the
/// groups.
struct Ground {
  Ground(Inputs inputs, Merged& merged);
  Ground(const Ground&) = delete;  // `translated` refers to `table`
  Ground& operator=(const Ground&) = delete;

  GroupTable table;
  SetTranslation translated;
  Accounts accounts;
};

}  // namespace meshgraft
