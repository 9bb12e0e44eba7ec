// Writes every scene of the catalogue as universal files: DIR/NAME/base.unv, part_1.unv, ...; with FROM and TO, the
// random scenes of these seeds instead.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "meshgraft/unv.hpp"
#include "support/catalogue.hpp"
#include "support/random_scenes.hpp"

namespace {

bool write(const meshgraft::Model& model, const std::filesystem::path& path) {
  const auto done = meshgraft::write_unv(model, path.string());
  if (!done) std::fprintf(stderr, "%s\n", meshgraft::to_string(done.error()).c_str());
  return done.has_value();
}

std::vector<meshgraft::scenes::Merge> named_scenes() {
  std::vector<meshgraft::scenes::Merge> all = meshgraft::scenes::catalogue();
  for (auto& scene : meshgraft::scenes::contact_catalogue()) all.push_back(std::move(scene));
  for (auto& scene : meshgraft::scenes::gap_catalogue()) all.push_back(std::move(scene));
  return all;
}

std::vector<meshgraft::scenes::Merge> random_scenes(unsigned long from, unsigned long to) {
  std::vector<meshgraft::scenes::Merge> all;
  for (unsigned long seed = from; seed < to; ++seed) {
    all.push_back(meshgraft::scenes::random_shapes(meshgraft::scenes::draw_from(static_cast<std::uint32_t>(seed))));
    all.back().name = std::to_string(seed) + "_" + all.back().name;
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 4) {
    std::fprintf(stderr, "usage: write_scenes DIR [FROM TO]\n");
    return 2;
  }
  const auto all = argc == 2 ? named_scenes() : random_scenes(std::stoul(argv[2]), std::stoul(argv[3]));
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
    std::ofstream(folder / "limits.json") << "{\"quality.min\": " << scene.min_q
                                          << ", \"quality.mean\": " << scene.mean_q << ", \"quality.below_0.5\": 0}\n";
    std::printf("%s\n", scene.name.c_str());
  }
  return 0;
}
