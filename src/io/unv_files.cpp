// The writing half of meshgraft/unv.hpp.
#include <cstdio>

#include "io/atomic_output.hpp"
#include "io/unv_document.hpp"
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

}  // namespace meshgraft
