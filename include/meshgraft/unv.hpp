// I-DEAS Universal files (.unv), lossless: what is not understood or not touched comes back byte
// for byte.
#pragma once

#include <span>
#include <string>

#include "meshgraft/merge.hpp"
#include "meshgraft/model.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

struct ReadOptions {
  unsigned threads = 0;   // 0 = all cores; the result does not depend on it
  bool unclosed = false;  // take a file that ends without its last delimiter, with a warning: it may lack its end
};

/// Reads a universal file. The file stays mapped as long as Model::source lives.
///
/// Errors: kCannotRead, kEmptyFile, kUnknownFormat, kMalformed, kTruncated, kBadNumber,
/// kUnknownNode, kDuplicateLabel, kSeveralModels, each with the line. Repairs are in
/// Model::warnings.
[[nodiscard]] Result<Model> read_unv(const std::string& path, const ReadOptions& options = {});

/// The same from memory; `name` stands for the path in messages.
[[nodiscard]] Result<Model> read_unv_text(std::string text, const std::string& name, const ReadOptions& options = {});

/// Writes a model. With a source: the bytes that were read. Without: a new file (dataset 164 if
/// units are known, 2420, 2411, 2412, 2467). The file appears whole or not at all.
[[nodiscard]] Result<void> write_unv(const Model& model, const std::string& path);

/// Writes base + graft: the base's text with the changed records replaced, new records at the end
/// of the last node, element and group dataset, entities of the parts after those of the base.
/// `report` receives bytes untouched and the fate of datasets. Datasets of parts that cannot go
/// into the file are written to `path` + ".carry"; one of an earlier run goes if there are none.
/// Error kCannotWrite also where that name is taken by another file.
[[nodiscard]] Result<void> write_unv(const Model& base, std::span<const Model> parts, const Merged& merged,
                                     const std::string& path, Report& report);

/// The text that write_unv would put into the file.
[[nodiscard]] Result<std::string> unv_text(const Model& model);
[[nodiscard]] Result<std::string> unv_text(const Model& base, std::span<const Model> parts, const Merged& merged,
                                           Report& report);

}  // namespace meshgraft
