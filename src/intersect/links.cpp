#include "intersect/links.hpp"

#include <algorithm>
#include <cmath>

#include "core/distinct.hpp"
#include "intersect/overlap.hpp"

namespace meshgraft {
namespace {

/// Two faces and a symbol that lies on both.
struct Contact {
  FacePair faces;
  std::uint32_t symbol;
  friend auto operator<=>(const Contact&, const Contact&) = default;
};

std::vector<LocalFace> faces_at(const Side& side, const Carrier& on) {
  if (on.kind == Carrier::kFace) return {on.id};
  const auto at = on.kind == Carrier::kEdge ? side.faces_at_edge(on.id) : side.faces_at(VertexId(std::size_t{on.id}));
  return {at.begin(), at.end()};
}

std::vector<Contact> contacts(const Meeting& m) {
  std::vector<Contact> all;
  for (std::uint32_t s = 0; s < m.symbols.size(); ++s) {
    const std::vector<LocalFace> second = faces_at(m.side[1], m.symbols[s].on[1]);
    for (const LocalFace f : faces_at(m.side[0], m.symbols[s].on[0]))
      for (const LocalFace g : second) all.push_back({{f, g}, s});
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Distinct vertices of the contacts of one pair, in order along their line; `thickness` is the
/// greatest distance from it.
struct Row {
  std::vector<VertexId> vertices;
  double thickness = 0;
};

Row row_of(const Meeting& m, std::span<const Contact> at_pair) {
  Row row;
  for (const Contact& c : at_pair) row.vertices.push_back(m.symbols[c.symbol].vertex);
  make_distinct(row.vertices);
  if (row.vertices.size() < 3) return row;

  VertexId from = row.vertices[0], to = row.vertices[1];
  double longest = -1;
  for (std::size_t i = 0; i < row.vertices.size(); ++i)
    for (std::size_t j = i + 1; j < row.vertices.size(); ++j)
      if (const double d = distance(m.at(row.vertices[i]), m.at(row.vertices[j])); d > longest)
        longest = d, from = row.vertices[i], to = row.vertices[j];
  const Vec3 along = normalized(m.at(to) - m.at(from));
  std::sort(row.vertices.begin(), row.vertices.end(), [&](VertexId a, VertexId b) {
    const double ta = dot(m.at(a), along), tb = dot(m.at(b), along);
    return ta < tb || (ta == tb && a < b);
  });
  for (const VertexId v : row.vertices)
    row.thickness = std::max(row.thickness, norm(cross(along, m.at(v) - m.at(from))));
  return row;
}

}  // namespace

std::array<Imprint, 2> collect_points(const Meeting& m) {
  std::array<Imprint, 2> imprint;
  for (const std::size_t s : kSides) {
    imprint[s].touched.assign(m.side[s].n_faces(), 0);
    for (const Symbol& symbol : m.symbols) {
      const Carrier& on = symbol.on[s];
      if (on.kind == Carrier::kEdge) imprint[s].on_edges.push_back({on.id, on.t, symbol.vertex});
      if (on.kind == Carrier::kFace) imprint[s].on_faces.push_back({on.id, symbol.vertex});
    }
    std::sort(imprint[s].on_edges.begin(), imprint[s].on_edges.end());
    make_distinct(imprint[s].on_faces);
  }
  return imprint;
}

tl::expected<std::array<Imprint, 2>, SharedArea> link_symbols(const Meeting& m, const CorefineOptions& options) {
  std::array<Imprint, 2> imprint = collect_points(m);

  const std::vector<Contact> all = contacts(m);
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    while (last < all.size() && all[last].faces == all[first].faces) ++last;
    const FacePair& faces = all[first].faces;
    for (const std::size_t s : kSides) imprint[s].touched[faces[s]] = 1;
    const Row row = row_of(m, std::span(all).subspan(first, last - first));
    if (is_area(m, faces, row.thickness, options)) return tl::unexpected(SharedArea{faces});
    for (std::size_t i = 1; i < row.vertices.size(); ++i) {
      const auto [a, b] = std::minmax(row.vertices[i - 1], row.vertices[i]);
      for (const std::size_t s : kSides) imprint[s].segments.push_back({faces[s], {a, b}});
    }
  }
  for (const std::size_t s : kSides) make_distinct(imprint[s].segments);
  if (const auto faces = find_overlap(m, options)) return tl::unexpected(SharedArea{*faces});
  return imprint;
}

}  // namespace meshgraft
