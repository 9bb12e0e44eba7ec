#include "io/atomic_output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace meshgraft {
namespace {

/// Creates a file of a new name beside `target`; the user's mask decides on permissions.
int create_beside(const std::string& target, std::string& name) {
  constexpr int kTries = 100;
  for (int k = 0; k < kTries; ++k) {
    name = target + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(k);
    const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0 || errno != EEXIST) return fd;
  }
  return -1;
}

/// Flushes the entry of a directory; failure is harmless, the content is on the disk already.
void sync_directory(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int fd = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  (void)::fsync(fd);
  ::close(fd);
}

}  // namespace

std::string without_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the system follows
  std::filesystem::path at = path;
  std::error_code error;
  const auto status = std::filesystem::status(at, error);
  // What a link like /dev/stdout names, if it is a pipe, has no name in any folder.
  if (exists(status) && !is_regular_file(status)) return path;
  for (int k = 0; k < kMostLinks && std::filesystem::is_symlink(at, error); ++k)
    at = at.parent_path() / std::filesystem::read_symlink(at, error);  // an absolute one replaces it
  return at.string();
}

Failure AtomicOutput::failed(const char* what, int reason) const {
  return failure(ErrorCode::kCannotWrite, std::string(what) + ": " + std::generic_category().message(reason),
                 "check the folder, its permissions and the free space", {path_, 0});
}

Result<AtomicOutput> AtomicOutput::create(const std::string& path) {
  AtomicOutput output;
  output.path_ = path, output.target_ = without_links(path);

  struct stat status {};
  const bool exists = ::stat(output.target_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) return output.failed("cannot write", errno);
  if (exists && S_ISDIR(status.st_mode)) return output.failed("cannot write", EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    output.fd_ = ::open(output.target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (output.fd_ < 0) return output.failed("cannot write", errno);
    return output;
  }
  std::string name;
  output.fd_ = create_beside(output.target_, name);
  if (output.fd_ < 0) return output.failed("cannot create", errno);
  output.temporary_ = name, output.replaces_ = exists;
  if (exists && ::fchmod(output.fd_, status.st_mode & 0777) != 0) return output.failed("cannot create", errno);
  return output;
}

AtomicOutput::AtomicOutput(AtomicOutput&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      replaces_(other.replaces_),
      fd_(std::exchange(other.fd_, -1)) {}

AtomicOutput::~AtomicOutput() {
  if (fd_ >= 0) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicOutput::reserve(std::span<const std::string_view> pieces) const {
  constexpr std::size_t kWorthwhile = std::size_t{1} << 20;
  std::size_t bytes = 0;
  for (const std::string_view piece : pieces) bytes += piece.size();
  const off_t at = temporary_.empty() || bytes < kWorthwhile ? -1 : ::lseek(fd_, 0, SEEK_CUR);
  // Whether there is room will be told by writing; not all file systems know how to reserve it.
  if (at >= 0) (void)::fallocate(fd_, FALLOC_FL_KEEP_SIZE, at, static_cast<off_t>(bytes));
}

Result<void> AtomicOutput::write(std::span<const std::string_view> pieces) {
  constexpr std::size_t kBatch = 256;  // below IOV_MAX everywhere
  // Bytes at once. For larger writes the system looks for larger pieces of memory, which it was longer ago that
  // anything used; up to ten times slower was measured.
  constexpr std::size_t kLargest = std::size_t{1} << 17;
  reserve(pieces);
  std::size_t next = 0, done = 0;  // bytes of pieces[next] already written
  while (next < pieces.size()) {
    std::array<iovec, kBatch> batch;
    std::size_t n = 0, bytes = 0;
    for (std::size_t k = next; k < pieces.size() && n < kBatch && bytes < kLargest; ++k) {
      const std::string_view rest = pieces[k].substr(k == next ? done : 0).substr(0, kLargest - bytes);
      batch[n++] = {const_cast<char*>(rest.data()), rest.size()};
      bytes += rest.size();
    }
    ssize_t written = ::writev(fd_, batch.data(), static_cast<int>(n));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failed("cannot write", errno);
    if (written == 0 && bytes > 0) return failed("cannot write", EIO);
    auto left = static_cast<std::size_t>(written);
    while (next < pieces.size() && left >= pieces[next].size() - done)
      left -= pieces[next].size() - done, ++next, done = 0;
    done += left;
  }
  return {};
}

Result<void> AtomicOutput::commit() {
  if (temporary_.empty()) return {};
  if (replaces_ && ::fsync(fd_) != 0) return failed("cannot write", errno);
  if (::close(std::exchange(fd_, -1)) != 0) return failed("cannot write", errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return failed("cannot write", errno);
  temporary_.clear();
  if (replaces_) sync_directory(target_);
  return {};
}

}  // namespace meshgraft
