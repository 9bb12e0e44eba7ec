#include "io/unv_document.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace meshgraft::unv {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 16;  // bytes between two known line numbers
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr char kControlZ = 0x1A;

}  // namespace

DatasetKind kind_of(std::int64_t number) {
  switch (number) {
    case 15:
    case 781:
    case 2411:
      return DatasetKind::kNodes;
    case 71:
    case 780:
    case 2412:
      return DatasetKind::kElements;
    case 752:
    case 2417:
    case 2429:
    case 2430:
    case 2432:
    case 2435:
    case 2452:
    case 2467:
    case 2477:
      return DatasetKind::kGroups;
    default:
      return DatasetKind::kOther;
  }
}

GroupLayout group_layout_of(std::int64_t number) {
  switch (number) {
    case 752:
      return {6, 2};
    case 2417:
      return {7, 2};
    case 2429:
    case 2430:
    case 2432:
      return {8, 2};
    default:
      return {8, 4};
  }
}

Document::Document(MappedFile file, std::string path)
    : file_(std::make_unique<MappedFile>(std::move(file))), text_(file_->text()), path_(std::move(path)) {
  find_line_ends();
}

Document::Document(std::string text, std::string path)
    : owned_(std::move(text)), text_(owned_), path_(std::move(path)) {
  find_line_ends();
}

void Document::find_line_ends() {
  std::size_t last = text_.size();
  while (last > 0 && text_[last - 1] == '\0') --last;
  if (last > 0 && text_[last - 1] == kControlZ) --last;
  lines.text = text_.substr(0, last);
  first = lines.text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;

  const std::size_t feed = lines.text.find('\n');
  if (feed != std::string_view::npos) {
    line_end = feed > 0 && lines.text[feed - 1] == '\r' ? "\r\n" : "\n";
  } else if (lines.text.find('\r') != std::string_view::npos) {
    line_end = "\r", lines.terminator = '\r';
  }
}

std::uint64_t Document::line_of(std::uint64_t offset) const {
  offset = std::min<std::uint64_t>(offset, text_.size());
  const std::size_t block = offset / kBlock;
  const std::lock_guard lock(counting_);
  const std::size_t known = lines_before_.size();
  if (block >= known) {
    lines_before_.resize(block + 1);
    // Isolated: a task taken up meanwhile could ask for a line, and wait here for itself.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::max<std::size_t>(known, 1), block + 1, [&](std::size_t k) {
        lines_before_[k] = count_of(lines.terminator, text_.substr((k - 1) * kBlock, kBlock));
      });
    });
    for (std::size_t k = std::max<std::size_t>(known, 1); k <= block; ++k) lines_before_[k] += lines_before_[k - 1];
  }
  return 1 + lines_before_[block] + count_of(lines.terminator, text_.substr(block * kBlock, offset - block * kBlock));
}

Error Document::error(const Fault& fault) const {
  return {fault.code, fault.what, fault.hint, {path_, line_of(fault.offset)}};
}

Warning Document::warning(std::string name, std::string what, std::size_t offset) const {
  return {std::move(name), std::move(what), {path_, line_of(offset)}};
}

bool Document::is_delimiter(const Line& line) const {
  const std::string_view content = right_trimmed(lines.view(line));
  return delimiter.empty() ? content == kUsualDelimiter : content == delimiter;
}

void Document::forget_datasets() {
  passed_over = false;
  delimiter.clear();
  datasets.clear(), groups.clear(), double_nodes.clear(), double_elements.clear();
}

std::size_t Document::dataset_at(std::size_t offset) const {
  const auto after = std::ranges::upper_bound(datasets, offset, {}, &Dataset::open);
  return static_cast<std::size_t>(after - datasets.begin()) - 1;
}

std::size_t Document::record_end(const std::vector<std::uint64_t>& places, std::size_t i,
                                 const std::vector<DuplicateRecord>& doubles) const {
  const std::size_t begin = places[i];
  std::size_t end = datasets[dataset_at(begin)].body_end;
  if (i + 1 < places.size()) end = std::min<std::size_t>(end, places[i + 1]);
  const auto other = std::ranges::upper_bound(doubles, begin, {}, &DuplicateRecord::begin);
  if (other != doubles.end()) end = std::min(end, other->begin);
  return end;
}

}  // namespace meshgraft::unv
