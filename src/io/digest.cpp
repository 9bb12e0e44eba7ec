#include "io/digest.hpp"

#include <openssl/evp.h>

#include <array>
#include <memory>

#include "core/source.hpp"

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

const char* name(Shape shape) {
  switch (shape) {
    case Shape::kPoint:
      return "point";
    case Shape::kLine:
      return "line";
    case Shape::kLine3:
      return "line3";
    case Shape::kTriangle:
      return "triangle";
    case Shape::kTriangle6:
      return "triangle6";
    case Shape::kQuad:
      return "quad";
    case Shape::kQuad8:
      return "quad8";
    case Shape::kSolid:
      return "solid";
    case Shape::kOther:
      break;
  }
  return "other";
}

InputSummary input_summary(const Model& model) {
  InputSummary summary;
  summary.path = model.path;
  if (model.source) summary.sha256 = sha256(model.source->text()), summary.bytes = model.source->text().size();
  summary.nodes = model.n_nodes(), summary.elements = model.n_elements(), summary.groups = model.groups.size();
  std::vector<std::uint64_t> by_attributes(model.attributes.size());
  for (const AttributesId a : model.element_attributes) ++by_attributes[a.value];
  for (std::size_t k = 0; k < by_attributes.size(); ++k)
    if (by_attributes[k] > 0) summary.elements_by_kind[name(model.attributes[k].shape)] += by_attributes[k];
  return summary;
}

}  // namespace meshgraft
