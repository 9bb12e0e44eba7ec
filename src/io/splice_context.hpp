// What the parts of the splice share.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/splice_labels.hpp"
#include "io/splice_text.hpp"
#include "io/unv_document.hpp"
#include "meshgraft/merge.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft::unv {

/// Inputs, the difference, and the edits of the base's text that write it.
class Splice {
 public:
  Splice(std::vector<const Model*> models_, std::vector<const Document*> documents_, const Merged& merged,
         Report& report_)
      : models(std::move(models_)),
        documents(std::move(documents_)),
        graft(merged.graft),
        labels(merged.labels),
        report(report_),
        names(models, graft, labels) {}

  std::vector<const Model*> models;  // 0: the base
  std::vector<const Document*> documents;
  const Graft& graft;
  const Labels& labels;
  Report& report;
  OutputLabels names;
  TextEdits edits;
  std::string side_file;  // datasets of parts that cannot go into the output

  [[nodiscard]] const Document& base() const { return *documents.front(); }
  [[nodiscard]] std::string_view line_end() const { return base().line_end; }
  [[nodiscard]] std::uint32_t n_inputs() const { return static_cast<std::uint32_t>(models.size()); }

  /// Last dataset of a kind in the base, null if there is none.
  [[nodiscard]] const Dataset* last_dataset(DatasetKind kind) const;
  /// Opening delimiter and number line, and a closing delimiter, as the base has them.
  void open_dataset(std::int64_t number, std::string& text) const;
  void close_dataset(std::string& text) const;
  /// Puts records at the end of a dataset of the base.
  void insert_records(const Dataset& dataset, TextPieces records);
  /// Puts a new dataset behind `after`, or at the end of the file if null.
  void insert_dataset(const Dataset* after, std::int64_t number, TextPieces records);
  /// Puts whole datasets at the end of the file.
  void append_text(TextPieces datasets);
  /// What has changes ends with a delimiter, even if the base does not. To be called last.
  void close_last_dataset();

 private:
  void insert_datasets(const Dataset* after, TextPieces datasets);

  std::map<std::size_t, bool> closed_;  // datasets without closing delimiter that got one, by offset
};

void splice_nodes(Splice& splice);
void splice_elements(Splice& splice);
void splice_groups(Splice& splice);
/// Datasets that are not understood: entries of the report, copies, side file.
void splice_datasets(Splice& splice);

/// Cuts the records of removed entities of the base, with further records of the same label.
template <class Id>
void cut_records(Splice& splice, const std::vector<std::uint64_t>& places, const std::vector<Id>& removed,
                 const std::vector<DuplicateRecord>& doubles) {
  const Document& d = splice.base();
  for (const Id id : removed) splice.edits.cut(places[id.value], d.record_end(places, id.value, doubles));
  for (const DuplicateRecord& r : doubles) {
    if (!std::ranges::binary_search(removed, Id(std::size_t{r.kept}))) continue;
    std::size_t end = d.record_end({r.begin}, 0, doubles);
    const auto next = std::ranges::upper_bound(places, r.begin);
    if (next != places.end()) end = std::min<std::size_t>(end, *next);
    splice.edits.cut(r.begin, end);
  }
}

/// Calls f(i) for each position below n that is not in `removed` (ascending).
template <class Id, class F>
void for_each_kept(std::size_t n, const std::vector<Id>& removed, F&& f) {
  auto next = removed.begin();
  for (std::size_t i = 0; i < n; ++i) {
    if (next != removed.end() && next->value == i)
      ++next;
    else
      f(i);
  }
}

}  // namespace meshgraft::unv
