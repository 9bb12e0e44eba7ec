// A file that appears whole or not at all.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "meshgraft/result.hpp"

namespace meshgraft {

/// The file that writing to `path` makes or replaces: symbolic links are followed and stay, also
/// where there is no file at their end yet. Of what is not a regular file (a pipe, a device), `path` itself.
[[nodiscard]] std::string without_links(const std::string& path);

/// Written beside its final place, then renamed; on any failure nothing is left behind and what was there
/// before stays. Something that is not a regular file (/dev/null, a pipe) is written directly.
///
/// Only where it takes the place of another file is it flushed to the disk first: if the power fails, the
/// one or the other is there. A new file has nothing to lose, and can be made again; flushing would take
/// several times as long as writing it.
class AtomicOutput {
 public:
  /// Error kCannotWrite, with the reason of the system.
  [[nodiscard]] static Result<AtomicOutput> create(const std::string& path);

  AtomicOutput(AtomicOutput&& other) noexcept;
  AtomicOutput& operator=(AtomicOutput&&) = delete;
  ~AtomicOutput();

  [[nodiscard]] Result<void> write(std::span<const std::string_view> pieces);
  [[nodiscard]] Result<void> write(std::string_view text) { return write({&text, 1}); }
  /// Makes the file appear. Without it, nothing does.
  [[nodiscard]] Result<void> commit();

 private:
  AtomicOutput() = default;
  /// Asks for room on the disk at once, which is faster than piece by piece.
  void reserve(std::span<const std::string_view> pieces) const;
  [[nodiscard]] Failure failed(const char* what, int reason) const;

  std::string path_;       // as given, for messages
  std::string target_;     // links resolved
  std::string temporary_;  // empty when written directly
  bool replaces_ = false;  // there was a file before
  int fd_ = -1;
};

}  // namespace meshgraft
