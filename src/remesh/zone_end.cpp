#include "remesh/zone_end.hpp"

#include <algorithm>
#include <memory>
#include <tuple>

#include "core/blocks.hpp"
#include "zone/size_limits.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kSizeBlock = 64;  // edges at which the size is asked for in one go
constexpr double kTooShort = 0.5;       // of the wanted size: a face on such an edge and as high as wanted has Q 0.67

/// A side of a face of the zone, or of one beside it.
struct Use {
  VertexId low, high;
  bool is_inside = false;
  FaceId face;
  friend bool operator<(const Use& a, const Use& b) {
    return std::tie(a.low, a.high, a.is_inside, a.face) < std::tie(b.low, b.high, b.is_inside, b.face);
  }
};

/// Edges of faces of the zone and of others, each with one that is in it.
std::vector<Use> edges_at_end(const Complex& complex, const std::vector<std::uint8_t>& in_zone) {
  std::vector<std::uint8_t> is_at_zone(complex.n_vertices(), 0), is_outside(complex.n_vertices(), 0);
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (const VertexId v : complex.face[f]) (in_zone[f] ? is_at_zone : is_outside)[v.value] = 1;
  std::vector<Use> uses;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(complex.face[f][k], complex.face[f][(k + 1) % 3]);
      const auto may_end = [&](VertexId v) { return is_at_zone[v.value] != 0 && is_outside[v.value] != 0; };
      if (may_end(low) && may_end(high)) uses.push_back({low, high, in_zone[f] != 0, FaceId(f)});
    }
  std::ranges::sort(uses, [](const Use& a, const Use& b) { return a < b; });
  std::vector<Use> ends;
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].low == uses[first].low && uses[last].high == uses[first].high) ++last;
    if (!uses[first].is_inside && uses[last - 1].is_inside) ends.push_back(uses[last - 1]);
  }
  return ends;
}

}  // namespace

Sizing sizing_in_zone(const Complex& complex, const Brep& brep, const SizeField& size,
                      const std::vector<std::uint8_t>& in_zone) {
  const std::vector<Use> ends = edges_at_end(complex, in_zone);
  std::vector<SizeLimit> limits = collected<SizeLimit>(
      ends.size(),
      [&](std::size_t i, std::vector<SizeLimit>& out) {
        const Use& end = ends[i];
        const Vec3 a = complex.position[end.low.value], b = complex.position[end.high.value];
        const double wanted = size.at(brep.sheet_of_face[end.face.value], midpoint(a, b)), length = distance(a, b);
        if (length >= kTooShort * wanted) return;
        const double allowed = std::max(length, SizeOptions{}.gap_floor * wanted);
        out.push_back({a, b, allowed, allowed});
      },
      kSizeBlock);
  Sizing sizing = sizing_of(size);
  if (limits.empty()) return sizing;
  const auto at_end = std::make_shared<const SizeLimits>(std::move(limits), size.gradation());
  sizing.in_sheet = [at_end, ask = std::move(sizing.in_sheet)](SheetId s, Vec3 p) {
    return at_end->least(p, ask(s, p));
  };
  sizing.on_curve = [at_end, ask = std::move(sizing.on_curve)](CurveId c, Vec3 p) {
    return at_end->least(p, ask(c, p));
  };
  return sizing;
}

}  // namespace meshgraft
