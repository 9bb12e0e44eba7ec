// Finds the datasets of a universal file: the delimiter state machine (unv.md 6, rules 2 to 4).
#pragma once

#include <vector>

#include "io/unv_document.hpp"

namespace meshgraft::unv {

/// Fills document.delimiter and document.datasets in one pass over the text. Repairs (learned,
/// missing or shared delimiters, text outside datasets) become warnings.
///
/// Errors: kEmptyFile, kUnknownFormat (no dataset; names the format it looks like, if it can),
/// kTruncated and kMalformed for binary datasets.
[[nodiscard]] tl::expected<void, Fault> find_datasets(Document& document, std::vector<Warning>& warnings);

/// The format that a text which is no universal file looks like, or an empty text.
[[nodiscard]] std::string_view likely_format(std::string_view text);

}  // namespace meshgraft::unv
