#include "intersect/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/distinct.hpp"
#include "core/union_find.hpp"
#include "geometry/angles.hpp"
#include "geometry/quality.hpp"
#include "intersect/flat_faces.hpp"
#include "intersect/follow.hpp"
#include "intersect/links.hpp"
#include "intersect/lying.hpp"
#include "intersect/stacks.hpp"
#include "intersect/whole_edges.hpp"

namespace meshgraft {
namespace {

constexpr double kLargestFold = radians(75);  // from which faces are always two surfaces

std::array<VertexId, 2> edge_of(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Faces joined across edges that are neither walls nor folds; the smallest position in `faces` stands for the region.
/// `normal`: by position, of the face that each was cut out of. `fold_angle`: of the least fold.
UnionFind regions(const Complex& complex, std::span<const FaceId> faces, std::span<const Vec3> normal,
                  const std::vector<std::array<VertexId, 2>>& walls, double fold_angle) {
  std::vector<std::pair<std::array<VertexId, 2>, std::uint32_t>> uses;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const auto& v = complex.face[faces[i].value];
    for (std::size_t k = 0; k < 3; ++k) uses.emplace_back(edge_of(v[k], v[(k + 1) % 3]), i);
  }
  std::ranges::sort(uses);
  UnionFind joined(faces.size());
  for (std::size_t i = 1; i < uses.size(); ++i)
    if (uses[i].first == uses[i - 1].first &&
        std::abs(dot(normal[uses[i].second], normal[uses[i - 1].second])) > std::cos(fold_angle) &&
        !std::ranges::binary_search(walls, uses[i].first))
      joined.unite(uses[i - 1].second, uses[i].second);
  return joined;
}

class Overlayer {
 public:
  Overlayer(Complex& complex, GroupSets& groups, FaceMarks& marks, const Sides& sides, const SnapRule& snap,
            const CorefineOptions& options)
      : complex_(complex), groups_(groups), marks_(marks), sides_(sides), rule_{options, snap} {}

  tl::expected<Overlaid, ImprintFault> run() {
    unbent_ = unbent_faces(complex_, marks_, rule_.snap);
    Contacts contacts =
        find_contacts(complex_, sides_.faces[0], sides_.faces[1], marks_.size, rule_, marks_.reach, unbent_);
    if (std::find(contacts.on_each_other.begin(), contacts.on_each_other.end(), 1) == contacts.on_each_other.end())
      return Overlaid{};
    if (auto fault = find_two_layers(complex_, unbent_, contacts)) return failed(std::move(*fault));
    out_.behind = take_out_behind(complex_, unbent_, contacts);
    component_before_ = complex_.component;
    gaps_before_.assign(complex_.n_faces(), 1);
    for (std::size_t f = 0; f < marks_.over.size(); ++f) gaps_before_[f] += marks_.over[f].size();

    LyingMeeting l{make_meeting(complex_, groups_, marks_.size, {}, rule_.snap, contacts.pairs, sides_.own[0],
                                sides_.own[1], {fold_angle(), rule_.options.ends_on_borders}, faces_beside(contacts)),
                   rule_,
                   rule_.options.overlap == Overlap::kKeepPart ? 1u : 0u,
                   takes_over(),
                   marks_.reach,
                   unbent_,
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
    l.rims = sides_.rims;
    set_up(l, contacts);
    find_imprinted(l);
    declare_lying(l);
    if (auto fault = trace_imprinted(l)) return failed(std::move(*fault));
    const std::array<Imprint, 2> imprint = imprint_of(l);
    const UncutFaces before{complex_.face, marks_.touched};
    std::vector<CutEdge> cut_in_vain = takes_over() ? std::vector<CutEdge>{} : edges_cut_in_vain(l);
    if (auto fault = apply(l.meeting, imprint, marks_)) {
      if (fault->face.valid()) fault->face = marks_.from[fault->face.value];
      return tl::unexpected(std::move(*fault));
    }
    out_.any = true;
    on_both_.assign(complex_.n_vertices(), 0);
    for (const Symbol& symbol : l.meeting.symbols) on_both_[symbol.vertex.value] = 1;
    move_vertices(l);
    // Slivers beside the border lose their area where their corners move onto it. What is left beside a corner
    // of the border is flatter than what is snapped.
    take_out_flat(l, [&](double) { return rule_.snap.noise(); });
    take_out(l);
    take_out_flat(l, [&](double size) { return rule_.beside(size); });
    let_go_of_bare(l, cut_in_vain);
    out_.traded = take_out_points(complex_, marks_, cut_in_vain, before);
    let_neighbours_follow(complex_, marks_, faces_of(l.goes()), out_.moved);
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool takes_over() const {
    return rule_.options.overlap == Overlap::kFuse || rule_.options.overlap == Overlap::kProject;
  }

  /// Folds that faces lying on one surface may have between them, as those of a coarse pipe, are none of that surface.
  [[nodiscard]] double fold_angle() const {
    const double contact = rule_.options.contact_angle, sharp = rule_.options.sharp_angle;
    return contact <= sharp ? sharp : std::min(2 * contact, kLargestFold);
  }

  static tl::unexpected<ImprintFault> failed(JunctionFault fault) {
    return tl::unexpected(ImprintFault{std::move(fault), {}});
  }

  /// Faces of both sides that have an edge with a face in contact: what is imprinted on the edge cuts
  /// them too.
  [[nodiscard]] std::array<std::vector<FaceId>, 2> faces_beside(const Contacts& contacts) const {
    std::array<std::vector<FaceId>, 2> beside;
    for (const std::size_t s : kSides) {
      std::vector<std::uint8_t> near(complex_.n_vertices());
      for (const auto& pair : contacts.pairs)
        for (const VertexId v : complex_.face[pair[s].value]) near[v.value] = 1;
      for (const FaceId f : sides_.faces[s]) {
        const auto& v = complex_.face[f.value];
        if (near[v[0].value] + near[v[1].value] + near[v[2].value] >= 2) beside[s].push_back(f);
      }
    }
    return beside;
  }

  void set_up(LyingMeeting& l, const Contacts& contacts) const {
    for (const std::size_t s : kSides) {
      l.meeting.chart[s] = complex_.position;
      l.is_flat[s].assign(l.meeting.side[s].n_faces(), 0);
      l.in_contact[s].assign(l.meeting.side[s].n_faces(), 0);
    }
    for (std::size_t i = 0; i < contacts.pairs.size(); ++i) {
      for (const std::size_t s : kSides) l.is_flat[s][l.meeting.pairs[i][s]] = 1;
      if (!contacts.on_each_other[i]) continue;
      l.pairs.push_back(l.meeting.pairs[i]);
      for (const std::size_t s : kSides) l.in_contact[s][l.meeting.pairs[i][s]] = 1;
    }
    draw_together(l);
    for (const std::size_t s : kSides) build_cover(l, s);
  }

  static std::array<Imprint, 2> imprint_of(const LyingMeeting& l) {
    std::array<Imprint, 2> imprint = collect_points(l.meeting);
    for (const std::size_t s : kSides) {
      imprint[s].segments = l.segments[s];
      make_distinct(imprint[s].segments);
      for (const Symbol& symbol : l.meeting.symbols) touch(l.meeting, symbol, s, imprint[s].touched);
    }
    return imprint;
  }

  static void touch(const Meeting& m, const Symbol& symbol, std::size_t s, std::vector<std::uint8_t>& touched) {
    const Carrier& on = symbol.on[s];
    if (on.kind == Carrier::kFace) touched[on.id] = 1;
    if (on.kind == Carrier::kEdge)
      for (const LocalFace f : m.side[s].faces_at_edge(on.id)) touched[f] = 1;
  }

  /// What both sides have lies in the surface that stays.
  void move_vertices(const LyingMeeting& l) {
    for (const Symbol& symbol : l.meeting.symbols) {
      Vec3& position = complex_.position[symbol.vertex.value];
      const Vec3 to = l.at(l.stays, symbol.vertex);
      if (distance(position, to) <= rule_.snap.noise()) continue;
      out_.moved.emplace_back(symbol.vertex, position);
      position = to;
    }
    out_.replaced = l.meeting.replaced;
  }

  /// Takes out the pieces on the border of the side that goes that are no higher than `height` of their size.
  template <class F>
  void take_out_flat(const LyingMeeting& l, F&& height) {
    std::vector<double> heights;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f) {
      const bool may_go = is_on_both(f) && l.meeting.side[l.goes()].find(marks_.from[f]) != kNowhere;
      heights.push_back(may_go ? height(marks_.size[f]) : -1);
    }
    take_out_flat_faces(complex_, marks_, heights, rule_.snap.noise());
  }

  /// All corners of a face lie on both sides.
  [[nodiscard]] bool is_on_both(std::size_t f) const {
    return std::ranges::all_of(complex_.face[f], [&](VertexId v) { return on_both_[v.value] != 0; });
  }

  /// The faces that were in contact, or what they were cut into; and those that came onto the other side only
  /// where features were snapped to it.
  struct Pieces {
    std::vector<FaceId> faces;          // ascending
    std::vector<std::uint8_t> covered;  // by position: lies on the other side
    [[nodiscard]] std::size_t size() const { return faces.size(); }
  };

  [[nodiscard]] Pieces pieces(const LyingMeeting& l, std::size_t s) const {
    Pieces p;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f) {
      const LocalFace from = l.meeting.side[s].find(marks_.from[f]);
      if (from != kNowhere && (l.in_contact[s][from] || (l.is_flat[s][from] && is_on_both(f))))
        p.faces.push_back(FaceId(f));
    }
    return p;
  }

  [[nodiscard]] Triangle chart_triangle(const LyingMeeting& l, std::size_t s, FaceId f) const {
    const auto& v = complex_.face[f.value];
    return {l.at(s, v[0]), l.at(s, v[1]), l.at(s, v[2])};
  }

  /// The middle of a piece of side s, in the chart of the other side if it knows all corners: what was snapped
  /// lies apart in the two.
  [[nodiscard]] Vec3 middle(const LyingMeeting& l, std::size_t s, FaceId f) const {
    return centroid(chart_triangle(l, is_on_both(f.value) ? 1 - s : s, f));
  }

  /// A region lies on `cover` if most of its area does.
  void classify(const LyingMeeting& l, std::size_t s, const Cover& cover, Pieces& p) const {
    std::vector<Vec3> normal;
    for (const FaceId f : p.faces) normal.push_back(l.normal(s, l.meeting.side[s].find(marks_.from[f.value])));
    UnionFind region = regions(complex_, p.faces, normal, l.walls, fold_angle());
    std::vector<double> vote(p.size(), 0);
    for (std::uint32_t i = 0; i < p.size(); ++i) {
      const Triangle t = chart_triangle(l, s, p.faces[i]);
      vote[region.find(i)] += cover.covers(middle(l, s, p.faces[i]), normal[i], rule_) ? area(t) : -area(t);
    }
    p.covered.resize(p.size());
    for (std::uint32_t i = 0; i < p.size(); ++i) p.covered[i] = vote[region.find(i)] > 0;
  }

  void take_out(const LyingMeeting& l) {
    Pieces going = pieces(l, l.goes()), staying = pieces(l, l.stays);
    classify(l, l.goes(), l.cover[l.stays], going);
    take_doubled(l, going);

    std::vector<FaceId> covered;
    std::vector<Triangle> triangles;
    std::vector<double> sizes;
    std::vector<Vec3> normals;
    std::vector<std::array<VertexId, 3>> corners;
    for (std::size_t i = 0; i < going.size(); ++i) {
      if (!going.covered[i]) continue;
      covered.push_back(going.faces[i]);
      triangles.push_back(chart_triangle(l, l.goes(), going.faces[i]));
      sizes.push_back(marks_.size[going.faces[i].value]);
      normals.push_back(unit_normal(unbent_[marks_.from[going.faces[i].value].value]));
      corners.push_back(complex_.face[going.faces[i].value]);
    }
    const Cover cover(triangles, sizes, normals, corners);
    classify(l, l.stays, cover, staying);
    for (std::size_t i = 0; i < covered.size(); ++i) {
      const std::uint32_t foot = l.cover[l.stays].foot(middle(l, l.goes(), covered[i])).face;
      const FaceId on = l.meeting.side[l.stays].face(l.cover_face[l.stays][foot]);
      out_.covered.push_back({complex_.parent[covered[i].value], area(triangles[i]), area_there(l, covered[i]),
                              takes_over(), complex_.component[covered[i].value], component_before_[on.value],
                              gaps_before_[on.value]});
    }
    for (std::size_t i = 0; i < staying.size(); ++i) {
      const FaceId f = staying.faces[i];
      const Vec3 at = middle(l, l.stays, f);
      if (takes_over()) {
        if (staying.covered[i]) unite(l, f, covered[cover.foot(at).face]);
        continue;
      }
      // Free edges of what went are not imprinted, and end none of its regions: each face lies there for itself.
      const bool is_beneath =
          cover.covers(at, l.normal(l.stays, l.meeting.side[l.stays].find(marks_.from[f.value])), rule_);
      if (is_beneath || staying.covered[i]) keep(f);
      if (is_beneath) record(l, f, covered[cover.foot(at).face]);
    }
    remove(covered);
  }

  /// Where the border of what bears the side that goes has a notch, a piece has come to lie on all corners of a face
  /// in it, however far it was from that.
  void take_doubled(const LyingMeeting& l, Pieces& going) const {
    const auto ascending = [&](std::size_t f) {
      std::array<VertexId, 3> v = complex_.face[f];
      std::ranges::sort(v);
      return v;
    };
    std::vector<std::array<VertexId, 3>> staying;
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      if (is_on_both(f) && sides_.own[l.stays][marks_.from[f].value]) staying.push_back(ascending(f));
    std::ranges::sort(staying);
    for (std::size_t i = 0; i < going.size(); ++i)
      if (std::ranges::binary_search(staying, ascending(going.faces[i].value))) going.covered[i] = 1;
  }

  /// Area of a face of the side that goes between the places of its corners on the other.
  [[nodiscard]] double area_there(const LyingMeeting& l, FaceId f) const {
    Triangle there;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = complex_.face[f.value][k];
      there[k] = on_both_[v.value] ? l.at(l.stays, v) : l.cover[l.stays].foot(l.at(l.goes(), v)).point;
    }
    return area(there);
  }

  /// Edges of the side that is kept where mere edges of the other mesh cross them: those end on the nodes that are
  /// there. Features, borders of groups and nodes of their own need a node of the edge.
  [[nodiscard]] std::vector<CutEdge> edges_cut_in_vain(const LyingMeeting& l) const {
    const std::size_t s = l.stays, o = l.goes();
    const Side &side = l.meeting.side[s], &other = l.meeting.side[o];
    std::vector<std::tuple<LocalEdge, double, VertexId, std::uint8_t>> points;
    for (const Symbol& symbol : l.meeting.symbols) {
      if (symbol.on[s].kind != Carrier::kEdge) continue;
      const Carrier& on = symbol.on[o];
      const VertexId v(std::size_t{on.id});
      const bool may_go = on.kind == Carrier::kEdge
                              ? !other.is_feature_edge(on.id) && !is_border_of_groups(l, o, on.id)
                              : on.kind == Carrier::kVertex && !other.is_feature(v) && !is_single_group_node(l, o, v) &&
                                    !is_on_border_of_groups(l, o, v);
      points.emplace_back(symbol.on[s].id, symbol.on[s].t, symbol.vertex, may_go ? 1 : 0);
    }
    std::ranges::sort(points);
    const auto name = [&](VertexId end) {
      return l.meeting.has_symbol(s, end) ? l.meeting.symbols[l.meeting.symbol_of[s][end.value]].vertex : end;
    };
    std::vector<CutEdge> edges;
    for (std::size_t i = 0; i < points.size();) {
      const LocalEdge e = std::get<0>(points[i]);
      CutEdge edge{{name(side.ends(e)[0])}, {0}};
      for (; i < points.size() && std::get<0>(points[i]) == e; ++i)
        edge.chain.push_back(std::get<2>(points[i])), edge.may_go.push_back(std::get<3>(points[i]));
      edge.chain.push_back(name(side.ends(e)[1])), edge.may_go.push_back(0);
      edges.push_back(std::move(edge));
    }
    return edges;
  }

  /// Nor does the side that is kept need a node, whatever it is there, where nothing is left of the other.
  void let_go_of_bare(const LyingMeeting& l, std::vector<CutEdge>& edges) const {
    std::vector<std::uint8_t> is_needed(complex_.n_vertices());
    for (std::size_t f = 0; f < complex_.n_faces(); ++f)
      if (sides_.own[l.goes()][marks_.from[f].value])
        for (const VertexId v : complex_.face[f]) is_needed[v.value] = 1;
    for (CutEdge& edge : edges)
      for (std::size_t i = 1; i + 1 < edge.chain.size(); ++i) {
        const std::size_t v = edge.chain[i].value;
        if (!is_needed[v] && complex_.state[v] == VertexState::kOpen) edge.may_go[i] = 1;
      }
  }

  /// By face as they are now: of a side.
  [[nodiscard]] std::vector<std::uint8_t> faces_of(std::size_t s) const {
    std::vector<std::uint8_t> own;
    for (const FaceId from : marks_.from) own.push_back(sides_.own[s][from.value]);
    return own;
  }

  /// A face that stays, and the one that lies on it and goes.
  void unite(const LyingMeeting& l, FaceId f, FaceId g) {
    marks_.touched[f.value] = 1;
    extend_reach(l, f, g);
    const std::uint32_t going = complex_.component[g.value];
    complex_.layers.resize(complex_.n_faces());
    Complex::Layers& layers = complex_.layers[f.value];
    layers.insert(layers.end(), complex_.layers[g.value].begin(), complex_.layers[g.value].end());
    layers.push_back(
        {going, complex_.parent[g.value], complex_.face_groups[g.value], complex_.face_attributes[g.value]});
    std::ranges::sort(layers);
    complex_.face_groups[f.value] = groups_.unite(complex_.face_groups[f.value], complex_.face_groups[g.value]);
    for (const std::uint32_t component : complex_.components_of(g)) join_node_groups(l, f, g, component);
  }

  /// The vertices of a face are in the groups that all corners of the one on it are in.
  void join_node_groups(const LyingMeeting& l, FaceId f, FaceId g, std::uint32_t component) {
    const LocalFace from = l.meeting.side[l.goes()].find(marks_.from[g.value]);
    GroupSetId common;
    for (const VertexId v : l.meeting.side[l.goes()].corners(from)) {
      const GroupSetId own = complex_.groups_on(component, v);
      common = common.valid() ? groups_.intersect(common, own) : own;
    }
    for (const VertexId v : complex_.face[f.value])  // those with a symbol have their own, or have got them with it
      if (!on_both_[v.value]) complex_.join_groups(v, component, common, groups_);
  }

  void keep(FaceId f) {
    marks_.kept.resize(complex_.n_faces());
    marks_.kept[f.value] = 1;
  }

  /// That a face, and what lay on that, lay on another one.
  void record(const LyingMeeting& l, FaceId f, FaceId g) {
    extend_reach(l, f, g);
    marks_.over.resize(complex_.n_faces());
    std::vector<std::uint32_t>& over = marks_.over[f.value];
    over.push_back(complex_.component[g.value]);
    over.insert(over.end(), marks_.over[g.value].begin(), marks_.over[g.value].end());
    make_distinct(over);
  }

  void extend_reach(const LyingMeeting& l, FaceId f, FaceId g) {
    const Triangle on = chart_triangle(l, l.stays, f);
    const Triangle& going = unbent_[marks_.from[g.value].value];
    const double height = height_above(on, going);
    Reach of_going = marks_.reach.empty() ? Reach{} : marks_.reach[g.value];
    if (dot(area_vector(on), area_vector(going)) < 0) of_going = of_going.turned();
    if (std::abs(height) <= rule_.weld(marks_.size[f.value]) && of_going == Reach{}) return;
    marks_.reach.resize(complex_.n_faces());
    marks_.reach[f.value].add({height + of_going.low, height + of_going.high});
  }

  void remove(std::vector<FaceId> gone) {
    std::sort(gone.begin(), gone.end());
    Complex old;
    complex_.swap_faces(old);
    FaceMarks marks;
    for (std::size_t f = 0; f < old.face.size(); ++f) {
      if (std::binary_search(gone.begin(), gone.end(), FaceId(f))) continue;
      complex_.add_face(old.face[f], old, FaceId(f));
      marks.add(marks_, f);
    }
    marks_ = std::move(marks);
  }

  Complex& complex_;
  GroupSets& groups_;
  FaceMarks& marks_;
  const Sides& sides_;
  ContactRule rule_;
  std::vector<Triangle> unbent_;                 // by face, before any is cut
  std::vector<std::uint32_t> component_before_;  // by face, before any is cut
  std::vector<std::size_t> gaps_before_;         // the same: to what is laid on it, see Corefined::Covered
  std::vector<std::uint8_t> on_both_;            // by vertex: it has a symbol
  Overlaid out_;
};

}  // namespace

tl::expected<Overlaid, ImprintFault> overlay(Complex& complex, GroupSets& groups, FaceMarks& marks, const Sides& sides,
                                             const SnapRule& snap, const CorefineOptions& options) {
  return Overlayer(complex, groups, marks, sides, snap, options).run();
}

}  // namespace meshgraft
