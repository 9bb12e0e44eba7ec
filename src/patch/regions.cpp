#include "patch/regions.hpp"

#include <algorithm>

namespace meshgraft {
namespace {

class Regions {
 public:
  explicit Regions(const LocalMesh& mesh) : mesh_(mesh), seen_(mesh.n_faces(), 0), walked_(mesh.n_faces()) {}

  std::vector<Region> run() {
    std::vector<Region> all;
    for (std::size_t f = 0; f < mesh_.n_faces(); ++f)
      if (is_open(FaceId(f)) && !seen_[f]) all.push_back(region_of(FaceId(f)));
    return all;
  }

 private:
  [[nodiscard]] bool is_open(FaceId f) const { return mesh_.face(f).alive && mesh_.face(f).in_zone; }

  /// The face of the region beyond an edge, if the region goes on there.
  [[nodiscard]] FaceId beyond(FaceId f, std::size_t k) const {
    const LocalFace& face = mesh_.face(f);
    if (face.curve[k].valid()) return {};
    for (const FaceId g : mesh_.faces_at(face.v[k], face.v[(k + 1) % 3]))
      if (g != f && is_open(g) && mesh_.face(g).sheet == face.sheet) return g;
    return {};
  }

  Region region_of(FaceId start) {
    Region r;
    r.sheet = mesh_.face(start).sheet;
    std::vector<FaceId> open{start};
    seen_[start.value] = 1;
    while (!open.empty()) {
      const FaceId f = open.back();
      open.pop_back();
      r.faces.push_back(f);
      for (std::size_t k = 0; k < 3; ++k)
        if (const FaceId g = beyond(f, k); g.valid() && !seen_[g.value]) seen_[g.value] = 1, open.push_back(g);
    }
    std::ranges::sort(r.faces);
    std::vector<VertexId> on_contour;
    for (const FaceId f : r.faces)
      for (std::size_t k = 0; k < 3; ++k)
        if (walked_[f.value][k] == 0 && !beyond(f, k).valid()) walk(r, f, k, on_contour);
    add_inner_vertices(r, on_contour);
    return r;
  }

  /// One contour, from corner k of face f on.
  void walk(Region& r, FaceId f, std::size_t k, std::vector<VertexId>& on_contour) {
    auto& contour = r.contours.emplace_back();
    auto& sides = r.sides.emplace_back();
    while (walked_[f.value][k] == 0) {
      walked_[f.value][k] = 1;
      contour.push_back(mesh_.face(f).v[k]), sides.push_back(mesh_.face(f).curve[k]);
      on_contour.push_back(contour.back());
      const VertexId at = mesh_.face(f).v[(k + 1) % 3];
      k = (k + 1) % 3;
      for (FaceId next = beyond(f, k); next.valid(); next = beyond(f, k)) f = next, k = mesh_.face(f).corner_of(at);
    }
  }

  void add_inner_vertices(Region& r, std::vector<VertexId>& on_contour) {
    std::ranges::sort(on_contour);
    std::vector<VertexId> all;
    for (const FaceId f : r.faces) all.insert(all.end(), mesh_.face(f).v.begin(), mesh_.face(f).v.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const VertexId v : all) {
      if (std::ranges::binary_search(on_contour, v)) continue;
      if (mesh_.vertex(v).fixed)
        r.contours.push_back({v}), r.sides.push_back({CurveId{}});
      else
        r.inside.push_back(v);
    }
  }

  const LocalMesh& mesh_;
  std::vector<std::uint8_t> seen_;                   // by face
  std::vector<std::array<std::uint8_t, 3>> walked_;  // by face and corner: the edge is in a contour
};

}  // namespace

std::vector<Region> regions_of(const LocalMesh& mesh) { return Regions(mesh).run(); }

}  // namespace meshgraft
