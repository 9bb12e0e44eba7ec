// Finds the datasets of a universal file: the delimiter state machine (unv.md 6, rules 2 to 4).
#pragma once

#include <cstdint>
#include <vector>

#include "io/unv_document.hpp"

namespace meshgraft::unv {

/// What to do with records of nodes and elements that seem to be alike, see end_of_like_records.
enum class LikeRecords : std::uint8_t { kPassedOver, kLookedAt };

/// Fills document.delimiter, datasets and passed_over in one pass over the text. Repairs (learned,
/// missing or shared delimiters, text outside datasets) become warnings.
///
/// Errors: kEmptyFile, kUnknownFormat (no dataset; names the format it looks like, if it can),
/// kTruncated and kMalformed for binary datasets.
[[nodiscard]] tl::expected<void, Fault> find_datasets(Document& document, LikeRecords like_records,
                                                      std::vector<Warning>& warnings);

/// The format that a text which is no universal file looks like, or an empty text.
[[nodiscard]] std::string_view likely_format(std::string_view text);

}  // namespace meshgraft::unv
