#include "search/candidates.hpp"

#include <atomic>
#include <cmath>

#include "core/append.hpp"
#include "core/blocks.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

struct GrownFace {
  ElementRef face;
  std::uint32_t component = 0;
  Box box;
};

double longest_side(const Box& box) {
  const Vec3 d = box.high - box.low;
  return std::max({d.x, d.y, d.z});
}

/// The box of a face, grown alike in all directions (a flat box has to grow across, too).
Box grown_box(const Model& model, ElementId face, const SearchOptions& options) {
  const Box box = box_of_face(model, face);
  const double side = longest_side(box);
  double by = 0.5 * (options.box_scale - 1) * side;
  // No edge is longer than the diagonal: mostly that bound spares the three square roots.
  const double longest_edge = std::sqrt(3.0) * side;
  if (options.tolerance.at(longest_edge) > by)
    by = std::max(by, options.tolerance.at(mean_edge_length(model.corners(face))));
  return box.grown(by);
}

/// A box around the grown boxes of all faces in a box.
Box grown_around(const Box& faces, const SearchOptions& options) {
  const double side = longest_side(faces);
  return faces.grown(std::max(0.5 * (options.box_scale - 1) * side, options.tolerance.at(std::sqrt(3.0) * side)));
}

class Search {
 public:
  Search(std::span<const Model* const> inputs, const FaceRuns& runs, const Components& components,
         const SearchOptions& options)
      : inputs_(inputs), runs_(runs), components_(components), options_(options), boxes_(components.size()) {}

  std::vector<std::vector<ElementId>> run() {
    // If the largest input is one component, it is passed over only once: it is cut to the boxes of
    // the others, and they to what is then left of it.
    const std::uint32_t largest = largest_input();
    const bool once = components_.of_element[largest].empty();
    for (std::uint32_t k = 0; k < inputs_.size(); ++k)
      if (k != largest || !once) find_boxes(k);
    plant();
    add_near(largest);
    for (const GrownFace& f : near_)
      if (once) boxes_[f.component].add(f.box);
    plant();
    for (std::uint32_t k = 0; k < inputs_.size(); ++k)
      if (k != largest) add_near(k);
    meets_.resize(near_.size());
    mark();
    return found();
  }

 private:
  [[nodiscard]] std::uint32_t largest_input() const {
    std::uint32_t largest = 0;
    for (std::uint32_t k = 1; k < inputs_.size(); ++k)
      if (inputs_[k]->n_elements() > inputs_[largest]->n_elements()) largest = k;
    return largest;
  }

  void find_boxes(std::uint32_t k) {
    const Model& model = *inputs_[k];
    if (!components_.of_element[k].empty()) {
      for (std::size_t e = 0; e < model.n_elements(); ++e)
        if (const ElementId f(e); model.is_face(f)) boxes_[components_.of({k, f})].add(grown_box(model, f, options_));
      return;
    }
    std::vector<Box> of_block(model.n_elements() / kBlock + 1);
    for_blocks(model.n_elements(), [&](std::size_t first, std::size_t last) {
      for (ElementId e(first); e.value < last; ++e.value)
        if (model.is_face(e)) of_block[first / kBlock].add(grown_box(model, e, options_));
    });
    for (const Box& box : of_block)
      if (!box.empty()) boxes_[components_.of_input[k]].add(box);
  }

  /// The tree over the boxes of components known so far.
  void plant() {
    std::vector<Box> boxes;
    tree_component_.clear();
    for (std::uint32_t c = 0; c < boxes_.size(); ++c)
      if (!boxes_[c].empty()) boxes.push_back(boxes_[c]), tree_component_.push_back(c);
    component_tree_ = BoxTree(boxes);
  }

  [[nodiscard]] bool is_near_another(std::uint32_t component, const Box& box) const {
    bool near = false;
    component_tree_.overlapping(
        box, [&](std::uint32_t i) { near = near || components_.joins.are_joined(component, tree_component_[i]); });
    return near;
  }

  /// The faces of an input whose grown box meets the box of another component.
  void add_near(std::uint32_t k) {
    const Model& model = *inputs_[k];
    const auto may_be_near = [&](std::size_t first, std::size_t last, const Box& run) {
      return may_be_near_another(k, first, last, grown_around(run, options_));
    };
    auto near = runs_.collected_by_run<GrownFace>(
        k, model.n_elements(), may_be_near, [&](ElementId element, std::vector<GrownFace>& out) {
          const ElementRef e{k, element};
          if (!model.is_face(e.element)) return;
          const GrownFace face{e, components_.of(e), grown_box(model, e.element, options_)};
          if (is_near_another(face.component, face.box)) out.push_back(face);
        });
    append(near_, std::move(near));
  }

  /// False if no face of a run of elements inside `box` is near another component.
  [[nodiscard]] bool may_be_near_another(std::uint32_t k, std::size_t first, std::size_t last, const Box& box) const {
    const std::uint32_t component = components_.of({k, ElementId(first)});
    const auto& of = components_.of_element[k];
    const bool one = of.empty() || std::all_of(of.begin() + static_cast<std::ptrdiff_t>(first),
                                               of.begin() + static_cast<std::ptrdiff_t>(last),
                                               [&](std::uint32_t c) { return c == component; });
    return !one || is_near_another(component, box);
  }

  [[nodiscard]] std::uint32_t largest_component() const {
    std::vector<std::size_t> count(components_.size());
    for (const GrownFace& f : near_) ++count[f.component];
    return static_cast<std::uint32_t>(std::ranges::max_element(count) - count.begin());
  }

  /// Marks the faces whose boxes meet. Those of the largest component are not in the tree: they do
  /// not meet each other.
  void mark() {
    const std::uint32_t largest = largest_component();
    std::vector<Box> boxes;
    std::vector<std::uint32_t> item;
    for (std::uint32_t i = 0; i < near_.size(); ++i)
      if (near_[i].component != largest) boxes.push_back(near_[i].box), item.push_back(i);
    const BoxTree tree(boxes);
    const auto mark_run = [&](std::size_t first, std::size_t last, const Box& run) {
      if (!tree.meets(run)) return;
      for (std::size_t i = first; i < last; ++i)
        tree.overlapping(near_[i].box, [&](std::uint32_t j) {
          if (!components_.joins.are_joined(near_[i].component, near_[item[j]].component)) return;
          for (const std::size_t met : {i, std::size_t{item[j]}})
            std::atomic_ref(meets_[met]).store(1, std::memory_order_relaxed);
        });
    };
    for_blocks(near_.size(), [&](std::size_t first, std::size_t last) {
      for_runs(
          first, last, [&](std::size_t i) { return near_[i].box; }, mark_run);
    });
  }

  [[nodiscard]] std::vector<std::vector<ElementId>> found() const {
    std::vector<std::vector<ElementId>> candidates(inputs_.size());
    for (std::size_t i = 0; i < near_.size(); ++i)
      if (meets_[i]) candidates[near_[i].face.input].push_back(near_[i].face.element);
    return candidates;
  }

  std::span<const Model* const> inputs_;
  const FaceRuns& runs_;
  const Components& components_;
  const SearchOptions& options_;
  std::vector<Box> boxes_;  // by component; empty: of no face
  BoxTree component_tree_;
  std::vector<std::uint32_t> tree_component_;  // by box of the tree
  std::vector<GrownFace> near_;                // by input, ascending
  std::vector<std::uint8_t> meets_;            // by position in near_
};

}  // namespace

std::vector<std::vector<ElementId>> candidate_faces(std::span<const Model* const> inputs, const FaceRuns& runs,
                                                    const Components& components, const SearchOptions& options) {
  if (components.size() < 2) return std::vector<std::vector<ElementId>>(inputs.size());
  return Search(inputs, runs, components, options).run();
}

}  // namespace meshgraft
