#include "peer_cgal.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <chrono>
#include <map>
#include <stdexcept>

namespace meshgraft::bench {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using EdgeFlags = Mesh::Property_map<Mesh::Edge_index, bool>;

/// Seconds since the last call.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Mesh half_edge_mesh(const Triangles& t) {
  Mesh mesh;
  mesh.reserve(t.position.size(), 3 * t.faces.size() / 2, t.faces.size());
  for (const Vec3& p : t.position) mesh.add_vertex({p.x, p.y, p.z});
  for (const auto& f : t.faces)
    if (mesh.add_face(Mesh::Vertex_index(f[0]), Mesh::Vertex_index(f[1]), Mesh::Vertex_index(f[2])) ==
        Mesh::null_face())
      throw std::invalid_argument("the peer holds manifold meshes only");
  return mesh;
}

/// Faces with a node on a flagged edge, then those with a node of these, and so on.
std::vector<Mesh::Face_index> band(const Mesh& mesh, const EdgeFlags& on_junction, int neighbourhoods) {
  std::vector<bool> chosen(mesh.number_of_faces() + mesh.number_of_removed_faces());
  std::vector<Mesh::Vertex_index> front;
  for (const auto e : mesh.edges())
    if (on_junction[e]) front.push_back(mesh.vertex(e, 0)), front.push_back(mesh.vertex(e, 1));
  std::vector<Mesh::Face_index> faces;
  for (int k = 0; k < neighbourhoods; ++k) {
    std::vector<Mesh::Vertex_index> next;
    for (const auto v : front)
      for (const auto f : mesh.faces_around_target(mesh.halfedge(v))) {
        if (f == Mesh::null_face() || chosen[f]) continue;
        chosen[f] = true;
        faces.push_back(f);
        for (const auto w : mesh.vertices_around_face(mesh.halfedge(f))) next.push_back(w);
      }
    front = std::move(next);
  }
  return faces;
}

void remesh_band(Mesh& mesh, const EdgeFlags& on_junction, const PeerOptions& options, std::vector<bool>& is_new) {
  const std::size_t n_before = mesh.number_of_faces() + mesh.number_of_removed_faces();
  const std::vector<Mesh::Face_index> faces = band(mesh, on_junction, options.neighbourhoods);
  is_new.assign(n_before, false);
  for (const auto f : faces) is_new[f] = true;
  pmp::isotropic_remeshing(faces, options.target_size, mesh,
                           CGAL::parameters::edge_is_constrained_map(on_junction)
                               .protect_constraints(options.conforming)
                               .number_of_iterations(options.iterations));
  is_new.resize(mesh.number_of_faces() + mesh.number_of_removed_faces(), true);
}

class Collector {
 public:
  /// Appends the faces of `mesh` whose flag is `wanted`; nodes at one place on a flagged edge are one node.
  void add(const Mesh& mesh, const EdgeFlags& on_junction, const std::vector<bool>& is_new, bool wanted,
           std::vector<std::uint32_t>& id) {
    if (id.empty()) number(mesh, on_junction, id);
    for (const auto f : mesh.faces()) {
      if (is_new[f] != wanted) continue;
      const auto h = mesh.halfedge(f);
      merged_.faces.push_back({id[mesh.source(h)], id[mesh.target(h)], id[mesh.target(mesh.next(h))]});
    }
  }
  [[nodiscard]] std::size_t n_faces() const { return merged_.faces.size(); }
  Triangles take() { return std::move(merged_); }

 private:
  void number(const Mesh& mesh, const EdgeFlags& on_junction, std::vector<std::uint32_t>& id) {
    constexpr std::uint32_t kUnset = 0xFFFFFFFF;
    id.assign(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), kUnset);
    for (const auto e : mesh.edges()) {
      if (!on_junction[e]) continue;
      for (const unsigned end : {0U, 1U}) {
        const auto v = mesh.vertex(e, end);
        const auto [it, fresh] =
            shared_.try_emplace(mesh.point(v), static_cast<std::uint32_t>(merged_.position.size()));
        if (fresh) append(mesh.point(v));
        id[v] = it->second;
      }
    }
    for (const auto v : mesh.vertices())
      if (id[v] == kUnset) {
        id[v] = static_cast<std::uint32_t>(merged_.position.size());
        append(mesh.point(v));
      }
  }
  void append(const Kernel::Point_3& p) { merged_.position.push_back({p.x(), p.y(), p.z()}); }

  Triangles merged_;
  std::map<Kernel::Point_3, std::uint32_t> shared_;
};

}  // namespace

PeerResult merge_with_cgal(const Triangles& base, const Triangles& part, const PeerOptions& options) {
  PeerResult result;
  Stopwatch watch;
  std::array<Mesh, 2> mesh{half_edge_mesh(base), half_edge_mesh(part)};
  result.build_seconds = watch.lap();

  std::array<EdgeFlags, 2> on_junction;
  for (int k = 0; k < 2; ++k) on_junction[k] = mesh[k].add_property_map<Mesh::Edge_index, bool>("e:junction").first;
  pmp::corefine(mesh[0], mesh[1], CGAL::parameters::edge_is_constrained_map(on_junction[0]),
                CGAL::parameters::edge_is_constrained_map(on_junction[1]));
  result.corefine_seconds = watch.lap();

  std::array<std::vector<bool>, 2> is_new;
  for (int k = 0; k < 2; ++k) remesh_band(mesh[k], on_junction[k], options, is_new[k]);
  result.remesh_seconds = watch.lap();

  Collector collector;
  std::array<std::vector<std::uint32_t>, 2> id;
  for (int k = 0; k < 2; ++k) collector.add(mesh[k], on_junction[k], is_new[k], false, id[k]);
  result.first_new = collector.n_faces();
  for (int k = 0; k < 2; ++k) collector.add(mesh[k], on_junction[k], is_new[k], true, id[k]);
  result.merged = collector.take();
  result.collect_seconds = watch.lap();
  return result;
}

}  // namespace meshgraft::bench
