#include "support/scenes.hpp"

#include <cmath>
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

Model together(const Model& a, const Model& b) {
  ModelBuilder builder;
  for (const Model* m : {&a, &b}) {
    const std::size_t offset = m == &a ? 0 : a.n_nodes();
    for (std::size_t n = 0; n < m->n_nodes(); ++n) {
      const NodeId id = builder.add_node(m->position[n]);
      for (const GroupId g : m->group_sets.members(m->node_groups[n]))
        builder.add_to_group(m->groups[g.value].name, id);
    }
    for (std::size_t e = 0; e < m->n_elements(); ++e) {
      std::vector<NodeId> nodes;
      for (const NodeId n : m->nodes_of(ElementId(e))) nodes.emplace_back(n.value + offset);
      const ElementId id = builder.add_element(m->attributes_of(ElementId(e)), nodes);
      for (const GroupId g : m->group_sets.members(m->element_groups[e]))
        builder.add_to_group(m->groups[g.value].name, id);
    }
  }
  return builder.build(a.path + "+" + b.path);
}

}  // namespace meshgraft::scenes
