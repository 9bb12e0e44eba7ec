#include "intersect/corefine.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/blocks.hpp"
#include "core/distinct.hpp"
#include "core/text.hpp"
#include "geometry/quality.hpp"
#include "intersect/assembly.hpp"
#include "intersect/component_pairs.hpp"
#include "intersect/follow.hpp"
#include "intersect/join.hpp"
#include "intersect/laying.hpp"
#include "intersect/rims.hpp"
#include "intersect/shared.hpp"
#include "intersect/thin_parts.hpp"

namespace meshgraft {
namespace {

double largest_coordinate(const Complex& complex) {
  double largest = 0;
  for (const Vec3 p : complex.position) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

std::vector<double> mean_edge_lengths(const Complex& complex) {
  std::vector<double> size(complex.n_faces());
  for_blocks(size.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) size[f] = mean_edge_length(complex.corners(FaceId(f)));
  });
  return size;
}

class Corefiner {
 public:
  Corefiner(const Complex& complex, GroupSets& groups, const CorefineOptions& options)
      : complex_(complex),
        groups_(groups),
        options_(options),
        largest_(largest_coordinate(complex)),
        size_(mean_edge_lengths(complex)),
        rank_(ranks_by_id(complex)),
        near_(near_faces(complex, size_, SnapRule(largest_, options, true), rank_)),
        assembly_(complex, size_) {}

  tl::expected<Corefined, JunctionFault> run() {
    if (auto fault = find_thin_parts(near_, options_)) return tl::unexpected(std::move(*fault));
    if (options_.ends_on_borders) draw_rims();
    std::vector<std::uint32_t> order(rank_.size());
    for (std::uint32_t component = 0; component < order.size(); ++component) order[rank_[component]] = component;
    for (const std::uint32_t component : order)
      if (auto fault = join_one(component)) return tl::unexpected(std::move(*fault));
    return result();
  }

 private:
  void draw_rims() {
    if (options_.mode == Mode::kFaceEdge) return;
    const SnapRule snap(largest_, options_, true);
    const Rims rims = find_rims(complex_, near_, size_, snap, options_);
    for (const auto& [v, to] : rims.extensions.moved) {
      if (const NodeRef node = complex_.node[v.value]; node.valid())
        out_.moves.push_back({node, v, complex_.position[v.value], to});
      assembly_.move(v, to);
      rims_.push_back(v);
    }
    make_distinct(rims_);
    bends_ = rims.extensions.bends;
    std::vector<std::uint32_t> rank = ranks(rank_.size(), rims.ends);
    if (rank == rank_) return;
    rank_ = std::move(rank);
    near_ = near_faces(complex_, size_, snap, rank_);
  }

  [[nodiscard]] std::optional<JunctionFault> find_thin_parts(std::span<const NearFaces> found,
                                                             const CorefineOptions& options) const {
    std::vector<std::vector<FaceId>> near(found.size());  // by component: its faces near others
    for (std::size_t c = 0; c < found.size(); ++c) {
      near[c].insert(near[c].end(), found[c].own.begin(), found[c].own.end());
      for (const FaceId f : found[c].earlier) near[complex_.component[f.value]].push_back(f);
    }
    const SnapRule snap(largest_, options, true);
    std::vector<std::optional<JunctionFault>> fault(near.size());
    tbb::parallel_for(std::size_t{0}, near.size(), [&](std::size_t c) {
      make_distinct(near[c]);
      fault[c] = find_thin_part(complex_, near[c], size_, {options, snap});
    });
    const auto first = std::ranges::find_if(fault, [](const auto& f) { return f.has_value(); });
    return first == fault.end() ? std::nullopt : std::move(*first);
  }

  [[nodiscard]] std::vector<VertexId> rims_in(const CutOut& part) const {
    std::vector<VertexId> rims;
    for (std::size_t v = 0; v < part.vertex.size(); ++v)
      if (std::ranges::binary_search(rims_, part.vertex[v])) rims.emplace_back(v);
    return rims;
  }

  /// Joins a component to all earlier ones, in what is around the places where they are near.
  std::optional<JunctionFault> join_one(std::uint32_t component) {
    const NearFaces& near = near_[component];
    if (near.own.empty()) return std::nullopt;
    std::vector<FaceId> faces;
    std::set_union(near.own.begin(), near.own.end(), near.earlier.begin(), near.earlier.end(),
                   std::back_inserter(faces));
    const CutOut before = assembly_.around(faces);
    Joining joining{.complex = before.complex, .marks = before.marks, .rims = rims_in(before), .rank = rank_};
    if (auto fault = join(joining, component, largest_, groups_, options_, [&] { return advice(); })) return fault;
    const std::vector<VertexId> vertex = assembly_.put_back(before, joining.complex, joining.marks);
    for (const auto& [v, from] : joining.moved)
      if (const NodeRef node = joining.complex.node[v.value]; node.valid())
        out_.moves.push_back({node, vertex[v.value], from, joining.complex.position[v.value]});
    for (const auto& [y, x] : joining.replaced)
      if (const NodeRef node = joining.complex.node[y.value]; node.valid())
        out_.replaced.push_back({node, vertex[x.value]});
    out_.covered.insert(out_.covered.end(), joining.covered.begin(), joining.covered.end());
    out_.traded.insert(out_.traded.end(), joining.traded.begin(), joining.traded.end());
    out_.joined_seams.insert(out_.joined_seams.end(), joining.joined_seams.begin(), joining.joined_seams.end());
    out_.sewn.insert(out_.sewn.end(), joining.sewn.begin(), joining.sewn.end());
    out_.half_reached.insert(out_.half_reached.end(), joining.half_reached.begin(), joining.half_reached.end());
    out_.left_open.insert(out_.left_open.end(), joining.left_open.begin(), joining.left_open.end());
    return std::nullopt;
  }

  /// One for all components: what the next ones need is told at once.
  [[nodiscard]] std::optional<std::string> advice() const {
    std::vector<std::array<std::vector<FaceId>, 2>> sides;
    for (const NearFaces& near : near_)
      if (!near.own.empty()) sides.push_back({near.earlier, near.own});
    auto laying = laying_advice(complex_, sides, size_, SnapRule(largest_, options_, true), options_);
    if (!laying) return std::nullopt;
    CorefineOptions advised = options_;
    advised.tolerance = {laying->tolerance, false}, advised.contact_angle = laying->contact_angle;
    // A larger tolerance brings more faces near each other.
    const auto thin = find_thin_parts(near_faces(complex_, size_, SnapRule(largest_, advised, true), rank_), advised);
    if (!thin) return std::move(laying->text);
    return "no --tolerance lays these faces on each other: it would be " + text_of(laying->tolerance) +
           ", and weld two sides of one mesh at " + text_of(thin->at) + "; mend the mesh there, or move the part";
  }

  /// Call only once all are known, ascending.
  [[nodiscard]] bool is_replaced(NodeRef node) const {
    return std::ranges::binary_search(out_.replaced, node, {}, &Corefined::Replaced::node);
  }

  /// A node may be moved in several joins: from where it was first to where it is at last; or be replaced later.
  void unite_moves() {
    std::erase_if(out_.moves, [&](const Corefined::Move& m) { return is_replaced(m.node); });
    std::ranges::stable_sort(out_.moves, {}, &Corefined::Move::node);
    std::vector<Corefined::Move> all;
    for (const Corefined::Move& m : out_.moves) {
      if (!all.empty() && all.back().node == m.node)
        all.back().to = m.to, all.back().vertex = m.vertex;
      else
        all.push_back(m);
    }
    out_.moves = std::move(all);
  }

  Corefined result() {
    std::ranges::sort(out_.replaced, {}, &Corefined::Replaced::node);
    std::sort(out_.covered.begin(), out_.covered.end());
    std::sort(out_.traded.begin(), out_.traded.end());
    for (const VertexId v : bends_)
      if (!is_replaced(complex_.node[v.value])) assembly_.pin(v);
    out_.complex = assembly_.finished(out_.touched, out_.kept);
    for (const auto& [v, from] : ease_slopes(out_, complex_))
      if (const NodeRef node = out_.complex.node[v.value]; node.valid())
        out_.moves.push_back({node, v, from, out_.complex.position[v.value]});
    unite_moves();
    find_shared(out_);
    return std::move(out_);
  }

  const Complex& complex_;
  GroupSets& groups_;
  const CorefineOptions& options_;
  double largest_;                   // coordinate, by magnitude
  std::vector<double> size_;         // by face, its mean edge length
  std::vector<std::uint32_t> rank_;  // by component: its place in the order in which they are joined
  std::vector<NearFaces> near_;      // by component
  Assembly assembly_;
  Corefined out_;
  std::vector<VertexId> rims_;   // ends that were drawn, ascending
  std::vector<VertexId> bends_;  // of rims, see Extensions
};

}  // namespace

tl::expected<Corefined, JunctionFault> corefine(const Complex& complex, GroupSets& groups,
                                                const CorefineOptions& options) {
  auto corefined = Corefiner(complex, groups, options).run();
  if (corefined || !options.ends_on_borders) return corefined;
  CorefineOptions without = options;
  without.ends_on_borders = false;
  auto as_they_are = Corefiner(complex, groups, without).run();
  return as_they_are ? std::move(as_they_are) : std::move(corefined);
}

}  // namespace meshgraft
