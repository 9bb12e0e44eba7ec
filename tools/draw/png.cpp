#include "png.hpp"

#include <zlib.h>

#include <stdexcept>

namespace meshgraft::draw {
namespace {

void append_big_endian(std::string& out, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) out.push_back(static_cast<char>(value >> shift & 0xFF));
}

const Bytef* bytes(const std::string& s) { return reinterpret_cast<const Bytef*>(s.data()); }

void append_chunk(std::string& out, const std::string& kind, const std::string& data) {
  append_big_endian(out, static_cast<std::uint32_t>(data.size()));
  const std::string checked = kind + data;
  out += checked;
  append_big_endian(out, static_cast<std::uint32_t>(crc32(0, bytes(checked), static_cast<uInt>(checked.size()))));
}

std::string deflated(const std::string& raw) {
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, bytes(raw), static_cast<uLong>(raw.size()),
                Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib could not compress the picture");
  out.resize(size);
  return out;
}

}  // namespace

std::string png(const Image& image) {
  constexpr char kNoFilter = 0;
  std::string raw;
  raw.reserve(image.height * (1 + 3 * std::size_t{image.width}));
  for (std::uint32_t y = 0; y < image.height; ++y) {
    raw.push_back(kNoFilter);
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const Colour& c = image.pixels[std::size_t{y} * image.width + x];
      raw.push_back(static_cast<char>(c.red));
      raw.push_back(static_cast<char>(c.green));
      raw.push_back(static_cast<char>(c.blue));
    }
  }
  std::string header;
  append_big_endian(header, image.width);
  append_big_endian(header, image.height);
  header += std::string{'\x08', '\x02', '\0', '\0', '\0'};  // 8 bits, true colour, no interlacing

  std::string out = "\x89PNG\r\n\x1a\n";
  append_chunk(out, "IHDR", header);
  append_chunk(out, "IDAT", deflated(raw));
  append_chunk(out, "IEND", "");
  return out;
}

}  // namespace meshgraft::draw
