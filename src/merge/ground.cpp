#include "merge/ground.hpp"

#include "core/summary.hpp"

namespace meshgraft {

Ground::Ground(Inputs inputs, Merged& merged)
    : table(group_table(inputs)), translated(inputs, table, merged.graft.group_sets), accounts(inputs) {
  Report& report = merged.report;
  report.version = MESHGRAFT_VERSION;
  for (const Model* model : inputs) {
    report.inputs.push_back(counts_of(*model));
    report.warnings.insert(report.warnings.end(), model->warnings.begin(), model->warnings.end());
  }
  report.warnings.insert(report.warnings.end(), table.warnings.begin(), table.warnings.end());
  merged.graft.groups = table.groups;
}

}  // namespace meshgraft
