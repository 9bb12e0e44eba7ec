#include "merge/compatibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/blocks.hpp"
#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr const char* kCheckUnits = "check that both files are in the same unit of length (mm against m?)";

Result<void> check_options(const MergeOptions& o) {
  const auto refuse = [](const std::string& what, const std::string& hint) {
    return failure(ErrorCode::kUsage, what, hint);
  };
  if (!(o.contact_angle > 0 && o.contact_angle < std::numbers::pi / 2))
    return refuse("contact angle of " + text_of(o.contact_angle * 180 / std::numbers::pi) + " degrees",
                  "give an angle between 0 and 90 degrees");
  if (!(o.tolerance.value >= 0 && std::isfinite(o.tolerance.value)))
    return refuse("tolerance of " + text_of(o.tolerance.value), "give a length of 0 or more, or a percentage");
  if (o.tolerance.relative && o.tolerance.value > 0.5)
    return refuse("tolerance of " + text_of(100 * o.tolerance.value) + " % of the edge length",
                  "give at most 50 %, or a length in the unit of the files");
  if (o.trim && !(*o.trim > 0 && std::isfinite(*o.trim)))
    return refuse("loose ends of " + text_of(*o.trim) + " to be trimmed", "give a length above 0");
  if (o.size && !(*o.size > 0 && std::isfinite(*o.size)))
    return refuse("edge length of " + text_of(*o.size) + " along the junction", "give a length above 0");
  if (o.bandwidth && *o.bandwidth < 1)
    return refuse("bandwidth of " + std::to_string(*o.bandwidth), "give 1 or more neighbourhoods");
  if (!(o.min_quality >= 0 && o.min_quality < 1))
    return refuse("least quality of " + text_of(o.min_quality), "give a Q of at least 0 and below 1");
  return {};
}

Result<void> check_numbers(const Model& model) {
  const auto bad = collected<NodeId>(model.n_nodes(), [&](std::size_t n, std::vector<NodeId>& out) {
    if (!is_place(model.position[n])) out.emplace_back(n);
  });
  if (bad.empty()) return {};
  const NodeId node = bad.front();
  return failure(
      ErrorCode::kBadNumber,
      "node " + std::to_string(model.node_label[node.value]) + " is at " + text_of(model.position[node.value]),
      "a coordinate must be a number, and not beyond " + text_of(kLargestCoordinate), place_of(model, node));
}

Result<void> check_units(Inputs inputs) {
  const Model* first = nullptr;
  for (const Model* model : inputs) {
    if (!model->units) continue;
    if (first == nullptr) first = model;
    const Units &a = *first->units, &b = *model->units;
    if (a.length == b.length && a.force == b.force && a.temperature == b.temperature) continue;
    const auto factors = [](const Units& u) {
      return "length " + text_of(u.length) + ", force " + text_of(u.force) + ", temperature " + text_of(u.temperature);
    };
    return failure(ErrorCode::kUnitsDiffer,
                   "the unit factors of dataset 164 differ: " + factors(a) + " in " + first->path + ", " + factors(b) +
                       " in " + model->path,
                   "convert one of the models, or correct its dataset 164 if it only says the wrong thing",
                   {model->path, 0});
  }
  return {};
}

std::string described(const CoordinateSystem& system) {
  constexpr std::array kTypes{"Cartesian", "cylindrical", "spherical"};
  if (system.is_global()) return "the global one";
  const bool known = system.type >= 0 && static_cast<std::size_t>(system.type) < kTypes.size();
  const Vec3 origin{system.axes[9], system.axes[10], system.axes[11]};
  return (known ? kTypes[static_cast<std::size_t>(system.type)] : "of type " + std::to_string(system.type)) +
         " with origin " + text_of(origin);
}

/// Distances mean nothing between coordinates of different systems, nor in curvilinear ones.
Result<void> check_places(Inputs inputs) {
  for (const Model* model : inputs)
    for (const CoordinateSystem& system : model->coordinate_systems)
      if (system.first_placed.valid() && !system.is_global())
        return failure(ErrorCode::kCoordinateSystem,
                       "node " + std::to_string(model->node_label[system.first_placed.value]) +
                           " has its coordinates in system " + std::to_string(system.label) + ", which is " +
                           described(system),
                       "export the model in global Cartesian coordinates", place_of(*model, system.first_placed));
  return {};
}

/// In the output the nodes of a part name the systems of the base.
Result<void> check_systems(Inputs inputs) {
  const Model& base = *inputs[0];
  for (const Model* part : inputs.subspan(1)) {
    for (const CoordinateSystem& system : part->coordinate_systems) {
      if (!system.first_node.valid()) continue;
      const CoordinateSystem in_base = base.coordinate_system(system.label);
      if (system.same_as(in_base)) continue;
      return failure(
          ErrorCode::kCoordinateSystem,
          "node " + std::to_string(part->node_label[system.first_node.value]) + " names coordinate system " +
              std::to_string(system.label) + ", which is " + described(system) + " here but " + described(in_base) +
              " in " + base.path,
          "export both models in global Cartesian coordinates, or with the same systems under the same labels",
          place_of(*part, system.first_node));
    }
  }
  return {};
}

/// Size of a model, from some of its faces.
struct Extent {
  double diagonal = 0, mean_edge = 0;
  std::size_t faces = 0;
};

template <class Faces>
Extent extent_of(const Model& model, const Faces& faces) {
  Extent e;
  Box box;
  for (const ElementId f : faces) {
    const Triangle t = model.corners(f);
    for (const Vec3& p : t) box.add(p);
    e.mean_edge += mean_edge_length(t);
    ++e.faces;
  }
  e.diagonal = box.diagonal();
  if (e.faces > 0) e.mean_edge /= static_cast<double>(e.faces);
  return e;
}

/// Faces spread over the model; all of them if there are few.
std::vector<ElementId> some_faces(const Model& model, std::size_t wanted) {
  const std::size_t step = std::max<std::size_t>(1, model.n_elements() / wanted);
  std::vector<ElementId> faces;
  for (std::size_t start = 0; start < step && faces.empty(); ++start)
    for (std::size_t e = start; e < model.n_elements(); e += step)
      if (model.is_face(ElementId(e))) faces.emplace_back(e);
  return faces;
}

double ratio(double a, double b) { return std::min(a, b) > 0 ? std::max(a, b) / std::min(a, b) : 1; }

/// Lengths that the user gave against the size of `of`, a mesh at `place`.
Result<void> check_lengths(const std::string& of, double diagonal, const Place& place, const MergeOptions& options) {
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    return failure(ErrorCode::kUsage, what + ", but " + of + " is only " + text_of(diagonal) + " across", hint, place);
  };
  if (!options.tolerance.relative && options.tolerance.value >= diagonal)
    return refuse("tolerance of " + text_of(options.tolerance.value),
                  "give a length below that; half the plate thickness closes gaps between mid-surfaces");
  if (options.trim && *options.trim >= diagonal)
    return refuse("loose ends of up to " + text_of(*options.trim) + " to be trimmed",
                  "give the length by which the part sticks out, and a little more");
  return {};
}

}  // namespace

Result<void> check_compatible(Inputs inputs, const MergeOptions& options, const CompatibilityLimits& limits) {
  if (const auto ok = check_options(options); !ok) return ok;
  std::vector<Extent> extents;
  for (const Model* model : inputs) {
    const std::vector<ElementId> faces = some_faces(*model, limits.sample);
    if (faces.empty())
      return failure(ErrorCode::kNoFaces,
                     "no triangle among " + std::to_string(model->n_elements()) +
                         " elements, so there is no surface "
                         "to join",
                     "only three-node triangles can be merged; mesh the surface with them", {model->path, 0});
    if (const auto ok = check_numbers(*model); !ok) return ok;
    extents.push_back(extent_of(*model, faces));
  }
  if (const auto ok = check_units(inputs); !ok) return ok;
  if (const auto ok = check_places(inputs); !ok) return ok;
  if (const auto ok = check_systems(inputs); !ok) return ok;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    if (const auto ok = check_lengths(inputs[k]->path, extents[k].diagonal, {inputs[k]->path, 0}, options); !ok)
      return ok;
  for (std::size_t k = 1; k < inputs.size(); ++k) {
    const Extent &a = extents[0], &b = extents[k];
    const double times = std::min(ratio(a.diagonal, b.diagonal), ratio(a.mean_edge, b.mean_edge));
    if (times < limits.max_size_ratio) continue;
    const auto figures = [](const Extent& e) {
      return "is " + text_of(e.diagonal) + " across with edges of " + text_of(e.mean_edge);
    };
    return failure(ErrorCode::kScaleMismatch,
                   inputs[0]->path + " " + figures(a) + ", but " + inputs[k]->path + " " + figures(b), kCheckUnits,
                   {inputs[k]->path, 0});
  }
  return {};
}

Result<void> check_local_scale(Inputs inputs, std::span<const std::vector<ElementId>> candidates,
                               const MergeOptions& options, const CompatibilityLimits& limits) {
  std::vector<double> edge;  // mean length, by input
  for (std::size_t k = 0; k < inputs.size(); ++k) edge.push_back(extent_of(*inputs[k], candidates[k]).mean_edge);
  for (std::size_t k = 1; k < inputs.size(); ++k) {
    if (ratio(edge[0], edge[k]) < limits.max_size_ratio) continue;
    return failure(ErrorCode::kScaleMismatch,
                   "where " + inputs[k]->path + " meets " + inputs[0]->path + ", edges of " + text_of(edge[k]) +
                       " meet edges of " + text_of(edge[0]),
                   std::string(kCheckUnits) + ", or refine the coarser mesh there", {inputs[k]->path, 0});
  }
  std::erase(edge, 0);  // an input that has no face near the others
  const auto is_apart = [&](double length) { return ratio(*options.size, length) >= limits.max_size_ratio; };
  if (options.size && !edge.empty() && std::ranges::all_of(edge, is_apart))
    return failure(ErrorCode::kUsage,
                   "edge length of " + text_of(*options.size) + " asked for, where edges are " +
                       text_of(*std::ranges::min_element(edge)) + " long",
                   "give a length nearer to that, in the unit of the files");
  return {};
}

Result<void> check_component_sizes(Inputs inputs, const Components& components,
                                   std::span<const std::vector<ElementId>> candidates, const MergeOptions& options) {
  if (!components.are_parted()) return {};
  std::vector<std::uint8_t> is_near(components.size());
  std::vector<Box> box(components.size());
  std::vector<ElementRef> first(components.size());
  for (std::uint32_t k = 0; k < inputs.size(); ++k) {
    const Model& model = *inputs[k];
    for (const ElementId f : candidates[k]) is_near[components.of({k, f})] = 1;
    for (std::size_t e = 0; e < model.n_elements(); ++e) {
      const ElementRef face{k, ElementId(e)};
      if (!model.is_face(face.element)) continue;
      const std::uint32_t c = components.of(face);
      if (!first[c].valid()) first[c] = face;
      for (const Vec3& p : model.corners(face.element)) box[c].add(p);
    }
  }
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    if (is_near[c] == 0) continue;
    const Place place = place_of(*inputs[first[c].input], first[c].element);
    const std::string of = "the mesh of " + text_of(inputs, first[c]);
    if (const auto ok = check_lengths(of, box[c].diagonal(), place, options); !ok) return ok;
  }
  return {};
}

}  // namespace meshgraft
