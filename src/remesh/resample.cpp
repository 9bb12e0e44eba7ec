#include "remesh/resample.hpp"

#include <algorithm>
#include <cmath>

#include "core/blocks.hpp"
#include "geometry/closest.hpp"
#include "zone/ruler.hpp"

namespace meshgraft {
namespace {

constexpr double kLeastKept = 0.7, kMostKept = 1.4;  // spacing of input nodes that is left alone, share of the wanted
constexpr double kLeastHeld = 0.6;  // the same where it gives the shape; a junction may want 1.5 times the finer size
constexpr double kTurn = 1e-3;      // a node farther than this share of the chord of its neighbours from it is a turn
constexpr double kReuse = 0.1;      // a vertex nearer to a wanted node than this share of the spacing is it
constexpr double kReuseNode = 0.2;  // the same for a node of the input
constexpr std::size_t kSizeBlock = 64;  // places at which the size is asked for in one go
constexpr int kRemovalRounds = 4;       // a removal may have to wait for its neighbours

/// A vertex of a curve at its arc length, counted on through the start of a closed curve.
struct Knot {
  VertexId v;
  double arc = 0;
  bool keep = false;
};

class Resampler {
 public:
  Resampler(Editor& editor, const Complex& complex, const Brep& brep, const Sizing& sizing,
            std::span<const VertexId> loose)
      : editor_(editor), complex_(complex), brep_(brep), sizing_(sizing), loose_(loose) {}

  void run() {
    for (std::size_t c = 0; c < brep_.curves.size(); ++c)
      if (!brep_.curves[c].fixed && !editor_.reference().polyline(CurveId(c)).empty()) resample(CurveId(c));
    remove_superfluous();
  }

 private:
  [[nodiscard]] bool fixed(VertexId v) const { return editor_.mesh().vertex(v).fixed; }

  [[nodiscard]] bool is_input_node(VertexId v) const {
    return v.value < complex_.n_vertices() && complex_.node[v.value].valid();
  }

  /// Cuts the curve into portions between fixed vertices.
  void resample(CurveId c) {
    const auto& chain = brep_.curves[c.value].chain;
    const auto arcs = editor_.reference().arcs(c);
    const std::size_t n = chain.size() - 1;
    const bool loop = chain.front() == chain.back();
    const auto first_fixed =
        static_cast<std::size_t>(std::ranges::find_if(chain, [&](VertexId v) { return fixed(v); }) - chain.begin());
    const bool whole = first_fixed == chain.size();
    std::size_t start = 0;
    if (loop)
      start = whole ? std::size_t(std::min_element(chain.begin(), chain.end() - 1) - chain.begin()) : first_fixed;
    std::vector<Knot> portion;
    for (std::size_t k = 0; k <= n; ++k) {
      const std::size_t i = loop ? (start + k) % n : k;
      const double turns = loop && start + k >= n ? arcs[n] : 0;
      portion.push_back({chain[i], arcs[i] + turns});
      if (portion.size() < 2 || (!fixed(chain[i]) && k < n)) continue;
      resample_between_turns(c, portion, whole);
      portion.assign(1, portion.back());
      portion[0].keep = false;
    }
  }

  /// Lines of the inputs give them their shape: nodes at which one turns stay, unless they are too near to others for
  /// the wanted size, or a poor face needs them later.
  void resample_between_turns(CurveId c, std::vector<Knot>& knots, bool closed) {
    std::vector<Knot> portion{knots.front()};
    if (closed && turns(knots[0], knots[knots.size() - 2], knots[1])) editor_.hold(knots[0].v, true);
    for (std::size_t k = 1; k < knots.size(); ++k) {
      portion.push_back(knots[k]);
      if (k + 1 < knots.size()) {
        if (!turns(knots[k], knots[k - 1], knots[k + 1])) continue;
        const double room = kLeastHeld * sizing_.on_curve(c, position(knots[k]));
        if (knots[k].arc - portion[0].arc < room || knots.back().arc - knots[k].arc < room) continue;
        editor_.hold(knots[k].v, true);
      }
      resample(c, portion, closed && k + 1 == knots.size() && portion.size() == knots.size());
      portion.assign(1, knots[k]);
    }
  }

  [[nodiscard]] bool turns(const Knot& k, const Knot& before, const Knot& after) const {
    const Vec3 a = position(before), b = position(after);
    return is_input_node(k.v) && !std::ranges::binary_search(loose_, k.v) &&
           distance(position(k), closest_on_segment(position(k), a, b).point) > kTurn * distance(a, b);
  }
  [[nodiscard]] Vec3 position(const Knot& k) const { return complex_.position[k.v.value]; }

  void resample(CurveId c, std::vector<Knot>& knots, bool closed) {
    for (const FaceId f : editor_.mesh().faces_at(knots[0].v, knots[1].v))
      if (!editor_.mesh().face(f).in_zone) return;
    knots.front().keep = knots.back().keep = true;
    std::vector<std::size_t> anchors;  // the ends and the nodes of the inputs
    for (std::size_t k = 0; k < knots.size(); ++k)
      if (knots[k].keep || is_input_node(knots[k].v)) anchors.push_back(k);
    std::vector<std::uint8_t> bad(anchors.size() - 1);  // by gap between anchors
    for_blocks(
        bad.size(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t g = first; g < last; ++g) bad[g] = !well_spaced(c, knots[anchors[g]], knots[anchors[g + 1]]);
        },
        kSizeBlock);
    if (closed && std::ranges::count(bad, 1) > 0) std::ranges::fill(bad, std::uint8_t{1});
    std::vector<std::uint8_t> redo = bad;  // one gap more on either side, so that spacing can even out
    for (std::size_t g = 0; g + 1 < bad.size(); ++g) redo[g] |= bad[g + 1], redo[g + 1] |= bad[g];

    std::vector<double> wanted;
    for (std::size_t g = 0; g < redo.size(); ++g) {
      knots[anchors[g]].keep = knots[anchors[g]].keep || !redo[g] || (g > 0 && !redo[g - 1]);
      if (!redo[g]) continue;
      std::size_t h = g;
      while (h + 1 < redo.size() && redo[h + 1]) ++h;
      measure_out(c, std::span(knots).subspan(anchors[g], anchors[h + 1] - anchors[g] + 1), closed, wanted);
      if (h + 1 < redo.size()) knots[anchors[h + 1]].keep = true;
      g = h;
    }
    place(c, knots, wanted);
    for (const Knot& k : knots)
      if (!k.keep) superfluous_.push_back(k.v);
  }

  [[nodiscard]] bool well_spaced(CurveId c, const Knot& a, const Knot& b) const {
    const double middle = 0.5 * (a.arc + b.arc);
    const double share = (b.arc - a.arc) / sizing_.on_curve(c, editor_.reference().point(c, middle));
    return share >= kLeastKept && share <= kMostKept &&
           editor_.reference().sagitta(c, a.arc, b.arc) <=
               std::max(sizing_.slack(c), brep_.curves[c.value].max_sagitta() * (b.arc - a.arc));
  }

  /// Adds where the ruler wants nodes between the first and the last knot, both excluded.
  void measure_out(CurveId c, std::span<const Knot> knots, bool closed, std::vector<double>& wanted) const {
    std::vector<Vec3> polyline;
    for (const Knot& k : knots) polyline.push_back(position(k));
    RulerOptions ruler;
    ruler.slack = sizing_.slack(c), ruler.max_sagitta = brep_.curves[c.value].max_sagitta();
    const auto arcs = resampled(
        polyline, closed, [&](double, Vec3 p) { return sizing_.on_curve(c, p); }, ruler);
    for (std::size_t k = 1; k + 1 < arcs.size(); ++k) wanted.push_back(knots.front().arc + arcs[k]);
  }

  void place(CurveId c, std::vector<Knot>& knots, std::span<const double> wanted) {
    const auto spacings = collected<double>(
        wanted.size(),
        [&](std::size_t i, std::vector<double>& out) {
          out.push_back(sizing_.on_curve(c, editor_.reference().point(c, wanted[i])));
        },
        kSizeBlock);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const double arc = wanted[i], spacing = spacings[i];
      const auto after = std::ranges::lower_bound(knots, arc, {}, &Knot::arc);
      Knot* nearest = nullptr;
      const auto consider = [&](Knot& k) {
        const double share = is_input_node(k.v) ? kReuseNode : kReuse;
        const double d = std::abs(k.arc - arc);
        if (!k.keep && d < share * spacing && (nearest == nullptr || d < std::abs(nearest->arc - arc))) nearest = &k;
      };
      for (auto k = after; k != knots.end() && k->arc - arc < kReuseNode * spacing; ++k) consider(*k);
      for (auto k = after; k != knots.begin() && arc - (k - 1)->arc < kReuseNode * spacing; --k) consider(*(k - 1));
      if (nearest != nullptr) {
        nearest->keep = true;
        continue;
      }
      if (after == knots.begin() || after == knots.end() || after->arc == arc) continue;
      if (const auto v = editor_.split_curve((after - 1)->v, after->v, c, arc)) knots.insert(after, {*v, arc, true});
    }
  }

  void remove_superfluous() {
    for (int round = 0; round < kRemovalRounds && !superfluous_.empty(); ++round)
      std::erase_if(superfluous_, [&](VertexId v) { return editor_.remove(v); });
  }

  Editor& editor_;
  const Complex& complex_;
  const Brep& brep_;
  const Sizing& sizing_;
  std::span<const VertexId> loose_;
  std::vector<VertexId> superfluous_;
};

}  // namespace

void resample_curves(Editor& editor, const Complex& complex, const Brep& brep, const Sizing& sizing,
                     std::span<const VertexId> loose) {
  Resampler(editor, complex, brep, sizing, loose).run();
}

}  // namespace meshgraft
