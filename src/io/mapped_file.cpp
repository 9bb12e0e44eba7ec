#include "io/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

namespace meshgraft {
namespace {

Failure cannot_read(const std::string& path, int reason) {
  return failure(ErrorCode::kCannotRead, "cannot read: " + std::generic_category().message(reason),
                 "check the name of the file and its permissions", {path, 0});
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

int read_all(int fd, std::string& text) try {
  constexpr std::size_t kBlock = 1 << 16;
  for (;;) {
    const std::size_t have = text.size();
    text.resize(have + kBlock);
    const ssize_t got = ::read(fd, text.data() + have, kBlock);
    text.resize(have + (got > 0 ? static_cast<std::size_t>(got) : 0));
    if (got == 0) return 0;
    if (got < 0 && errno != EINTR) return errno;
  }
} catch (const std::bad_alloc&) {
  return ENOMEM;
}

/// A file that was given a length but no content. It reads as that many zeros, which may be more than
/// there is memory for.
bool is_hole(int fd) { return ::lseek(fd, 0, SEEK_DATA) < 0 && errno == ENXIO; }

}  // namespace

Result<MappedFile> MappedFile::open(const std::string& path) {
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (fd.get() < 0) return cannot_read(path, errno);
  struct stat status {};
  if (::fstat(fd.get(), &status) != 0) return cannot_read(path, errno);
  if (S_ISDIR(status.st_mode)) return cannot_read(path, EISDIR);
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode))  // may have no end
    return failure(ErrorCode::kCannotRead, "cannot read: it is a device", "give the name of a file or a pipe",
                   {path, 0});

  MappedFile file;
  if (!S_ISREG(status.st_mode)) {
    if (const int reason = read_all(fd.get(), file.read_); reason != 0) return cannot_read(path, reason);
    return file;
  }
  if (status.st_size == 0 || is_hole(fd.get())) return file;
  const auto size = static_cast<std::size_t>(status.st_size);
  void* map = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd.get(), 0);
  if (map == MAP_FAILED) return cannot_read(path, errno);
  ::madvise(map, size, MADV_WILLNEED);
  file.map_ = static_cast<const char*>(map), file.size_ = size;
  return file;
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : map_(std::exchange(other.map_, nullptr)), size_(std::exchange(other.size_, 0)), read_(std::move(other.read_)) {}

MappedFile::~MappedFile() {
  if (map_ != nullptr) ::munmap(const_cast<char*>(map_), size_);
}

}  // namespace meshgraft
