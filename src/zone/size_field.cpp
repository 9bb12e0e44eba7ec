#include "zone/size_field.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/blocks.hpp"
#include "geometry/closest.hpp"
#include "geometry/quality.hpp"
#include "zone/curve_edges.hpp"
#include "zone/edge_table.hpp"
#include "zone/gaps.hpp"
#include "zone/original_faces.hpp"
#include "zone/own_size.hpp"
#include "zone/ruler.hpp"
#include "zone/size_limits.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kSizeBlock = 64;  // places at which the size is asked for in one go
constexpr double kWorthALimit = 0.9;    // a curve must be finer than this share of the size around it
constexpr double kBend = 0.7;           // the same for bends; a ruler without bends already rounds to 0.71
constexpr double kSame = 1 + 1e-9;      // sizes that differ by less are the same mean, summed in another order
constexpr double kStraight = 0.2;       // radians; a curve that turns less in all has no bends

std::vector<std::vector<SheetId>> sheets_at_curves(const Brep& brep) {
  std::vector<std::vector<SheetId>> result(brep.curves.size());
  for (std::size_t f = 0; f < brep.curve_of_edge.size(); ++f)
    for (const CurveId c : brep.curve_of_edge[f])
      if (c.valid()) result[c.value].push_back(brep.sheet_of_face[f]);
  for (auto& sheets : result) {
    std::ranges::sort(sheets);
    sheets.erase(std::ranges::unique(sheets).begin(), sheets.end());
  }
  return result;
}

double total_turn(std::span<const Vec3> points) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3 in = points[i] - points[i - 1], out = points[i + 1] - points[i];
    sum += std::atan2(norm(cross(in, out)), dot(in, out));
  }
  return sum;
}

}  // namespace

struct SizeField::Data {
  SizeOptions options;
  std::vector<OwnSize> own;                            // by sheet
  std::vector<std::vector<SheetId>> sheets;            // by curve
  std::vector<std::vector<std::uint32_t>> components;  // by curve: of each of `sheets`
  std::vector<SheetId> kept;                           // by curve: a sheet with a kept face at it, if any
  std::vector<double> slack;                           // by curve
  SizeLimits junction;                                 // l_a
  SizeLimits limits;                                   // l_a too

  [[nodiscard]] double at(SheetId sheet, Vec3 p) const { return limits.least(p, from_below(sheet, p)); }

  /// Without the limits of narrow places and fine curves.
  [[nodiscard]] double plain(SheetId sheet, Vec3 p) const { return junction.least(p, from_below(sheet, p)); }

  /// Of the sheet that asks for the least.
  [[nodiscard]] double on_curve(CurveId curve, Vec3 p) const {
    double size = std::numeric_limits<double>::infinity();
    for (const SheetId s : sheets[curve.value]) size = std::min(size, at(s, p));
    return size;
  }
  [[nodiscard]] double plain_on_curve(CurveId curve, Vec3 p) const {
    double size = std::numeric_limits<double>::infinity();
    for (const SheetId s : sheets[curve.value]) size = std::min(size, plain(s, p));
    return size;
  }

  /// The own size, but at least what l_a leaves there.
  [[nodiscard]] double from_below(SheetId sheet, Vec3 p) const {
    const double size = own[sheet.value].at(p).size;
    if (junction.largest() <= kSame * size) return size;
    const auto near = junction.nearest(p, (junction.largest() - size) / options.gradation);
    return near.found ? std::max(size, near.size - options.gradation * near.distance) : size;
  }

  /// l_a: see the class comment.
  [[nodiscard]] double mean_at_junction(CurveId curve, Vec3 p) const {
    if (kept[curve.value].valid()) return own[kept[curve.value].value].at(p).edge;
    if (options.junction_size) return *options.junction_size;
    // A mesh that continues on several sheets counts once, with their mean.
    std::vector<std::pair<std::uint32_t, double>> wishes;
    for (std::size_t i = 0; i < sheets[curve.value].size(); ++i)
      wishes.emplace_back(components[curve.value][i], own[sheets[curve.value][i].value].at(p).edge);
    std::ranges::sort(wishes);
    double inverse = 0, finest = std::numeric_limits<double>::infinity();
    int meshes = 0;
    for (std::size_t i = 0; i < wishes.size(); ++meshes) {
      double sum = 0;
      int n = 0;
      for (const std::uint32_t mesh = wishes[i].first; i < wishes.size() && wishes[i].first == mesh; ++i)
        sum += wishes[i].second, ++n;
      inverse += n / sum;
      finest = std::min(finest, sum / n);
    }
    return std::min(meshes / inverse, options.finer_share * finest);
  }
};

namespace {

using Data = SizeField::Data;

class Builder {
 public:
  /// `edges`: of `complex`; `data` has its options and own sizes.
  Builder(const Complex& original, const Complex& complex, const EdgeTable& edges, const Brep& brep, Data& data)
      : original_(original), complex_(complex), brep_(brep), data_(data), edges_(edges), originals_(original) {}

  void build() {
    data_.sheets = sheets_at_curves(brep_);
    for (const auto& sheets : data_.sheets) {
      auto& components = data_.components.emplace_back();
      for (const SheetId s : sheets)
        components.push_back(complex_.component[brep_.sheets[s.value].faces.front().value]);
    }
    data_.kept.resize(brep_.curves.size());
    for (std::size_t f = 0; f < data_.options.kept.size(); ++f)
      for (const CurveId c : brep_.curve_of_edge[f])
        if (c.valid() && data_.options.kept[f]) data_.kept[c.value] = brep_.sheet_of_face[f];
    std::vector<SizeLimit> limits = junction();
    data_.junction = SizeLimits(limits, data_.options.gradation);
    set(limits);
    for (std::size_t c = 0; c < brep_.curves.size(); ++c) data_.slack.push_back(slack(CurveId(c)));

    // Each step knows the limits of the steps before it and asks for what they leave out.
    add(limits, fine_curves());
    const auto at = [&](SheetId s, Vec3 p) { return data_.at(s, p); };
    const auto plain = [&](SheetId s, Vec3 p) { return data_.plain(s, p); };
    add(limits, narrow_places(complex_, brep_, data_.options, at, plain));
    add(limits, bends());
  }

 private:
  void add(std::vector<SizeLimit>& limits, const std::vector<SizeLimit>& more) {
    if (more.empty()) return;
    limits.insert(limits.end(), more.begin(), more.end());
    set(limits);
  }

  /// Limits as large as all sizes limit nothing; without them a search ends at once.
  void set(std::vector<SizeLimit>& limits) {
    double largest = 0;
    for (const OwnSize& own : data_.own) largest = std::max(largest, own.largest());
    std::erase_if(limits, [&](const SizeLimit& l) { return std::min(l.at_a, l.at_b) * kSame >= largest; });
    data_.limits = SizeLimits(limits, data_.options.gradation);
  }

  [[nodiscard]] std::vector<Vec3> points(const Curve& curve) const {
    std::vector<Vec3> result;
    for (const VertexId v : curve.chain) result.push_back(complex_.position[v.value]);
    return result;
  }

  [[nodiscard]] std::vector<SizeLimit> junction() const {
    std::vector<SizeLimit> result;
    for (std::size_t c = 0; c < brep_.curves.size(); ++c) {
      if (!brep_.curves[c].junction) continue;
      const std::vector<Vec3> p = points(brep_.curves[c]);
      const auto l = collected<double>(
          p.size(),
          [&](std::size_t i, std::vector<double>& out) { out.push_back(data_.mean_at_junction(CurveId(c), p[i])); },
          kSizeBlock);
      for (std::size_t i = 1; i < p.size(); ++i) result.push_back({p[i - 1], p[i], l[i - 1], l[i]});
    }
    return result;
  }

  [[nodiscard]] double slack(CurveId c) const {
    const Curve& curve = brep_.curves[c.value];
    if (!curve.junction || curve.free) return 0;
    const auto sizes = collected<double>(
        curve.chain.size(),
        [&](std::size_t i, std::vector<double>& out) {
          out.push_back(data_.plain_on_curve(c, complex_.position[curve.chain[i].value]));
        },
        kSizeBlock);
    const double share = curve.border ? data_.options.border_slack : data_.options.junction_slack;
    return share * *std::ranges::min_element(sizes);
  }

  /// Curves that the input divides more finely than their sheets, or that are short between corners.
  [[nodiscard]] std::vector<SizeLimit> fine_curves() const {
    std::vector<SizeLimit> result;
    for (std::size_t c = 0; c < brep_.curves.size(); ++c) {
      const Curve& curve = brep_.curves[c];
      const std::vector<Vec3> p = points(curve);
      const double length = curve.closed ? std::numeric_limits<double>::infinity() : arc_lengths(p).back();
      const auto fine = collected<SizeLimit>(
          p.size() - 1,
          [&](std::size_t i, std::vector<SizeLimit>& out) {
            if (is_frozen_edge(complex_, curve.chain[i], curve.chain[i + 1])) return;
            const double around = data_.on_curve(CurveId(c), midpoint(p[i], p[i + 1]));
            const double floor = data_.options.gap_floor * around;
            const double size = std::max(floor, std::min(length, input_spacing(curve, i + 1)));
            if (size < kWorthALimit * around) out.push_back({p[i], p[i + 1], size, size});
          },
          kSizeBlock);
      result.insert(result.end(), fine.begin(), fine.end());
    }
    return result;
  }

  /// Places that the ruler spaces more finely than the sizes so far, for the shape of the curve.
  [[nodiscard]] std::vector<SizeLimit> bends() const {
    RulerOptions ruler;
    ruler.gradation = data_.options.gradation;
    std::vector<SizeLimit> result;
    for (std::size_t c = 0; c < brep_.curves.size(); ++c) {
      const Curve& curve = brep_.curves[c];
      const std::vector<Vec3> p = points(curve);
      if (curve.fixed || total_turn(p) < kStraight) continue;
      ruler.slack = data_.slack[c], ruler.max_sagitta = curve.max_sagitta();
      const auto size = [&](double, Vec3 at) { return data_.on_curve(CurveId(c), at); };
      const std::vector<double> arc = arc_lengths(p), nodes = resampled(p, curve.closed, size, ruler);
      for (std::size_t i = 1; i < nodes.size(); ++i) {
        const Vec3 a = point_at(p, arc, nodes[i - 1]), b = point_at(p, arc, nodes[i]);
        const double piece = nodes[i] - nodes[i - 1], around = size(0, midpoint(a, b));
        if (piece >= kBend * around) continue;
        const double allowed =
            std::max(piece, data_.options.gap_floor * data_.plain_on_curve(CurveId(c), midpoint(a, b)));
        result.push_back({a, b, allowed, allowed});
      }
    }
    return result;
  }

  /// Length of the input edge that an edge of a curve is a part of; infinite on a junction.
  [[nodiscard]] double input_spacing(const Curve& curve, std::size_t i) const {
    if (curve.junction) return std::numeric_limits<double>::infinity();
    const VertexId a = curve.chain[i - 1], b = curve.chain[i];
    const FaceId face = edges_.uses(edges_.find(a, b)).front().face;
    const FaceId parent = originals_.find(complex_.parent[face.value]);
    if (!parent.valid()) return std::numeric_limits<double>::infinity();
    const Triangle t = original_.corners(parent);
    const Vec3 middle = midpoint(complex_.position[a.value], complex_.position[b.value]);
    double length = 0, nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = t[k], to = t[(k + 1) % 3];
      const double d = squared_norm(middle - closest_on_segment(middle, from, to).point);
      if (d < nearest) nearest = d, length = distance(from, to);
    }
    return length;
  }

  const Complex& original_;
  const Complex& complex_;
  const Brep& brep_;
  Data& data_;
  const EdgeTable& edges_;
  const OriginalFaces originals_;
};

}  // namespace

SizeField::SizeField(const Complex& original, const Complex& complex, const Brep& brep, const SizeOptions& options) {
  auto data = std::make_shared<Data>();
  data->options = options;
  std::optional<EdgeTable> edges;
  tbb::parallel_invoke([&] { data->own = own_sizes(original, complex, brep, options.max_height, options.stretched); },
                       [&] { edges.emplace(complex); });
  Builder(original, complex, *edges, brep, *data).build();
  data_ = std::move(data);
}

double SizeField::at(SheetId sheet, Vec3 p) const { return data_->at(sheet, p); }
double SizeField::on_curve(CurveId curve, Vec3 p) const { return data_->on_curve(curve, p); }
double SizeField::slack(CurveId curve) const { return data_->slack[curve.value]; }
double SizeField::gradation() const { return data_->options.gradation; }

NearJunction SizeField::junction(Vec3 p) const {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const auto near = data_->junction.nearest(p, kAnywhere);
  return near.found ? NearJunction{near.distance, near.size} : NearJunction{kAnywhere, kAnywhere};
}

}  // namespace meshgraft
