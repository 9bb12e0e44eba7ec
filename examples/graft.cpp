// Grafts a part onto a base: graft BASE PART OUT.
#include <array>
#include <cstdio>
#include <utility>

#include "meshgraft/merge.hpp"
#include "meshgraft/unv.hpp"

namespace {

int failed(const meshgraft::Error& error) {
  std::fprintf(stderr, "%s\n", to_string(error).c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: graft BASE PART OUT\n", stderr), 2;
  const auto base = meshgraft::read_unv(argv[1]);
  if (!base) return failed(base.error());
  auto part = meshgraft::read_unv(argv[2]);
  if (!part) return failed(part.error());
  const std::array parts{std::move(*part)};

  auto merged = meshgraft::merge(*base, parts);
  if (!merged) return failed(merged.error());
  meshgraft::Report& report = merged->report;
  if (!report.broken_promises.empty()) return failed(report.broken_promises.front());

  const auto written = meshgraft::write_unv(*base, parts, *merged, argv[3], report);
  if (!written) return failed(written.error());
  std::printf("%zu new triangles, worst Q %.2f\n", merged->graft.new_elements.size(), report.quality.min);
}
