#include "support/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace meshgraft::scenes {
namespace {

std::size_t cells(double length, double size) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(length / size)));
}

// The same numbers from every standard library, unlike the distributions of <random>.
double centred(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0 - 0.5; }

}  // namespace

Model surface(const Surface& s) {
  ModelBuilder builder;
  std::mt19937 random(s.seed);
  const std::size_t columns = s.closed_u ? s.nu : s.nu + 1, rows = s.closed_v ? s.nv : s.nv + 1;
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const bool inner = (s.closed_u || (i > 0 && i < s.nu)) && (s.closed_v || (j > 0 && j < s.nv));
      const double du = s.jitter * 2 * centred(random), dv = s.jitter * 2 * centred(random);
      builder.add_node(s.at((static_cast<double>(i) + (inner ? du : 0)) / static_cast<double>(s.nu),
                            (static_cast<double>(j) + (inner ? dv : 0)) / static_cast<double>(s.nv)));
    }
  const auto node = [&](std::size_t i, std::size_t j) { return NodeId((j % rows) * columns + i % columns); };
  for (std::size_t j = 0; j < s.nv; ++j)
    for (std::size_t i = 0; i < s.nu; ++i) {
      const NodeId a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if ((i + j) % 2 == 0) {
        builder.add_to_group(s.group, builder.add_face(a, b, c));
        builder.add_to_group(s.group, builder.add_face(a, c, d));
      } else {
        builder.add_to_group(s.group, builder.add_face(a, b, d));
        builder.add_to_group(s.group, builder.add_face(b, c, d));
      }
    }
  return builder.build(s.group);
}

Model plate(Vec3 origin, Vec3 u, Vec3 v, double size, const std::string& group, double jitter) {
  Surface s;
  s.at = [=](double a, double b) { return origin + a * u + b * v; };
  s.nu = cells(norm(u), size), s.nv = cells(norm(v), size);
  s.group = group, s.jitter = jitter;
  return surface(s);
}

Model staggered_plate(Vec3 origin, Vec3 u, Vec3 v, double size, const std::string& group, double jitter) {
  const std::size_t columns = cells(norm(u), size);
  const std::size_t rows = cells(norm(v), size * std::numbers::sqrt3 / 2);
  ModelBuilder builder;
  std::mt19937 random(1);
  // Odd rows are shifted by half a cell, with a node at each end.
  std::vector<std::vector<NodeId>> row(rows + 1);
  for (std::size_t j = 0; j <= rows; ++j) {
    const bool odd = j % 2 == 1;
    const std::size_t n = columns + (odd ? 2 : 1);
    for (std::size_t i = 0; i < n; ++i) {
      double a = static_cast<double>(i);
      if (odd) a = i == 0 ? 0 : i + 1 == n ? static_cast<double>(columns) : a - 0.5;
      const bool inner = j > 0 && j < rows && i > 0 && i + 1 < n;
      const double da = jitter * 2 * centred(random), db = jitter * 2 * centred(random);
      row[j].push_back(builder.add_node(origin + (a + (inner ? da : 0)) / static_cast<double>(columns) * u +
                                        (static_cast<double>(j) + (inner ? db : 0)) / static_cast<double>(rows) * v));
    }
  }
  for (std::size_t j = 0; j < rows; ++j) {
    const bool odd = j % 2 == 1;
    const auto &even_row = row[odd ? j + 1 : j], &odd_row = row[odd ? j : j + 1];
    const auto add_face = [&](NodeId a, NodeId b, NodeId c) {
      builder.add_to_group(group, odd ? builder.add_face(a, c, b) : builder.add_face(a, b, c));
    };
    for (std::size_t i = 0; i <= columns; ++i) add_face(even_row[i], odd_row[i + 1], odd_row[i]);
    for (std::size_t i = 0; i < columns; ++i) add_face(even_row[i], even_row[i + 1], odd_row[i + 1]);
  }
  return builder.build(group);
}

Model triangle_plate(Vec3 corner, Vec3 u, Vec3 v, std::size_t n, const std::string& group) {
  ModelBuilder b;
  std::vector<std::vector<NodeId>> rows(n + 1);
  const auto share = [&](std::size_t k) { return static_cast<double>(k) / static_cast<double>(n); };
  for (std::size_t j = 0; j <= n; ++j)
    for (std::size_t i = 0; i + j <= n; ++i) rows[j].push_back(b.add_node(corner + share(i) * u + share(j) * v));
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i + j < n; ++i) {
      b.add_to_group(group, b.add_face(rows[j][i], rows[j][i + 1], rows[j + 1][i]));
      if (i + j + 1 < n) b.add_to_group(group, b.add_face(rows[j][i + 1], rows[j + 1][i + 1], rows[j + 1][i]));
    }
  return b.build();
}

Model cylinder(Vec3 from, Vec3 to, double radius, double size, const std::string& group) {
  const Vec3 axis = to - from;
  const Vec3 w = normalized(axis);
  const Vec3 helper = std::abs(w.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 e = normalized(cross(w, helper)), f = cross(w, e);
  Surface s;
  s.at = [=](double a, double b) {
    const double angle = 2 * std::numbers::pi * a;
    return from + b * axis + radius * (std::cos(angle) * e + std::sin(angle) * f);
  };
  s.nu = std::max<std::size_t>(6, cells(2 * std::numbers::pi * radius, size)), s.nv = cells(norm(axis), size);
  s.closed_u = true, s.group = group;
  return surface(s);
}

Model sphere(Vec3 centre, double radius, std::size_t n, const std::string& group) {
  constexpr double g = std::numbers::phi;
  const std::array<Vec3, 12> corner{{{-1, g, 0},
                                     {1, g, 0},
                                     {-1, -g, 0},
                                     {1, -g, 0},
                                     {0, -1, g},
                                     {0, 1, g},
                                     {0, -1, -g},
                                     {0, 1, -g},
                                     {g, 0, -1},
                                     {g, 0, 1},
                                     {-g, 0, -1},
                                     {-g, 0, 1}}};
  constexpr std::array<std::array<int, 3>, 20> triangle{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                         {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                         {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                         {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  ModelBuilder builder;
  // A point is named by its weights on the corners of the icosahedron, so that triangles share it.
  std::map<std::vector<std::pair<int, std::size_t>>, NodeId> known;
  const auto node = [&](const std::array<int, 3>& t, std::array<std::size_t, 3> weight) {
    std::vector<std::pair<int, std::size_t>> key;
    Vec3 p;
    for (std::size_t k = 0; k < 3; ++k)
      if (weight[k] > 0) key.emplace_back(t[k], weight[k]);
    std::sort(key.begin(), key.end());
    for (const auto& [c, w] : key) p += static_cast<double>(w) * corner[static_cast<std::size_t>(c)];
    const auto it = known.find(key);
    return it != known.end() ? it->second : known[key] = builder.add_node(centre + radius * normalized(p));
  };
  for (const auto& t : triangle)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; i + j < n; ++j) {
        const std::size_t k = n - i - j;
        const NodeId a = node(t, {k, i, j}), b = node(t, {k - 1, i + 1, j}), c = node(t, {k - 1, i, j + 1});
        builder.add_to_group(group, builder.add_face(a, b, c));
        if (k >= 2) builder.add_to_group(group, builder.add_face(b, node(t, {k - 2, i + 1, j + 1}), c));
      }
  return builder.build(group);
}

Model moved(Model model, const std::function<Vec3(Vec3)>& to) {
  for (Vec3& p : model.position) p = to(p);
  return model;
}

namespace {

/// Adds `model` to the builder, node n under the id `node_of(n)`.
template <class F>
void add(ModelBuilder& builder, const Model& model, F&& node_of) {
  for (std::size_t n = 0; n < model.n_nodes(); ++n)
    for (const GroupId g : model.group_sets.members(model.node_groups[n]))
      builder.add_to_group(model.groups[g.value].name, node_of(n));
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    std::vector<NodeId> nodes;
    for (const NodeId n : model.nodes_of(ElementId(e))) nodes.push_back(node_of(n.value));
    const ElementId id = builder.add_element(model.attributes_of(ElementId(e)), nodes);
    for (const GroupId g : model.group_sets.members(model.element_groups[e]))
      builder.add_to_group(model.groups[g.value].name, id);
  }
}

}  // namespace

Model together(std::span<const Model> models) {
  ModelBuilder builder;
  std::size_t offset = 0;
  std::string name;
  for (const Model& m : models) {
    for (const Vec3 p : m.position) builder.add_node(p);
    add(builder, m, [&](std::size_t n) { return NodeId(n + offset); });
    offset += m.n_nodes();
    name += (name.empty() ? "" : "+") + m.path;
  }
  return builder.build(name);
}

Model welded(const Model& model) {
  ModelBuilder builder;
  std::map<std::array<double, 3>, NodeId> at;
  std::vector<NodeId> id;
  for (const Vec3 p : model.position) {
    const auto [it, fresh] = at.try_emplace({p.x, p.y, p.z});
    if (fresh) it->second = builder.add_node(p);
    id.push_back(it->second);
  }
  add(builder, model, [&](std::size_t n) { return id[n]; });
  return builder.build(model.path);
}

ModelBuilder faces_of(const Model& model) {
  ModelBuilder builder;
  for (const Vec3 p : model.position) builder.add_node(p);
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    const auto v = model.nodes_of(ElementId(e));
    builder.add_face(v[0], v[1], v[2]);
  }
  return builder;
}

Model without_faces(const Model& model, const std::function<bool(Vec3 centroid)>& goes) {
  ModelBuilder builder;
  std::map<NodeId, NodeId> node;
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    const ElementId id(e);
    const auto corner = model.corners(id);
    if (goes((corner[0] + corner[1] + corner[2]) / 3.0)) continue;
    std::array<NodeId, 3> v;
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId old = model.nodes_of(id)[k];
      if (!node.contains(old)) {
        node[old] = builder.add_node(model.position[old.value], model.node_label[old.value]);
        for (const GroupId g : model.group_sets.members(model.node_groups[old.value]))
          builder.add_to_group(model.groups[g.value].name, node[old]);
      }
      v[k] = node[old];
    }
    const ElementId face = builder.add_element(model.attributes_of(id), v);
    for (const GroupId g : model.group_sets.members(model.element_groups[e]))
      builder.add_to_group(model.groups[g.value].name, face);
  }
  return builder.build(model.path);
}

}  // namespace meshgraft::scenes
