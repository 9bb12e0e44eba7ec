// What a model amounts to.
#pragma once

#include "meshgraft/model.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

/// "point", "line", "triangle", ...: the names used in reports.
[[nodiscard]] const char* name(Shape shape);

/// Path and counts; digest and size stay empty.
[[nodiscard]] InputSummary counts_of(const Model& model);

}  // namespace meshgraft
