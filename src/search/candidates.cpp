#include "search/candidates.hpp"

#include <atomic>
#include <cmath>

#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"
#include "search/blocks.hpp"

namespace meshgraft {
namespace {

struct GrownFace {
  ElementId face;
  Box box;
};

/// The box of a face, grown alike in all directions (a flat box has to grow across, too).
Box grown_box(const Model& model, ElementId face, const SearchOptions& options) {
  const Triangle corner = model.corners(face);
  Box box;
  for (const Vec3 p : corner) box.add(p);
  const Vec3 d = box.high - box.low;
  const double side = std::max({d.x, d.y, d.z});
  double by = 0.5 * (options.box_scale - 1) * side;
  // No edge is longer than the diagonal: mostly that bound spares the three square roots.
  const double longest_edge = std::sqrt(3.0) * side;
  if (options.tolerance.at(longest_edge) > by) by = std::max(by, options.tolerance.at(mean_edge_length(corner)));
  return box.grown(by);
}

Box box_of_faces(const Model& model, const SearchOptions& options) {
  std::vector<Box> of_block(model.n_elements() / kBlock + 1);
  for_blocks(model.n_elements(), [&](std::size_t first, std::size_t last) {
    Box box;
    for (ElementId e(first); e.value < last; ++e.value)
      if (model.is_face(e)) box.add(grown_box(model, e, options));
    of_block[first / kBlock] = box;
  });
  Box all;
  for (const Box& box : of_block) all.add(box);
  return all;
}

/// The faces of one input whose grown box meets one of `others`.
std::vector<GrownFace> faces_near(const Model& model, std::span<const Box> others, const SearchOptions& options) {
  Box all;
  for (const Box& box : others) all.add(box);
  return collected<GrownFace>(model.n_elements(), [&](std::size_t i, std::vector<GrownFace>& out) {
    const ElementId e(i);
    if (!model.is_face(e)) return;
    const Box box = grown_box(model, e, options);
    if (!all.overlaps(box)) return;
    for (const Box& other : others)
      if (other.overlaps(box)) {
        out.push_back({e, box});
        return;
      }
  });
}

/// The inputs in the order of their size, largest first: trees are built over the smaller of two.
std::vector<std::size_t> by_size(std::span<const Model* const> inputs) {
  std::vector<std::size_t> order(inputs.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return inputs[a]->n_elements() > inputs[b]->n_elements(); });
  return order;
}

/// Marks the faces of two inputs whose boxes meet. Faces that follow each other in a file mostly
/// lie together: a run of them that is far from the tree costs one query.
void mark_meeting(std::span<const GrownFace> many, const BoxTree& tree, std::vector<std::uint8_t>& of_many,
                  std::vector<std::uint8_t>& of_tree) {
  constexpr std::size_t kRun = 64;
  const auto mark_run = [&](std::size_t first, std::size_t last) {
    Box run;
    for (std::size_t i = first; i < last; ++i) run.add(many[i].box);
    bool near = false;
    tree.overlapping(run, [&](std::uint32_t) { near = true; });
    for (std::size_t i = first; near && i < last; ++i)
      tree.overlapping(many[i].box, [&](std::uint32_t j) {
        of_many[i] = 1;
        std::atomic_ref(of_tree[j]).store(1, std::memory_order_relaxed);
      });
  };
  for_blocks(many.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; i += kRun) mark_run(i, std::min(last, i + kRun));
  });
}

}  // namespace

std::vector<std::vector<ElementId>> candidate_faces(std::span<const Model* const> inputs,
                                                    const SearchOptions& options) {
  const std::size_t n = inputs.size();
  std::vector<std::vector<ElementId>> candidates(n);
  if (n < 2) return candidates;

  // The largest input is passed over only once: it is cut to the boxes of the others, and they to
  // what was then left of it.
  const std::vector<std::size_t> order = by_size(inputs);
  std::vector<Box> box(n);
  for (std::size_t k = 1; k < n; ++k) box[order[k]] = box_of_faces(*inputs[order[k]], options);
  std::vector<std::vector<GrownFace>> near(n);
  for (const std::size_t k : order) {
    std::vector<Box> others;
    for (std::size_t other = 0; other < n; ++other)
      if (other != k && !box[other].empty()) others.push_back(box[other]);
    near[k] = faces_near(*inputs[k], others, options);
    box[k] = Box{};
    for (const GrownFace& f : near[k]) box[k].add(f.box);
  }

  std::vector<std::vector<std::uint8_t>> meets(n);
  for (std::size_t k = 0; k < n; ++k) meets[k].resize(near[k].size());
  for (std::size_t small = 1; small < n; ++small) {
    const std::size_t s = order[small];
    std::vector<Box> boxes;
    boxes.reserve(near[s].size());
    for (const GrownFace& f : near[s]) boxes.push_back(f.box);
    const BoxTree tree(boxes);
    for (std::size_t large = 0; large < small; ++large)
      mark_meeting(near[order[large]], tree, meets[order[large]], meets[s]);
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < near[k].size(); ++i)
      if (meets[k][i]) candidates[k].push_back(near[k][i].face);
  return candidates;
}

}  // namespace meshgraft
