// Writes every scene of the catalogue as universal files: DIR/NAME/base.unv, part_1.unv, ...
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "meshgraft/unv.hpp"
#include "support/catalogue.hpp"

namespace {

bool write(const meshgraft::Model& model, const std::filesystem::path& path) {
  const auto done = meshgraft::write_unv(model, path.string());
  if (!done) std::fprintf(stderr, "%s\n", meshgraft::to_string(done.error()).c_str());
  return done.has_value();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_scenes DIR\n");
    return 2;
  }
  std::vector<meshgraft::scenes::Merge> all = meshgraft::scenes::catalogue();
  for (auto& scene : meshgraft::scenes::contact_catalogue()) all.push_back(std::move(scene));
  for (auto& scene : meshgraft::scenes::gap_catalogue()) all.push_back(std::move(scene));
  for (const auto& scene : all) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / scene.name;
    std::filesystem::create_directories(folder);
    bool good = write(scene.base, folder / "base.unv");
    for (std::size_t k = 0; k < scene.parts.size(); ++k)
      good = write(scene.parts[k], folder / ("part_" + std::to_string(k + 1) + ".unv")) && good;
    if (!good) return 1;
    const auto& tolerance = scene.options.tolerance;
    std::ofstream(folder / "options") << "--tolerance "
                                      << (tolerance.relative ? 100 * tolerance.value : tolerance.value)
                                      << (tolerance.relative ? "%" : "") << '\n';
    std::printf("%s\n", scene.name.c_str());
  }
  return 0;
}
