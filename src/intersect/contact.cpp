#include "intersect/contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/blocks.hpp"
#include "core/distinct.hpp"
#include "geometry/closest.hpp"
#include "geometry/quality.hpp"
#include "intersect/common_area.hpp"

namespace meshgraft {
namespace {

constexpr double kBeside = 0.1;          // of the edge length: largest shift along a surface
constexpr double kMost = 0.5;            // share of a common area within the gap from which faces lie on each other
constexpr double kNoArea = 1e-6;         // share of the smaller face below which a common area is none
constexpr double kLeaning = 0.3;         // of the height: how far beside a border what lies above it may be at most
constexpr double kLeans = 0.93;          // cosine of the angle from which a face leans over another
constexpr double kFlatter = 0.05;        // by this cosine more a face lies clearly flatter on another
constexpr double kFoldedOver = 0.05;     // share of the smaller face from which one lies over the other
constexpr std::size_t kFaceBlock = 256;  // faces compared with the tree in one go

/// Area that two faces share, and the part of it within the gap.
struct CommonArea {
  double whole = 0, within = 0;
  bool is_broad = false;  // not a strip that snapping could make or take away
  void add(const CommonArea& other) { whole += other.whole, within += other.within; }
  [[nodiscard]] bool lies_on() const { return whole > 0 && within >= kMost * whole; }
  [[nodiscard]] bool stands_off() const { return whole > 0 && !lies_on(); }
};

CommonArea common_area(const Triangle& t, const Triangle& u, const Reach& heights, double beside = 0) {
  const std::vector<Vec3> shared = part_over(u, t);
  const double whole = area_of(shared);
  if (whole <= kNoArea * std::min(area(t), area(u))) return {};
  return {whole, area_of(within(shared, t, heights)), whole > beside * diameter(shared)};
}

struct Boxed {
  std::vector<FaceId> faces;
  std::vector<Box> boxes;
  Box all;
};

template <class F>
Boxed boxed(F&& corners, std::span<const FaceId> faces, const Box* in, std::span<const double> size,
            const ContactRule& rule, std::span<const Reach> reach) {
  Boxed found;
  for (const FaceId f : faces) {
    Box box;
    for (const Vec3 p : corners(f)) box.add(p);
    const Reach own = reach.empty() ? Reach{} : reach[f.value];
    box = box.grown(rule.gap(size[f.value]) + std::max(-own.low, own.high));
    if (in != nullptr && !in->overlaps(box)) continue;
    found.faces.push_back(f), found.boxes.push_back(box), found.all.add(box);
  }
  return found;
}

/// Heights above a face, along its normal, at which the other lies on it.
Reach heights_on(FaceId f, FaceId g, bool same_way, double gap, std::span<const Reach> reach) {
  if (reach.empty()) return {-gap, gap};
  const Reach own = reach[f.value], other = same_way ? reach[g.value].turned() : reach[g.value];
  return {own.low + other.low - gap, own.high + other.high + gap};
}

/// Faces that lie on the other side, found by their corners.
class LyingFaces {
 public:
  LyingFaces(const Complex& complex, std::vector<FaceId> faces) : complex_(complex) {
    make_distinct(faces);
    for (const FaceId f : faces)
      for (const VertexId v : complex.face[f.value]) at_[v].push_back(f);
  }
  /// Whether such faces have corners of `f`, but all only around a fold.
  [[nodiscard]] bool are_around_a_fold(FaceId f, const ContactRule& rule) const {
    // However far the contact reaches, what is folded more than a sharp edge goes off it.
    const double flat = std::cos(std::min(rule.options.contact_angle, rule.options.sharp_angle));
    const Vec3 n = unit_normal(complex_.corners(f));
    bool any = false;
    for (const VertexId v : complex_.face[f.value])
      if (const auto found = at_.find(v); found != at_.end())
        for (const FaceId g : found->second) {
          if (std::abs(dot(n, unit_normal(complex_.corners(g)))) > flat) return false;
          any = true;
        }
    return any;
  }

 private:
  const Complex& complex_;
  std::map<VertexId, std::vector<FaceId>> at_;
};

/// Of neighbours of which one is folded over the other, as a leaning facet in the wall of a hole over the plate around
/// it, only that lies on another face which is clearly flatter to it: the other lies behind.
class FoldedOver {
 public:
  struct Lying {
    FaceId face;
    std::uint32_t on = 0;  // component
    friend auto operator<=>(const Lying&, const Lying&) = default;
  };

  /// `corners`: of a face.
  template <class F>
  FoldedOver(const Complex& complex, std::vector<Lying> lying, F&& corners)
      : complex_(complex), lying_(std::move(lying)) {
    make_distinct(lying_);
    for (std::size_t i = 0; i < lying_.size(); ++i) {
      corners_.push_back(corners(lying_[i].face));
      for (const VertexId v : complex.face[lying_[i].face.value]) at_[v].push_back(i);
    }
  }

  /// Whether a face is behind a neighbour, as what it may lie on with this normal sees it.
  [[nodiscard]] bool is_behind(const Lying& f, const Triangle& own, Vec3 normal_on) const {
    const double flatness = std::abs(dot(unit_normal(own), normal_on));
    if (flatness >= kLeans) return false;
    const auto is_before = [&](std::size_t i) {
      const Lying& other = lying_[i];
      if (other.on != f.on || complex_.component[other.face.value] != complex_.component[f.face.value] ||
          std::abs(dot(unit_normal(corners_[i]), normal_on)) < flatness + kFlatter)
        return false;
      return area_of(part_over(own, corners_[i])) > kFoldedOver * std::min(area(own), area(corners_[i]));
    };
    return std::ranges::any_of(complex_.face[f.face.value], [&](VertexId v) {
      const auto found = at_.find(v);
      return found != at_.end() && std::ranges::any_of(found->second, is_before);
    });
  }

 private:
  const Complex& complex_;
  std::vector<Lying> lying_;                         // ascending
  std::vector<Triangle> corners_;                    // by position there
  std::map<VertexId, std::vector<std::size_t>> at_;  // positions there
};

}  // namespace

double ContactRule::gap(double size) const { return std::max(options.tolerance.at(size), weld(size)); }

double ContactRule::beside(double size) const {
  return std::max(std::min(options.tolerance.at(size), kBeside * size), weld(size));
}

bool ContactRule::is_flat(Vec3 unit_normal, Vec3 other) const {
  return std::abs(dot(unit_normal, other)) > std::cos(options.contact_angle);
}

Contacts find_contacts(const Complex& complex, std::span<const FaceId> first, std::span<const FaceId> second,
                       std::span<const double> size, const ContactRule& rule, std::span<const Reach> reach,
                       std::span<const Triangle> lying_at) {
  const auto corners = [&](FaceId f) { return lying_at.empty() ? complex.corners(f) : lying_at[f.value]; };
  const Boxed b = boxed(corners, second, nullptr, size, rule, reach);
  const Boxed a = boxed(corners, first, &b.all, size, rule, reach);
  const BoxTree tree(b.boxes);
  struct Found {
    std::array<FaceId, 2> pair;
    CommonArea area;
    bool is_beside = false;
  };
  auto found = collected<Found>(
      a.faces.size(),
      [&](std::size_t i, std::vector<Found>& out) {
        const Triangle t = corners(a.faces[i]);
        const Vec3 n = unit_normal(t);
        tree.overlapping(a.boxes[i], [&](std::uint32_t j) {
          const FaceId f = a.faces[i], g = b.faces[j];
          const Triangle u = corners(g);
          const Vec3 m = unit_normal(u);
          if (!rule.is_flat(n, m)) return;
          const double smaller = std::min(size[f.value], size[g.value]);
          const Reach heights = heights_on(f, g, dot(n, m) > 0, rule.gap(smaller), reach);
          if (within({u.begin(), u.end()}, t, heights).empty()) return;
          const double beside = rule.beside(smaller);
          const CommonArea area = common_area(t, u, heights, beside);
          const bool is_beside = area.whole == 0 && !within(part_over(u, t, beside), t, heights).empty();
          out.push_back({{f, g}, area, is_beside});
        });
      },
      kFaceBlock);
  std::ranges::sort(found, {}, &Found::pair);
  std::map<FaceId, CommonArea> of_face;
  for (const Found& f : found)
    for (const FaceId face : f.pair) of_face[face].add(f.area);
  // Planes that cross are near each other along a strip: a face lies on the other side as a whole.
  const auto lie = [&](const Found& f) {
    return f.area.lies_on() && of_face[f.pair[0]].lies_on() && of_face[f.pair[1]].lies_on();
  };
  const auto may_come_to_lie = [&](const Found& f) {
    return f.is_beside && !of_face[f.pair[0]].stands_off() && !of_face[f.pair[1]].stands_off();
  };
  const bool any = std::ranges::any_of(found, lie);
  const auto lying_on = [&](const Found& f, std::size_t s) {
    return FoldedOver::Lying{f.pair[s], complex.component[f.pair[1 - s].value]};
  };
  std::array<std::vector<FoldedOver::Lying>, 2> lying_broadly;
  if (std::cos(rule.options.contact_angle) < kLeans)
    for (const Found& f : found)
      for (const std::size_t s : {0, 1})
        if (lie(f) && f.area.is_broad) lying_broadly[s].push_back(lying_on(f, s));
  const std::array folded{FoldedOver(complex, std::move(lying_broadly[0]), corners),
                          FoldedOver(complex, std::move(lying_broadly[1]), corners)};
  const auto is_behind = [&](const Found& f) {
    return folded[0].is_behind(lying_on(f, 0), corners(f.pair[0]), unit_normal(corners(f.pair[1]))) ||
           folded[1].is_behind(lying_on(f, 1), corners(f.pair[1]), unit_normal(corners(f.pair[0])));
  };
  std::vector<FaceId> broadly;
  for (const Found& f : found)
    if (lie(f) && f.area.is_broad && !is_behind(f)) broadly.insert(broadly.end(), f.pair.begin(), f.pair.end());
  const LyingFaces lying(complex, std::move(broadly));
  // Where two plates with a common hole lie on each other the walls of the hole abut, and lean over each other by a
  // hair.
  const auto abut = [&](const Found& f) {
    return !f.area.is_broad &&
           std::ranges::all_of(f.pair, [&](FaceId face) { return lying.are_around_a_fold(face, rule); });
  };
  Contacts contacts;
  for (const Found& f : found) {
    contacts.pairs.push_back(f.pair);
    const bool lies = any && (lie(f) || may_come_to_lie(f)) && !abut(f) && !is_behind(f);
    contacts.on_each_other.push_back(lies ? 1 : 0);
  }
  return contacts;
}

bool have_common_area(const Triangle& t, const Triangle& u) { return common_area(t, u, {}).whole > 0; }

Cover::Cover(std::vector<Triangle> faces, std::vector<double> size, std::vector<Vec3> unit_normal,
             std::span<const std::array<VertexId, 3>> corners)
    : faces_(std::move(faces)),
      size_(std::move(size)),
      unit_normal_(std::move(unit_normal)),
      border_edge_(faces_.size()),
      border_corner_(faces_.size()) {
  std::vector<Box> boxes(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (const Vec3 p : faces_[f]) boxes[f].add(p);
  tree_ = BoxTree(boxes);
  find_border(corners);
}

void Cover::find_border(std::span<const std::array<VertexId, 3>> corners) {
  struct Use {
    std::array<VertexId, 2> ends;
    std::size_t face = 0, edge = 0;
  };
  std::vector<Use> uses;
  for (std::size_t f = 0; f < corners.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corners[f][k], corners[f][(k + 1) % 3]);
      uses.push_back({{low, high}, f, k});
    }
  std::ranges::sort(uses, {}, &Use::ends);
  std::vector<VertexId> on_border;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const bool alone =
        (i == 0 || uses[i - 1].ends != uses[i].ends) && (i + 1 == uses.size() || uses[i + 1].ends != uses[i].ends);
    if (!alone) continue;
    border_edge_[uses[i].face][uses[i].edge] = 1;
    on_border.insert(on_border.end(), uses[i].ends.begin(), uses[i].ends.end());
  }
  std::ranges::sort(on_border);
  for (std::size_t f = 0; f < corners.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      border_corner_[f][k] = std::ranges::binary_search(on_border, corners[f][k]) ? 1 : 0;
}

Cover::Foot Cover::foot(Vec3 p) const {
  const auto nearest =
      tree_.nearest(p, [&](std::uint32_t f) { return squared_norm(p - closest_on_triangle(p, faces_[f]).point); });
  const TrianglePoint at = closest_on_triangle(p, faces_[nearest.item]);
  Foot foot;
  foot.face = nearest.item;
  foot.point = at.point;
  const Vec3 n = unit_normal(faces_[nearest.item]);
  foot.height = dot(n, p - foot.point);
  foot.beside = norm(p - foot.point - foot.height * n);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool at_corner = at.weight[k] >= 1;
    const bool on_edge = at.weight[(k + 2) % 3] <= 0;  // from corner k to the next
    if ((at_corner && border_corner_[foot.face][k]) || (on_edge && border_edge_[foot.face][k])) foot.on_border = true;
  }
  return foot;
}

bool Cover::covers(Vec3 p, Vec3 unit_normal, const ContactRule& rule) const {
  if (empty()) return false;
  const Foot at = foot(p);
  const Vec3 n = unit_normal_[at.face];
  if (!rule.is_flat(unit_normal, n)) return false;
  // Along the normal of the one or of the other: the two feet are as far apart as the faces lean.
  const double leaning = std::min(norm(cross(unit_normal, n)) / std::abs(dot(unit_normal, n)), kLeaning);
  const double size = size_[at.face], off = rule.weld(size) + leaning * std::abs(at.height);
  return std::abs(at.height) <= rule.gap(size) && (!at.on_border || at.beside <= off);
}

}  // namespace meshgraft
