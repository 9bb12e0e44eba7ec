// Writes what the pictures of docs/figures.md show, as universal files in DIR; see tools/figures.
#include <cstdio>
#include <filesystem>

#include "figures/figures.hpp"
#include "meshgraft/unv.hpp"

namespace {

using namespace meshgraft;

std::filesystem::path folder;  // DIR

void put(const Model& model, const std::string& name) {
  const auto done = write_unv(model, (folder / (name + ".unv")).string());
  if (!done) std::fprintf(stderr, "%s\n", to_string(done.error()).c_str());
}

void put(const Model& base, std::span<const Model> parts, const Result<Merged>& merged, const std::string& name) {
  if (merged)
    put(apply(base, parts, *merged), name);
  else
    std::fprintf(stderr, "%s: %s\n", name.c_str(), to_string(merged.error()).c_str());
}

MergeOptions paper() {
  MergeOptions options;
  options.method = Method::kPaper;
  return options;
}

void put_merge(const Model& base, const Model& part, const std::string& name) {
  put(base, name + "_base"), put(part, name + "_part");
  put(base, std::span(&part, 1), merge(base, std::span(&part, 1), paper()), name + "_merged");
}

void put_contour(const std::vector<Vec3>& contour, const figures::Corners& faces, const std::string& name) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (const auto& f : faces) triangles.push_back({contour[f[0]], contour[f[1]], contour[f[2]]});
  put(figures::model_of(triangles, "FILL"), name);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_figures DIR\n");
    return 2;
  }
  folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const auto& c : figures::configurations()) put_merge(c.base, c.part, "4_" + c.name);
  for (const auto& i : figures::incidences())
    put(figures::model_of({figures::first_triangle(), i.second}, "PAIR"), "6_" + i.name);
  const auto uneven = figures::uneven_crossing(), like = figures::like_density(figures::kNearRow, figures::kNearRow);
  put_merge(uneven[0], uneven[1], "7");
  put_merge(like[0], like[1], "8");
  const auto contour = figures::wavy_contour();
  put_contour(contour, figures::of_least_area(contour), "9_least_area");
  put_contour(contour, figures::of_best_quality(contour), "9_best_quality");
  const Model sphere = figures::holed_sphere();
  put(sphere, "10_hole");
  FillOptions options;
  options.zone = paper();
  options.zone.blend = Blend::kPosition;
  put(sphere, {}, fill(sphere, options), "10_position");
  options.zone.blend = Blend::kTangency;
  put(sphere, {}, fill(sphere, options), "10_tangency");
  return 0;
}
