#include "io/digest.hpp"

#include <openssl/evp.h>

#include <array>
#include <memory>

#include "core/source.hpp"
#include "core/summary.hpp"

namespace meshgraft {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) return {};
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (unsigned k = 0; k < size; ++k) text += kHex[digest[k] >> 4], text += kHex[digest[k] & 15];
  return text;
}

InputSummary input_summary(const Model& model) {
  InputSummary summary = counts_of(model);
  if (model.source) summary.sha256 = sha256(model.source->text()), summary.bytes = model.source->text().size();
  return summary;
}

}  // namespace meshgraft
