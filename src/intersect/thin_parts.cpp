#include "intersect/thin_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/blocks.hpp"
#include "core/text.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/closest.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kFaceBlock = 256;  // faces compared with the tree in one go
constexpr double kAcross = 0.5;          // cosine of the angle to the normal up to which a way leads across

bool are_neighbours(const Complex& complex, FaceId f, FaceId g) {
  return std::ranges::find_first_of(complex.face[f.value], complex.face[g.value]) != complex.face[f.value].end();
}

/// Faces that are flat to others within the tolerance which are not their neighbours, ascending.
std::vector<FaceId> doubtful_faces(const Complex& complex, std::span<const FaceId> faces, std::span<const double> size,
                                   const ContactRule& rule) {
  std::vector<Box> boxes(faces.size());
  std::vector<Vec3> normal;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (const Vec3 p : complex.corners(faces[i])) boxes[i].add(p);
    normal.push_back(unit_normal(complex.corners(faces[i])));
  }
  const BoxTree tree(boxes);
  return collected<FaceId>(
      faces.size(),
      [&](std::size_t i, std::vector<FaceId>& doubtful) {
        bool found = false;
        tree.overlapping(boxes[i].grown(rule.gap(size[faces[i].value])), [&](std::uint32_t j) {
          found = found || (rule.is_flat(normal[i], normal[j]) && !are_neighbours(complex, faces[i], faces[j]));
        });
        if (found) doubtful.push_back(faces[i]);
      },
      kFaceBlock);
}

/// The shortest way from one to the other.
Vec3 way_between(const Triangle& t, const Triangle& u) {
  double least = std::numeric_limits<double>::infinity();
  Vec3 way;
  const auto consider = [&](Vec3 from, Vec3 to) {
    if (distance(from, to) < least) least = distance(from, to), way = to - from;
  };
  for (const Vec3 p : t) consider(p, closest_on_triangle(p, u).point);
  for (const Vec3 p : u) consider(closest_on_triangle(p, t).point, p);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const SegmentPair near = closest_between_segments(t[i], t[(i + 1) % 3], u[j], u[(j + 1) % 3]);
      consider(near.first.point, near.second.point);
    }
  return way;
}

/// Walks over the edges of a complex that have two faces.
class Walk {
 public:
  explicit Walk(const Complex& complex) : complex_(complex) {
    for (std::size_t f = 0; f < complex.n_faces(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = complex.face[f][k], b = complex.face[f][(k + 1) % 3];
        uses_.push_back({std::minmax(a, b), FaceId(f), a < b});
      }
    std::sort(uses_.begin(), uses_.end());
  }

  /// True if a way leads from f to g, over faces within reach of f, that has turned by less than a right angle
  /// when it arrives: slivers lie between the two, but no rim.
  [[nodiscard]] bool is_one_side(FaceId f, FaceId g, double reach) const {
    struct Seen {
      FaceId face;
      bool as_first;  // oriented like f along the way
    };
    std::vector<Seen> seen{{f, true}};
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto [at, as_first] = seen[i];
      if (at == g) {
        const double turn = dot(area_vector(complex_.corners(f)), area_vector(complex_.corners(g)));
        return as_first ? turn > 0 : turn < 0;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [beyond, same] = across(at, k);
        if (!beyond.valid() || std::ranges::find(seen, beyond, &Seen::face) != seen.end()) continue;
        if (norm(way_between(complex_.corners(f), complex_.corners(beyond))) > reach) continue;
        seen.push_back({beyond, same == as_first});
      }
    }
    return false;
  }

 private:
  struct Use {
    std::pair<VertexId, VertexId> edge;
    FaceId face;
    bool forward;  // the face runs along the edge from its smaller vertex
    friend auto operator<=>(const Use&, const Use&) = default;
  };
  struct Step {
    FaceId face;  // invalid: none, or several
    bool same_orientation = true;
  };
  [[nodiscard]] Step across(FaceId f, std::size_t corner) const {
    const auto& v = complex_.face[f.value];
    const std::pair<VertexId, VertexId> edge = std::minmax(v[corner], v[(corner + 1) % 3]);
    const auto uses = std::ranges::equal_range(uses_, edge, {}, &Use::edge);
    if (uses.size() != 2) return {};
    return {uses[uses[0].face == f ? 1 : 0].face, uses[0].forward != uses[1].forward};
  }

  const Complex& complex_;
  std::vector<Use> uses_;  // ascending
};

}  // namespace

std::optional<JunctionFault> find_thin_part(const Complex& complex, std::span<const FaceId> faces,
                                            std::span<const double> size, const ContactRule& rule) {
  const std::vector<FaceId> doubtful = doubtful_faces(complex, faces, size, rule);
  if (doubtful.empty()) return std::nullopt;
  const Contacts contacts = find_contacts(complex, doubtful, doubtful, size, rule);
  struct Found {
    double distance = std::numeric_limits<double>::infinity();
    std::array<FaceId, 2> pair;
  } nearest;
  std::optional<Walk> walk;  // most meshes need none
  for (std::size_t k = 0; k < contacts.pairs.size(); ++k) {
    const auto& [f, g] = contacts.pairs[k];
    if (contacts.on_each_other[k] == 0 || f >= g || are_neighbours(complex, f, g)) continue;
    const Vec3 way = way_between(complex.corners(f), complex.corners(g));
    const double d = norm(way), least_size = std::min(size[f.value], size[g.value]);
    if (d <= rule.weld(least_size) || d > rule.gap(least_size) || d >= nearest.distance) continue;
    // Faces beside each other in one plane are near along it.
    if (std::abs(dot(way, unit_normal(complex.corners(f)))) < kAcross * d) continue;
    if (!walk) walk.emplace(complex);
    if (!walk->is_one_side(f, g, rule.gap(least_size))) nearest = {d, {f, g}};
  }
  const auto& [f, g] = nearest.pair;
  if (!f.valid()) return std::nullopt;
  const double gap = rule.gap(std::min(size[f.value], size[g.value]));
  return JunctionFault{ErrorCode::kUsage,
                       "the tolerance of " + text_of(gap) +
                           " would weld the two sides of one mesh together, which are " + text_of(nearest.distance) +
                           " apart",
                       {complex.parent[f.value], complex.parent[g.value]},
                       centroid(complex.corners(f)),
                       "give a --tolerance below that distance"};
}

}  // namespace meshgraft
