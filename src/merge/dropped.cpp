#include "merge/dropped.hpp"

#include <algorithm>
#include <cmath>

#include "core/union_find.hpp"
#include "geometry/quality.hpp"
#include "intersect/shared.hpp"
#include "merge/edges.hpp"

namespace meshgraft {
namespace {

using Edge = std::array<VertexId, 2>;

constexpr double kLeastCosine = 0.5;  // of faces that lie on each other, in reckoning their areas

/// What is left of an edge when the marked faces are out.
struct Remains {
  std::size_t kept = 0, gone = 0;
};

Remains remains_of(std::span<const FaceOnEdge> edge, std::span<const std::uint8_t> marked) {
  Remains r;
  for (const FaceOnEdge& use : edge) ++(marked[use.face.value] != 0 ? r.gone : r.kept);
  return r;
}

/// Notes which edges become free or go, and gives the edges that no face has any more, ascending.
std::vector<Edge> note_edges(const Complex& complex, std::span<const std::uint8_t> marked, Dropped& dropped) {
  std::vector<Edge> bare;
  const std::vector<FaceOnEdge> uses = edge_uses(complex);
  for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
    const Remains r = remains_of(edge, marked);
    const VertexId a = edge[0].low, b = edge[0].high;
    const Dropped::Segment segment{complex.position[a.value], complex.position[b.value]};
    if (r.kept == 1 && r.gone > 0) dropped.borders.push_back(segment);
    if (r.kept == 0 && r.gone == 1) dropped.free_edges.push_back(segment);
    if (r.kept == 0) bare.push_back({a, b});
  });
  return bare;
}

void add(std::vector<double>& to, double amount, GroupSetId set, const GroupSets& sets, Dropped& dropped) {
  for (const GroupId g : sets.members(set)) to[g.value] += amount, dropped.touched[g.value] = 1;
}

bool is_bare(const std::vector<Edge>& bare, const Edge& ends) {
  const auto [low, high] = std::minmax(ends[0], ends[1]);
  return std::ranges::binary_search(bare, Edge{low, high});
}

/// The list without the items whose face is marked.
template <class T>
void keep(std::vector<T>& list, std::span<const std::uint8_t> marked) {
  std::size_t n = 0;
  for (std::size_t f = 0; f < list.size(); ++f)
    if (marked[f] == 0) list[n++] = list[f];
  list.resize(n);
}

/// Ascending.
std::vector<std::pair<ElementRef, FaceId>> pieces_by_parent(const Complex& complex) {
  std::vector<std::pair<ElementRef, FaceId>> pieces;
  for (std::size_t f = 0; f < complex.n_faces(); ++f) pieces.emplace_back(complex.parent[f], FaceId(f));
  std::ranges::sort(pieces);
  return pieces;
}

}  // namespace

std::vector<std::uint32_t> pieces_of(const Complex& complex, std::span<const Edge> borders) {
  UnionFind sets(complex.n_faces());
  const std::vector<FaceOnEdge> uses = edge_uses(complex);
  for_each_edge(uses, [&](std::span<const FaceOnEdge> edge) {
    if (std::ranges::binary_search(borders, Edge{edge[0].low, edge[0].high})) return;
    for (std::size_t i = 1; i < edge.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (complex.component[edge[i].face.value] == complex.component[edge[j].face.value])
          sets.unite(edge[i].face.value, edge[j].face.value);
  });
  std::vector<std::uint32_t> piece(complex.n_faces());
  for (std::uint32_t f = 0; f < piece.size(); ++f) piece[f] = sets.find(f);
  return piece;
}

void drop_faces(Corefined& corefined, std::span<const std::uint8_t> marked, const GroupSets& sets, std::size_t n_groups,
                Dropped& dropped) {
  Complex& complex = corefined.complex;
  dropped.area.resize(n_groups), dropped.length.resize(n_groups), dropped.touched.resize(n_groups);
  const std::vector<Edge> bare = note_edges(complex, marked, dropped);
  for (std::size_t f = 0; f < complex.n_faces(); ++f) {
    if (marked[f] == 0) continue;
    add(dropped.area, area(complex.corners(FaceId(f))), complex.face_groups[f], sets, dropped);
    for (const VertexId v : complex.face[f])
      for (const GroupId g : sets.members(complex.vertex_groups[v.value])) dropped.touched[g.value] = 1;
  }
  std::erase_if(complex.lines, [&](const Complex::Line& line) {
    if (!is_bare(bare, line.ends)) return false;
    const double length = distance(complex.position[line.ends[0].value], complex.position[line.ends[1].value]);
    add(dropped.length, length, line.groups, sets, dropped);
    return true;
  });
  std::erase_if(complex.fixed_edges, [&](const Edge& edge) { return is_bare(bare, edge); });
  keep(complex.face, marked), keep(complex.parent, marked), keep(complex.component, marked);
  keep(complex.face_groups, marked), keep(complex.face_attributes, marked), keep(corefined.touched, marked);
  if (!complex.layers.empty()) keep(complex.layers, marked);
  if (!corefined.kept.empty()) keep(corefined.kept, marked);
  corefined.junction_edges.clear(), corefined.junction_points.clear(), corefined.met.clear();
  find_shared(corefined);
}

void add_stretch(const Complex& original, const Corefined& corefined, const NodePlaces& places, const GroupSets& sets,
                 std::size_t n_groups, Dropped& dropped) {
  dropped.stretched_area.resize(n_groups), dropped.stretched_length.resize(n_groups);
  const auto left_of = [&, pieces = pieces_by_parent(corefined.complex)](ElementRef parent) {
    double sum = 0;
    for (const auto& piece : std::ranges::equal_range(pieces, parent, {}, &std::pair<ElementRef, FaceId>::first))
      sum += area(corefined.complex.corners(piece.second));
    return sum;
  };
  const auto gained_by = [&](ElementRef parent) {
    double sum = 0;
    for (const Corefined::Traded& t : std::ranges::equal_range(corefined.traded, parent, {}, &Corefined::Traded::face))
      sum += t.area;
    return sum;
  };
  for (std::size_t f = 0; f < original.n_faces(); ++f) {
    const ElementRef parent = original.parent[f];
    const auto covered = std::ranges::equal_range(corefined.covered, parent, {}, &Corefined::Covered::face);
    if (covered.empty() && !places.is_moved(parent)) continue;
    double now = 0;
    if (covered.empty()) now = area(places.of(parent));
    for (const Corefined::Covered& went : covered) now += went.has_heir ? went.area_there : went.area;
    if (!covered.empty()) now += left_of(parent) - gained_by(parent);
    const double growth = now - area(original.corners(FaceId(f)));
    for (const GroupId g : sets.members(original.face_groups[f])) dropped.stretched_area[g.value] += growth;
  }
  for (const Complex::Line& line : original.lines) {
    if (!places.is_moved(line.parent)) continue;
    const auto& [a, b] = line.ends;
    const double growth = distance(places.of(original.node[a.value]), places.of(original.node[b.value])) -
                          distance(original.position[a.value], original.position[b.value]);
    for (const GroupId g : sets.members(line.groups)) dropped.stretched_length[g.value] += growth;
  }
}

void add_facet_slack(const Complex& corefined, const NodePlaces& places, const GroupSets& sets, std::size_t n_groups,
                     Dropped& dropped) {
  dropped.facet_slack.resize(n_groups);
  for (std::size_t f = 0; f < corefined.layers.size(); ++f) {
    const Triangle face = corefined.corners(FaceId(f));
    for (const Complex::Layer& layer : corefined.layers[f]) {
      const double cosine = std::abs(dot(unit_normal(face), unit_normal(places.of(layer.parent))));
      const double amount = area(face) * (1 / std::max(cosine, kLeastCosine) - 1);
      for (const GroupId g : sets.members(layer.groups)) dropped.facet_slack[g.value] += amount;
    }
  }
}

DroppedEntry entry_of(const Complex& complex, std::span<const FaceId> faces, const GroupSets& sets,
                      std::span<const MergedGroup> groups) {
  DroppedEntry entry;
  entry.input = complex.parent[faces.front().value].input;
  std::vector<ElementRef> parents;
  std::vector<GroupId> members;
  Vec3 moment;
  for (const FaceId f : faces) {
    const Triangle t = complex.corners(f);
    parents.push_back(complex.parent[f.value]);
    entry.area += area(t), moment += area(t) * centroid(t);
    for (const GroupId g : sets.members(complex.face_groups[f.value])) members.push_back(g);
  }
  if (entry.area > 0) entry.at = moment / entry.area;
  const auto make_set = [](auto& list) {
    std::ranges::sort(list);
    list.erase(std::ranges::unique(list).begin(), list.end());
  };
  make_set(parents), make_set(members);
  entry.faces = parents.size();
  for (const GroupId g : members) entry.groups.push_back(groups[g.value].name);
  return entry;
}

}  // namespace meshgraft
