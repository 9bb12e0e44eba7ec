// How far apart meshes are, for messages.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "meshgraft/model.hpp"

namespace meshgraft {

/// All triangles of a model of which `wanted` holds (empty: all).
[[nodiscard]] std::vector<ElementId> faces_of(const Model& model, const std::function<bool(ElementId)>& wanted = {});

/// Least distance from points to faces of a model; infinite if there are none. Cost (n + m) log m.
[[nodiscard]] double distance_to_faces(std::span<const Vec3> points, const Model& model,
                                       std::span<const ElementId> faces);

/// Distance between two meshes from the nodes of each to the faces of the other.
[[nodiscard]] double distance_between(const Model& a, const Model& b);

}  // namespace meshgraft
