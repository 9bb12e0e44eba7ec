#include "core/room.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace meshgraft {
namespace {

void advise(std::uintptr_t first, std::uintptr_t last, int advice) {
  (void)::madvise(reinterpret_cast<void*>(first), last - first, advice);
}

}  // namespace

void prepare_pages(void* begin, std::size_t n_bytes) {
  constexpr std::uintptr_t kLargePage = std::uintptr_t{2} << 20;
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const auto down = [](std::uintptr_t a, std::uintptr_t unit) { return a / unit * unit; };
  const auto up = [&](std::uintptr_t a, std::uintptr_t unit) { return down(a + unit - 1, unit); };
  const std::uintptr_t first = up(address, kLargePage), last = down(address + n_bytes, kLargePage);
  if (first >= last) return;
  advise(first, last, MADV_HUGEPAGE);
  advise(down(address, page), up(address + n_bytes, page), MADV_POPULATE_WRITE);  // the ends too, in one call
}

}  // namespace meshgraft
