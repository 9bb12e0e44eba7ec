#include "io/unv_splice.hpp"

#include "io/splice_context.hpp"
#include "io/unv_format.hpp"
#include "io/unv_writer.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft::unv {

SplicedText::SplicedText() = default;
SplicedText::SplicedText(SplicedText&&) noexcept = default;
SplicedText::~SplicedText() = default;

std::string_view SplicedText::side_file() const { return splice_->side_file; }

Result<SplicedText> SplicedText::make(const Model& base, std::span<const Model> parts, const Merged& merged,
                                      Report& report) {
  SplicedText spliced;
  std::vector<const Model*> models{&base};
  for (const Model& part : parts) models.push_back(&part);
  std::vector<const Document*> documents;
  for (const Model*& model : models) {
    const auto* document = dynamic_cast<const Document*>(model->source.get());
    if (document == nullptr) {
      auto text = new_text(*model);
      if (!text) return Failure(text.error());
      auto read = read_unv_text(std::move(*text), model->path);
      if (!read) return Failure(read.error());
      model = &spliced.made_.emplace_back(std::move(*read));
      document = dynamic_cast<const Document*>(model->source.get());
    }
    documents.push_back(document);
  }
  spliced.splice_ = std::make_unique<Splice>(std::move(models), std::move(documents), merged, report);
  Splice& s = *spliced.splice_;
  if (const std::int64_t largest = s.names.largest_new(); largest > kLargestLabel)
    return failure(ErrorCode::kLabelOverflow,
                   "the merged model would need label " + std::to_string(largest) +
                       ", which does not fit into the ten columns of a universal file",
                   "renumber the input with the largest labels from 1", {base.path, 0});
  splice_nodes(s);
  splice_elements(s);
  splice_groups(s);
  splice_datasets(s);
  if (!s.edits.empty()) s.close_last_dataset();
  auto output = s.edits.apply(s.base().text());
  spliced.pieces = std::move(output.pieces);
  report.untouched.bytes = output.untouched;
  return spliced;
}

}  // namespace meshgraft::unv
