// The writing half of meshgraft/unv.hpp.
#include <unistd.h>

#include "io/atomic_output.hpp"
#include "io/side_file.hpp"
#include "io/unv_document.hpp"
#include "io/unv_splice.hpp"
#include "io/unv_writer.hpp"
#include "meshgraft/unv.hpp"

namespace meshgraft {
namespace {

/// The text that the model was read from, if that was a universal file.
const unv::Document* document_of(const Model& model) { return dynamic_cast<const unv::Document*>(model.source.get()); }

}  // namespace

Result<void> write_unv(const Model& model, const std::string& path) {
  auto output = AtomicOutput::create(path);
  if (!output) return Failure(output.error());
  const unv::Document* document = document_of(model);
  const auto written = document != nullptr ? output->write(document->text())
                                           : unv::write_new(model, [&](auto pieces) { return output->write(pieces); });
  if (!written) return written;
  return output->commit();
}

Result<std::string> unv_text(const Model& model) {
  if (const unv::Document* document = document_of(model)) return std::string(document->text());
  return unv::new_text(model);
}

Result<void> write_unv(const Model& base, std::span<const Model> parts, const Merged& merged, const std::string& path,
                       Report& report) {
  const auto spliced = unv::SplicedText::make(base, parts, merged, report);
  if (!spliced) return Failure(spliced.error());
  const std::string beside = side_path(path);
  const bool taken = is_side_path_taken(path);
  if (taken && !spliced->side_file().empty())
    return failure(ErrorCode::kCannotWrite, "is there and no side file of meshgraft, so that it is not replaced",
                   "move it away, or choose another output", {beside, 0});
  auto output = AtomicOutput::create(path);
  if (!output) return Failure(output.error());
  if (auto done = output->write(spliced->pieces); !done) return done;

  if (spliced->side_file().empty()) {
    if (auto done = output->commit(); !done) return done;
    if (!taken) ::unlink(beside.c_str());  // of an earlier run: it would not belong to the new output
    return {};
  }
  auto side = AtomicOutput::create(beside);
  if (!side) return Failure(side.error());
  if (auto done = side->write(spliced->side_file()); !done) return done;
  if (auto done = side->commit(); !done) return done;
  if (auto done = output->commit(); !done) {
    ::unlink(beside.c_str());
    return done;
  }
  return {};
}

Result<std::string> unv_text(const Model& base, std::span<const Model> parts, const Merged& merged, Report& report) {
  const auto spliced = unv::SplicedText::make(base, parts, merged, report);
  if (!spliced) return Failure(spliced.error());
  std::string text;
  for (const std::string_view piece : spliced->pieces) text += piece;
  return text;
}

}  // namespace meshgraft
