// The bytes of a file, mapped read-only.
#pragma once

#include <string>
#include <string_view>

#include "meshgraft/result.hpp"

namespace meshgraft {

/// Regular files are mapped, but for those of nothing but a hole, which are empty; anything else that can be read (a
/// pipe) is read into memory. Devices are not read.
class MappedFile {
 public:
  /// Error kCannotRead with the reason of the system: missing, a directory or device, no permission, no
  /// memory.
  [[nodiscard]] static Result<MappedFile> open(const std::string& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&&) = delete;
  ~MappedFile();

  [[nodiscard]] std::string_view text() const { return map_ != nullptr ? std::string_view(map_, size_) : read_; }

 private:
  MappedFile() = default;

  const char* map_ = nullptr;
  std::size_t size_ = 0;
  std::string read_;
};

}  // namespace meshgraft
