#include "intersect/meeting.hpp"

#include <algorithm>
#include <cmath>

#include "core/blocks.hpp"
#include "core/distinct.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kFaceBlock = 256;  // faces compared with the tree in one go
constexpr double kLargestSnap = 0.25;    // of the local edge length, whatever tolerance is asked for
// Shares of the largest coordinate. What arithmetic on coordinates costs is below the first; welding
// nearer than the second would decide by rounding.
constexpr double kNoise = 1.0 / (1L << 49);
constexpr double kRounding = 1.0 / (1L << 36);

bool contains(const std::array<VertexId, 3>& corners, std::uint32_t v) {
  return corners[0].value == v || corners[1].value == v || corners[2].value == v;
}

}  // namespace

SnapRule::SnapRule(double largest_coordinate, const CorefineOptions& options, bool features)
    : options_(options),
      features_(features),
      rounding_(kRounding * largest_coordinate),
      noise_(kNoise * largest_coordinate) {}

Snap SnapRule::at(double size) const {
  const double weld = std::max(options_.weld_share * size, rounding_);
  if (!features_) return {weld, weld, weld};
  const double asked = std::max(weld, options_.tolerance.at(size));
  return {std::max(weld, std::min(asked, kLargestSnap * size)), weld, asked};
}

Snap Meeting::snap(const FacePair& p) const {
  const FaceId f = side[0].face(p[0]), g = side[1].face(p[1]);
  Snap snap = rule.at(std::min(size[f.value], size[g.value]));
  if (!exact.empty() && (exact[f.value] || exact[g.value])) snap.feature = snap.weld;
  return snap;
}

bool Meeting::on_edge(const Carrier& on, std::size_t s, LocalEdge e) const {
  if (on.kind == Carrier::kEdge) return on.id == e;
  const auto& ends = side[s].ends(e);
  return on.kind == Carrier::kVertex && (on.id == ends[0].value || on.id == ends[1].value);
}

bool Meeting::on_face(const Symbol& symbol, std::size_t s, LocalFace f) const {
  const Carrier& on = symbol.on[s];
  if (on.kind == Carrier::kFace) return on.id == f;
  if (on.kind == Carrier::kVertex) return contains(side[s].corners(f), on.id);
  const auto& edges = side[s].edges(f);
  return edges[0] == on.id || edges[1] == on.id || edges[2] == on.id;
}

bool Meeting::meet(std::size_t s, LocalEdge e, LocalFace f) const {
  for (const VertexId v : side[s].ends(e))
    if (any_symbol(s, v, [&](const Symbol& symbol) { return on_face(symbol, 1 - s, f); })) return true;
  for (const VertexId v : side[1 - s].corners(f))
    if (any_symbol(1 - s, v, [&](const Symbol& symbol) { return on_edge(symbol, s, e); })) return true;
  for (const LocalEdge of_face : side[1 - s].edges(f))
    if (crossed_edges.contains(s == 0 ? std::array{e, of_face} : std::array{of_face, e})) return true;
  return false;
}

bool Meeting::share_end(LocalEdge e, LocalEdge f) const {
  for (const std::size_t s : kSides)
    for (const VertexId v : side[s].ends(s == 0 ? e : f))
      if (any_symbol(s, v, [&](const Symbol& symbol) { return on_edge(symbol, 1 - s, s == 0 ? f : e); })) return true;
  return false;
}

std::uint32_t Meeting::add(const Symbol& symbol) {
  const auto id = static_cast<std::uint32_t>(symbols.size());
  symbols.push_back(symbol);
  next.push_back({kNowhere, kNowhere});
  for (const std::size_t s : kSides) {
    if (symbol.on[s].kind != Carrier::kVertex) continue;
    std::uint32_t* last = &symbol_of[s][symbol.on[s].id];
    while (*last != kNowhere) last = &next[*last][s];
    *last = id;
  }
  return id;
}

void Meeting::join_groups(VertexId v, std::size_t s, const Carrier& on) {
  const VertexId itself(std::size_t{on.id});
  std::span<const VertexId> corners(&itself, 1);
  std::span<const LocalFace> faces(&on.id, 1);
  if (on.kind == Carrier::kVertex) faces = side[s].faces_at(itself);
  if (on.kind == Carrier::kEdge) corners = side[s].ends(on.id), faces = side[s].faces_at_edge(on.id);
  if (on.kind == Carrier::kFace) corners = side[s].corners(on.id);
  for (const LocalFace f : faces)
    for (const std::uint32_t component : complex.components_of(side[s].face(f))) {
      GroupSetId common = complex.groups_on(component, corners.front());
      for (const VertexId w : corners.subspan(1)) common = groups.intersect(common, complex.groups_on(component, w));
      complex.join_groups(v, component, common, groups);
    }
}

VertexId Meeting::new_vertex(Vec3 p, const std::array<Carrier, 2>& on) {
  const VertexId v = complex.add_vertex(p, {}, VertexState::kOpen, GroupSets::kEmpty);
  for (const std::size_t s : kSides) join_groups(v, s, on[s]);
  return v;
}

namespace {

Box grown_box(const Complex& complex, FaceId f, std::span<const double> size, const SnapRule& rule) {
  Box box;
  for (const Vec3 p : complex.corners(f)) box.add(p);
  return box.grown(2 * rule.at(size[f.value]).asked);
}

struct BoxedFaces {
  std::vector<FaceId> faces;
  std::vector<Box> boxes;
  Box all;
};

BoxedFaces faces_in(const Complex& complex, std::span<const FaceId> faces, const Box& within,
                    std::span<const double> size, const SnapRule& rule) {
  BoxedFaces found;
  for (const FaceId f : faces) {
    const Box box = grown_box(complex, f, size, rule);
    if (!within.overlaps(box)) continue;
    found.faces.push_back(f), found.boxes.push_back(box), found.all.add(box);
  }
  return found;
}

/// True if face f, apart from vertices that it shares with g, is farther than `gap` on one side of the
/// plane of g: then they meet in those vertices only.
bool is_beside(const Complex& complex, FaceId f, FaceId g, double gap) {
  const Triangle plane = complex.corners(g);
  const Vec3 n = unit_normal(plane);
  if (n == Vec3{}) return false;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const VertexId v : complex.face[f.value]) {
    if (contains(complex.face[g.value], v.value)) continue;
    const double height = dot(n, complex.position[v.value] - plane[0]);
    low = std::min(low, height), high = std::max(high, height);
  }
  return low > gap || high < -gap;
}

}  // namespace

std::vector<std::array<FaceId, 2>> near_pairs(const Complex& complex, std::span<const FaceId> first,
                                              std::span<const FaceId> second, std::span<const double> size,
                                              const SnapRule& rule) {
  Box within;
  for (const FaceId f : second) within.add(grown_box(complex, f, size, rule));
  const BoxedFaces a = faces_in(complex, first, within, size, rule);
  const BoxedFaces b = faces_in(complex, second, a.all, size, rule);
  const BoxTree tree(b.boxes);
  auto pairs = collected<std::array<FaceId, 2>>(
      a.faces.size(),
      [&](std::size_t i, auto& out) {
        tree.overlapping(a.boxes[i], [&](std::uint32_t j) {
          const FaceId f = a.faces[i], g = b.faces[j];
          const double gap = 2 * rule.at(std::min(size[f.value], size[g.value])).asked;
          if (!is_beside(complex, f, g, gap) && !is_beside(complex, g, f, gap)) out.push_back({f, g});
        });
      },
      kFaceBlock);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Meeting make_meeting(Complex& complex, GroupSets& groups, std::span<const double> size,
                     std::span<const std::uint8_t> exact, const SnapRule& rule,
                     std::span<const std::array<FaceId, 2>> pairs, std::span<const std::uint8_t> is_first,
                     std::span<const std::uint8_t> is_second, const FeatureRule& features,
                     const std::array<std::vector<FaceId>, 2>& beside) {
  std::array<std::vector<FaceId>, 2> faces = beside;
  for (const std::size_t s : kSides) {
    for (const auto& p : pairs) faces[s].push_back(p[s]);
    make_distinct(faces[s]);
  }
  Meeting m{
      complex,
      groups,
      size,
      exact,
      rule,
      {Side(complex, std::move(faces[0]), is_first, features), Side(complex, std::move(faces[1]), is_second, features)},
      {},
      {},
      {},
      {},
      {},
      {},
      {},
      {},
      {},
      {}};
  m.pairs.reserve(pairs.size());
  for (const auto& [f, g] : pairs) m.pairs.push_back({m.side[0].find(f), m.side[1].find(g)});
  for (const std::size_t s : kSides) m.symbol_of[s].assign(complex.n_vertices(), kNowhere);
  return m;
}

bool are_apart(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double gap) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::min(a[axis], b[axis]) > std::max(c[axis], d[axis]) + gap ||
        std::min(c[axis], d[axis]) > std::max(a[axis], b[axis]) + gap)
      return true;
  return false;
}

}  // namespace meshgraft
