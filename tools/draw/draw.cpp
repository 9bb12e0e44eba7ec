// meshgraft_draw: a picture of one or more models.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "meshgraft/unv.hpp"
#include "png.hpp"
#include "render.hpp"

namespace meshgraft::draw {
namespace {

constexpr Colour kNewFace{250, 190, 70};
constexpr Colour kNoGroup{205, 205, 200};
constexpr std::array<Colour, 8> kPalette{{{166, 190, 214},
                                          {190, 210, 178},
                                          {206, 192, 216},
                                          {226, 206, 180},
                                          {176, 208, 206},
                                          {222, 188, 190},
                                          {200, 200, 160},
                                          {184, 184, 200}}};

using Key = std::array<double, 3>;
using FaceKey = std::array<Key, 3>;

Key key(Vec3 p) { return {p.x, p.y, p.z}; }

/// Equal for faces with the same three places, in any order.
FaceKey key(const std::array<Vec3, 3>& corner) {
  FaceKey k{key(corner[0]), key(corner[1]), key(corner[2])};
  std::sort(k.begin(), k.end());
  return k;
}

struct Options {
  std::vector<std::string> files, against, hidden;
  std::string output;
  double azimuth = 30, elevation = 25;  // degrees
  std::vector<double> zoom;             // x, y, z of the centre, half the height shown
  std::vector<std::uint32_t> pixels{900, 640};
};

/// The group that says most about each face: the smallest it is in. Groups of one name are one.
class GroupColours {
 public:
  explicit GroupColours(const std::vector<Model>& models) {
    for (const Model& m : models)
      for (std::size_t e = 0; e < m.n_elements(); ++e)
        if (m.is_face(ElementId(e)))
          for (const GroupId g : m.group_sets.members(m.element_groups[e])) ++n_faces_[m.groups[g.value].name];
    for (const Model& m : models)
      for (std::size_t e = 0; e < m.n_elements(); ++e)
        if (const Group* g = m.is_face(ElementId(e)) ? smallest(m, ElementId(e)) : nullptr)
          colour_.try_emplace(g->name, kPalette[colour_.size() % kPalette.size()]);
  }

  [[nodiscard]] Colour of(const Model& m, ElementId face) const {
    const Group* g = smallest(m, face);
    return g ? colour_.at(g->name) : kNoGroup;
  }

 private:
  [[nodiscard]] const Group* smallest(const Model& m, ElementId face) const {
    const Group* best = nullptr;
    for (const GroupId id : m.group_sets.members(m.element_groups[face.value])) {
      const Group& g = m.groups[id.value];
      if (!best || n_faces_.at(g.name) < n_faces_.at(best->name)) best = &g;
    }
    return best;
  }

  std::map<std::string, std::size_t> n_faces_;
  std::map<std::string, Colour> colour_;
};

/// How many faces and lines are on each edge of a model.
class EdgeStrokes {
 public:
  explicit EdgeStrokes(const Model& m) {
    for (std::size_t e = 0; e < m.n_elements(); ++e) {
      const ElementId id(e);
      const auto n = m.nodes_of(id);
      if (m.is_face(id))
        for (std::size_t k = 0; k < 3; ++k) ++n_faces_[edge(n[k], n[(k + 1) % 3])];
      else if (m.shape(id) == Shape::kLine)
        lines_.insert(edge(n[0], n[1]));
    }
  }

  [[nodiscard]] Stroke of(NodeId a, NodeId b) const {
    const int faces = n_faces_.at(edge(a, b));
    if (lines_.contains(edge(a, b))) return Stroke::kLine;
    return faces > 2 ? Stroke::kJunction : faces == 1 ? Stroke::kFree : Stroke::kThin;
  }

 private:
  static std::pair<NodeId, NodeId> edge(NodeId a, NodeId b) { return std::minmax(a, b); }

  std::map<std::pair<NodeId, NodeId>, int> n_faces_;
  std::set<std::pair<NodeId, NodeId>> lines_;
};

bool is_hidden(const Model& m, ElementId face, const std::vector<std::string>& groups) {
  const auto members = m.group_sets.members(m.element_groups[face.value]);
  return std::any_of(members.begin(), members.end(), [&](GroupId g) {
    return std::find(groups.begin(), groups.end(), m.groups[g.value].name) != groups.end();
  });
}

std::vector<Face> faces_to_draw(const std::vector<Model>& models, const std::vector<Model>& against,
                                const std::vector<std::string>& hidden) {
  std::set<FaceKey> known;
  for (const Model& m : against)
    for (std::size_t e = 0; e < m.n_elements(); ++e)
      if (m.is_face(ElementId(e))) known.insert(key(m.corners(ElementId(e))));

  const GroupColours colours(models);
  std::vector<Face> faces;
  for (const Model& m : models) {
    const EdgeStrokes strokes(m);
    for (std::size_t e = 0; e < m.n_elements(); ++e) {
      const ElementId id(e);
      if (!m.is_face(id) || is_hidden(m, id, hidden)) continue;
      const auto n = m.nodes_of(id);
      const std::array<Vec3, 3> corner = m.corners(id);
      const bool is_new = !against.empty() && !known.contains(key(corner));
      faces.push_back({corner,
                       {strokes.of(n[1], n[2]), strokes.of(n[2], n[0]), strokes.of(n[0], n[1])},
                       is_new ? kNewFace : colours.of(m, id)});
    }
  }
  return faces;
}

View view_of(const std::vector<Face>& faces, const Options& options) {
  View view;
  view.azimuth = options.azimuth / 180 * std::numbers::pi;
  view.elevation = options.elevation / 180 * std::numbers::pi;
  view.width = options.pixels[0], view.height = options.pixels[1];
  if (options.zoom.empty()) return fitted(view, faces);
  view.centre = {options.zoom[0], options.zoom[1], options.zoom[2]};
  view.half_height = options.zoom[3];
  return view;
}

Result<std::vector<Model>> read_all(const std::vector<std::string>& files) {
  std::vector<Model> models;
  for (const std::string& file : files) {
    Result<Model> model = read_unv(file);
    if (!model) return Failure(model.error());
    models.push_back(std::move(*model));
  }
  return models;
}

int run(const Options& options) {
  const auto models = read_all(options.files), against = read_all(options.against);
  for (const auto* input : {&models, &against})
    if (!*input) {
      std::cerr << to_string(input->error()) << '\n';
      return 3;
    }
  const std::vector<Face> faces = faces_to_draw(*models, *against, options.hidden);
  std::ofstream out(options.output, std::ios::binary);
  out << png(render(faces, view_of(faces, options))) << std::flush;
  if (out) return 0;
  std::cerr << options.output << ": cannot be written\n";
  return 5;
}

}  // namespace
}  // namespace meshgraft::draw

int main(int argc, char** argv) {
  meshgraft::draw::Options options;
  CLI::App app{
      "Draws universal files as a PNG picture. Faces have the colour of their smallest group; edges of more than two "
      "faces are red, edges with line elements blue."};
  app.add_option("FILE", options.files, "models, drawn together")->required();
  app.add_option("-o,--output", options.output, "the picture")->required();
  app.add_option("--against", options.against, "faces that are in none of these models are drawn as new, in yellow");
  app.add_option("--hide", options.hidden, "groups whose faces are left out");
  app.add_option("--azimuth", options.azimuth, "direction of the eye around z, degrees from x")->capture_default_str();
  app.add_option("--elevation", options.elevation, "of the eye above the xy plane, degrees")->capture_default_str();
  app.add_option("--zoom", options.zoom, "X Y Z of the centre and half the height shown, in model units")->expected(4);
  app.add_option("--pixels", options.pixels, "width and height")->expected(2)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return meshgraft::draw::run(options);
}
