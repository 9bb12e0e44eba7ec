// Work on all sheets at the same time.
#pragma once

#include <functional>

#include "remesh/editor.hpp"

namespace meshgraft {

/// Runs `work` on each sheet of the zone by itself, while the vertices of curves stand still. The sheets are put
/// together again in their order, so that the result is the same for any number of threads.
void in_each_sheet(Editor& editor, const std::function<void(Editor& sheet)>& work);

}  // namespace meshgraft
