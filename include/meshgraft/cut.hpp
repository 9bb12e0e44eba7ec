// The incision: takes the piece out of a base that a surface cuts off.
#pragma once

#include <string>
#include <variant>

#include "meshgraft/merge.hpp"
#include "meshgraft/model.hpp"
#include "meshgraft/options.hpp"
#include "meshgraft/result.hpp"

namespace meshgraft {

/// A box along the axes, from its lowest to its highest corner.
struct BoxTool {
  Vec3 low, high;
};

/// A cylinder without ends around an axis.
struct CylinderTool {
  Vec3 point, axis;  // the axis need not have length 1
  double radius = 0;
};

/// A plane; its normal points outside.
struct PlaneTool {
  Vec3 point, normal;  // the normal need not have length 1
};

/// What cuts: a surface by numbers, or the triangles (and quadrilaterals, as two triangles each) of a
/// model. A closed surface has an inside whatever the orientation of its faces; the normals of an open
/// one point outside, so that its faces have to be oriented alike. Groups and everything else of the
/// model are left out of account.
using CutTool = std::variant<BoxTool, CylinderTool, PlaneTool, const Model*>;

/// What is taken out.
struct Drop {
  enum class What {
    kInside,   // of the tool
    kOutside,  // of it
    kGroup,    // the pieces next to the cut in which a group has faces; all else stays, uncut
  } what = What::kInside;
  std::string group;
};

struct CutOptions {
  Drop drop;
  /// Of the zone along the cut: tolerance, size, bandwidth, min_quality, progress. An edge or node of
  /// the base that must stay is taken to lie on the tool if it is nearer than the tolerance.
  MergeOptions zone;
};

/// Takes out of `base` what the tool cuts off, and remeshes the zone along the cut.
///
///  (1) A piece is a part of the base whose faces hang together over edges that the cut does not run
///      along; T-lines hold it together, too. Each piece stays or goes as a whole, with all elements
///      that have no node elsewhere. A piece that the tool does not touch goes if it is inside
///      (outside) of a closed tool and that is what shall be dropped.
///  (2) Laws (1) to (4) of merge() hold for what stays. New nodes of the cut lie on the base and on the
///      tool; for a cylinder, on the true one.
///  (3) The tool leaves no trace. Groups shrink by what went; one that becomes empty stays, with a warning.
///
/// The result has one input: apply(base, {}, result) and write_unv(base, {}, result, ...).
///
/// Errors: those of merge(), with kPartsApart if the tool takes nothing out or everything, and
/// kNotSeparated, with the place, if an open tool ends inside a piece that it should cut off or its
/// sides cannot be told. kUnsupportedElement: the tool crosses an element that cannot be cut.
[[nodiscard]] Result<Merged> cut(const Model& base, const CutTool& tool, const CutOptions& options = {});

}  // namespace meshgraft
