#include "intersect/join.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/distinct.hpp"
#include "geometry/quality.hpp"
#include "intersect/doubled.hpp"
#include "intersect/extend.hpp"
#include "intersect/open_gaps.hpp"
#include "intersect/overlap.hpp"
#include "intersect/overlay.hpp"
#include "intersect/pockets.hpp"
#include "intersect/rims.hpp"

namespace meshgraft {
namespace {

/// Bending side 1 to side 0 by up to the tolerance can make it meet side 0 anew. Later rounds look
/// at what is there then, without tolerance, until nothing new is found. Where no gap was closed,
/// nothing was bent and one round is enough.
constexpr int kMaxRounds = 6;
constexpr int kMaxAttempts = 16;  // faces at which gaps are given up, per component

class Joiner {
 public:
  Joiner(Joining& joining, std::uint32_t component, double largest, GroupSets& groups, const CorefineOptions& options,
         const std::function<std::optional<std::string>()>& advice)
      : joining_(joining),
        complex_(joining.complex),
        marks_(joining.marks),
        component_(component),
        largest_(largest),
        groups_(groups),
        options_(options),
        advice_(advice) {}

  /// Where details smaller than the tolerance make a face impossible to cut along what was declared on
  /// it, the gaps at that face are left as they are, and then those at the faces around it.
  std::optional<JunctionFault> run() {
    const Joining before = joining_;
    std::vector<std::uint8_t> exact(before.complex.n_faces());
    for (int attempt = 0;; ++attempt) {
      auto failed = all_rounds(exact);
      if (!failed) break;
      if (!failed->face.valid() || attempt == kMaxAttempts || !make_exact(before.complex, failed->face, exact))
        return std::move(failed->fault);
      joining_ = before;
      moved_from_.clear(), bends_.clear(), half_reached_.clear();
    }
    for (const auto& [y, x] : joining_.replaced) std::erase(bends_, y);
    for (const VertexId v : bends_)
      if (VertexState& state = complex_.state[v.value]; state == VertexState::kOpen) state = VertexState::kPinned;
    joining_.moved.assign(moved_from_.begin(), moved_from_.end());
    return std::nullopt;
  }

 private:
  std::optional<ImprintFault> all_rounds(std::vector<std::uint8_t> exact) {
    if (options_.mode != Mode::kFaceEdge)
      if (auto failed = lay_over(exact)) return failed;
    const bool extended = extend(exact);
    settled_ = false;
    for (int round = 0; !settled_ && round < kMaxRounds; ++round) {
      if (auto failed = meet(round, round == 0 ? exact : std::span<const std::uint8_t>{})) return failed;
      if (round == 0 && extended) settled_ = false;
    }
    if (settled_) {
      if (options_.leaves_pockets) return std::nullopt;
      const std::vector<Pocket> pockets = find_pockets(complex_, active_faces(), marks_.size);
      if (pockets.empty()) return std::nullopt;
      // Closing gaps leaves flat ones beside it.
      const Pocket& deepest = *std::ranges::max_element(pockets, {}, &Pocket::depth);
      const FaceId face = deepest.faces[1].front();
      const bool is_flat = deepest.depth <= SnapRule(largest_, options_, true).at(marks_.size[face.value]).weld;
      return ImprintFault{with_advice(pocket_fault(complex_, marks_.size, deepest)),
                          is_flat ? marks_.from[face.value] : FaceId{}};
    }
    return ImprintFault{{ErrorCode::kJunctionNotResolved, "the meshes go on meeting in new places", {}, {}}, {}};
  }

  /// Where the sides lie on each other, one layer is taken out. `exact` follows the faces.
  std::optional<ImprintFault> lay_over(std::vector<std::uint8_t>& exact) {
    std::vector<std::uint32_t> behind;
    if (options_.ends_on_borders) draw_rims();
    if (auto fault = lay_over({active_faces(), owners(component_), joining_.rims}, exact, behind)) return fault;
    // The component lay between others: those go where it went.
    while (!behind.empty()) {
      const std::uint32_t next = behind.front();
      behind.erase(behind.begin());
      for (const std::uint32_t on : bearers())
        if (auto fault = lay_on(on, next, exact, behind)) return fault;
    }
    return std::nullopt;
  }

  /// Joins before this one may have laid the component on what it was beside, and it ends on what crosses both. What
  /// they have bent is steep only for closing a gap.
  void draw_rims() {
    std::array<std::vector<FaceId>, 2> faces = active_faces();
    std::erase_if(faces[0], [&](FaceId f) {
      const double cosine = dot(unit_normal(complex_.corners(f)), unit_normal(marks_.input[f.value]));
      return cosine < std::cos(options_.contact_angle);
    });
    const SnapRule snap(largest_, options_, true);
    const Extensions all = rim_extensions(complex_, component_, faces[1], faces[0], marks_.size, snap, options_);
    take(all);
    for (const Extension& e : all.moved) joining_.rims.push_back(e.vertex);
    make_distinct(joining_.rims);
  }

  /// The own components of the faces that the component is, or lay on.
  [[nodiscard]] std::vector<std::uint32_t> bearers() const {
    std::vector<std::uint32_t> all{component_};
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      if (any_on(FaceId(f), [&](std::uint32_t c) { return c == component_; })) all.push_back(complex_.component[f]);
    make_distinct(all);
    return all;
  }

  /// Of the components that lie on a face, or lay there.
  template <class F>
  [[nodiscard]] bool any_on(FaceId f, F&& is) const {
    return std::ranges::any_of(complex_.layers_of(f), is, &Complex::Layer::component) ||
           (!marks_.over.empty() && std::ranges::any_of(marks_.over[f.value], is));
  }

  std::optional<ImprintFault> lay_on(std::uint32_t a, std::uint32_t b, std::vector<std::uint8_t>& exact,
                                     std::vector<std::uint32_t>& behind) {
    const auto [low, high] = std::minmax(a, b);
    if (low == high || !complex_.joins.are_joined(low, high)) return std::nullopt;
    Sides sides{{}, owners(high), joining_.rims};
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      if (const std::uint32_t c = complex_.component[f]; c == low || c == high)
        sides.faces[c == high].push_back(FaceId(f));
    const std::vector<FaceId> before = std::exchange(marks_.from, identity(complex_.n_faces()));
    auto fault = lay_over(sides, exact, behind);
    for (FaceId& from : marks_.from) from = before[from.value];
    if (fault && fault->face.valid()) fault->face = before[fault->face.value];
    return fault;
  }

  static std::vector<FaceId> identity(std::size_t n) {
    std::vector<FaceId> all;
    for (std::size_t f = 0; f < n; ++f) all.emplace_back(f);
    return all;
  }

  std::optional<ImprintFault> lay_over(const Sides& sides, std::vector<std::uint8_t>& exact,
                                       std::vector<std::uint32_t>& behind) {
    auto overlaid = overlay(complex_, groups_, marks_, sides, SnapRule(largest_, options_, true), options_);
    if (!overlaid) return std::move(overlaid.error());
    if (!overlaid->any) return std::nullopt;
    behind.insert(behind.end(), overlaid->behind.begin(), overlaid->behind.end());
    std::vector<std::uint8_t> now;
    for (const FaceId from : marks_.from) now.push_back(exact[from.value]);
    exact = std::move(now);
    marks_.active.assign(complex_.n_faces(), 1);
    remember(overlaid->moved, overlaid->replaced);
    joining_.covered.insert(joining_.covered.end(), overlaid->covered.begin(), overlaid->covered.end());
    joining_.traded.insert(joining_.traded.end(), overlaid->traded.begin(), overlaid->traded.end());
    return std::nullopt;
  }

  /// Free edges that end short of the other side, or stick out beyond it, are brought there; those of
  /// earlier components too, but for the base. True if there are any.
  bool extend(std::span<const std::uint8_t> exact) {
    const std::array<std::vector<FaceId>, 2> faces = active_faces();
    const Joins& joins = complex_.joins;
    bool any = extend(component_, faces[0], exact);
    std::vector<std::uint32_t> earlier;
    for (const FaceId f : faces[0])
      if (const std::uint32_t c = complex_.component[f.value]; joins.mesh_of(c) != joins.mesh_of(0))
        earlier.push_back(c);
    make_distinct(earlier);
    for (const std::uint32_t c : earlier) any = extend(c, faces[1], exact) || any;
    return any;
  }

  bool extend(std::uint32_t component, std::span<const FaceId> other, std::span<const std::uint8_t> exact) {
    std::vector<FaceId> own;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      if (complex_.component[f] == component && marks_.active[f]) own.emplace_back(f);
    const std::vector<std::uint8_t> owns = faces_with(complex_, component);
    const SnapRule snap(largest_, options_, true);
    const Extensions all = extensions(complex_, own, other, owns, marks_.size, exact, {options_.tolerance, snap});
    take(all);
    half_reached_.insert(half_reached_.end(), all.last.begin(), all.last.end());
    joining_.half_reached.insert(joining_.half_reached.end(), all.half_reached.begin(), all.half_reached.end());
    return !all.moved.empty();
  }

  /// Moves the ends.
  void take(const Extensions& all) {
    for (const auto& [v, to] : all.moved) {
      moved_from_.emplace(v, complex_.position[v.value]);
      complex_.position[v.value] = to;
    }
    bends_.insert(bends_.end(), all.bends.begin(), all.bends.end());
  }

  /// One round. Sets settled_ if the sides do not meet anywhere anew. A fault names the face as it
  /// was before the first round.
  std::optional<ImprintFault> meet(int round, std::span<const std::uint8_t> exact) {
    const SnapRule rule(largest_, options_, round == 0);
    const std::array<std::vector<FaceId>, 2> faces = active_faces();
    const auto pairs = near_pairs(complex_, faces[0], faces[1], marks_.size, rule);
    settled_ = pairs.empty();
    if (settled_) return std::nullopt;
    const std::array<std::vector<std::uint8_t>, 2> own = owners(component_);
    Meeting m = make_meeting(complex_, groups_, marks_.size, exact, rule, pairs, own[0], own[1],
                             {options_.sharp_angle, options_.ends_on_borders});
    m.ends_on_borders = options_.ends_on_borders;
    m.half_reached = half_reached_;
    if (round == 0) m.extended_from = &moved_from_;
    declare_vertices(m);
    declare_edges(m);
    find_crossings(m);
    if (round == 0) {
      const auto open = find_open_gaps(m);
      joining_.left_open.insert(joining_.left_open.end(), open.begin(), open.end());
    }
    settled_ = (round > 0 || options_.mode == Mode::kFaceFace) && !has_news(m);
    if (settled_) return std::nullopt;
    if (options_.mode == Mode::kFaceFace) return ImprintFault{other_meeting(m), {}};
    remember(m.moved, m.replaced);
    joining_.joined_seams.insert(joining_.joined_seams.end(), m.seams.begin(), m.seams.end());
    const auto imprint = link_symbols(m, options_);
    if (!imprint) {
      // In the first round the inputs overlap; later it is something that bending has made.
      const FaceId g = m.side[1].face(imprint.error().faces[1]);
      JunctionFault fault = with_advice(overlap_fault(m, imprint.error().faces));
      return ImprintFault{std::move(fault), round == 0 ? FaceId{} : marks_.from[g.value]};
    }
    if (auto fault = find_flat_face(m, *imprint)) return fault;
    if (auto fault = apply(m, *imprint, marks_)) {
      if (!fault->face.valid()) return fault;
      if (fault->fault.code == ErrorCode::kJunctionNotResolved)
        if (auto doubled = doubled_faces_at(m, fault->face)) return ImprintFault{std::move(*doubled), {}};
      fault->face = marks_.from[fault->face.value];
      return fault;
    }
    joining_.sewn.insert(joining_.sewn.end(), m.sewn.begin(), m.sewn.end());
    if (auto doubled = find_doubled_face(complex_, marks_.active))
      return ImprintFault{std::move(doubled->first), marks_.from[doubled->second.value]};
    settled_ = !m.has_closed_gap;
    return std::nullopt;
  }

  /// Marks a face, or if it is marked already the unmarked ones that share a vertex with it. False
  /// if there are none.
  static bool make_exact(const Complex& complex, FaceId face, std::vector<std::uint8_t>& exact) {
    if (!exact[face.value]) {
      exact[face.value] = 1;
      return true;
    }
    bool any = false;
    const auto& v = complex.face[face.value];
    for (std::size_t f = 0; f < complex.n_faces(); ++f) {
      const auto& w = complex.face[f];
      if (exact[f] || std::find_first_of(w.begin(), w.end(), v.begin(), v.end()) == w.end()) continue;
      exact[f] = 1, any = true;
    }
    return any;
  }

  [[nodiscard]] std::array<std::vector<FaceId>, 2> active_faces() const {
    std::array<std::vector<FaceId>, 2> faces;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f) {
      const std::uint32_t c = complex_.component[f];
      if (marks_.active[f] &&
          (c == component_ || (joining_.rank[c] < joining_.rank[component_] && is_joined_with(FaceId(f)))))
        faces[c == component_].push_back(FaceId(f));
    }
    return faces;
  }

  [[nodiscard]] bool is_joined_with(FaceId f) const {
    const auto joined = [&](std::uint32_t c) { return complex_.joins.are_joined(c, component_); };
    return joined(complex_.component[f.value]) || any_on(f, joined);
  }

  /// The faces that count in telling features: what hangs together with a side and is not joined to it
  /// goes on beyond its own faces.
  [[nodiscard]] std::array<std::vector<std::uint8_t>, 2> owners(std::uint32_t second) const {
    std::array<std::vector<std::uint8_t>, 2> own{{{}, faces_with(complex_, second)}};
    for (const std::uint32_t c : complex_.component) own[0].push_back(c != second);
    return own;
  }

  /// Of surfaces that cross where they may be meant to be one.
  [[nodiscard]] JunctionFault with_advice(JunctionFault fault) const {
    if (options_.mode == Mode::kFaceEdge) return fault;
    auto advice = advice_();
    if (!advice) return fault;
    if (!fault.hint.empty()) *advice += "; else " + fault.hint;
    fault.hint = std::move(*advice);
    return fault;
  }

  /// The meshes meet elsewhere than where they lie on each other.
  static JunctionFault other_meeting(const Meeting& m) {
    const FacePair& p = m.pairs.front();
    return {ErrorCode::kUsage,
            "meshes cross or touch, and only faces that lie on each other are joined in mode face-face",
            {m.complex.parent[m.side[0].face(p[0]).value], m.complex.parent[m.side[1].face(p[1]).value]},
            m.at(m.symbols.front().vertex)};
  }

  /// True if there is more than the vertices that both sides have already.
  static bool has_news(const Meeting& m) {
    return std::any_of(m.symbols.begin(), m.symbols.end(), [](const Symbol& s) {
      return s.on[0].kind != Carrier::kVertex || s.on[1].kind != Carrier::kVertex || s.on[0].id != s.on[1].id;
    });
  }

  void remember(std::span<const std::pair<VertexId, Vec3>> moved, std::span<const std::array<VertexId, 2>> replaced) {
    for (const auto& [v, from] : moved) moved_from_.emplace(v, from);
    for (const auto& [y, x] : replaced) {
      moved_from_.erase(y);
      joining_.replaced.push_back({y, x});
    }
  }

  /// A face without area cannot be cut; such faces of the input are named before it is tried.
  [[nodiscard]] std::optional<ImprintFault> find_flat_face(const Meeting& m,
                                                           const std::array<Imprint, 2>& imprint) const {
    for (const std::size_t s : kSides)
      for (LocalFace f = 0; f < m.side[s].n_faces(); ++f) {
        const FaceId id = m.side[s].face(f);
        if (!imprint[s].touched[f] || marks_.touched[id.value]) continue;
        const Triangle t = m.triangle(s, f);
        const double longest = std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
        if (2 * area(t) <= longest * m.rule.at(marks_.size[id.value]).weld)
          return ImprintFault{{ErrorCode::kDegenerateFace,
                               "a face without area meets another mesh",
                               {complex_.parent[id.value]},
                               centroid(t)},
                              marks_.from[id.value]};
      }
    return std::nullopt;
  }

  Joining& joining_;
  Complex& complex_;  // of joining_, as are the marks
  FaceMarks& marks_;
  std::uint32_t component_;
  double largest_;
  GroupSets& groups_;
  const CorefineOptions& options_;
  const std::function<std::optional<std::string>()>& advice_;
  std::map<VertexId, Vec3> moved_from_;
  std::vector<VertexId> bends_, half_reached_;  // see Extensions
  bool settled_ = false;
};

}  // namespace

std::optional<JunctionFault> join(Joining& joining, std::uint32_t component, double largest, GroupSets& groups,
                                  const CorefineOptions& options,
                                  const std::function<std::optional<std::string>()>& advice) {
  return Joiner(joining, component, largest, groups, options, advice).run();
}

}  // namespace meshgraft
