// A new universal file from a model that has no text yet.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "meshgraft/model.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft::unv {

/// Receives the next pieces of the text, which live until it returns.
using TextSink = std::function<Result<void>(std::span<const std::string_view>)>;

/// Datasets 164 (if units are known), 2420 (the global system), 2411, 2412, 2467. Formatted in
/// parallel; the text does not depend on the number of threads. Error kLabelOverflow.
[[nodiscard]] Result<void> write_new(const Model& model, const TextSink& sink);
[[nodiscard]] Result<std::string> new_text(const Model& model);

}  // namespace meshgraft::unv
