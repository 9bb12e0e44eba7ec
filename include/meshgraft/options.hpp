// What the user asks of a merge.
#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meshgraft {

/// How meeting faces are treated (paper 2.4): crossing, lying on each other, or as they are in each place.
enum class Mode { kAuto, kFaceEdge, kFaceFace };

/// What becomes of faces that lie on each other (paper 4).
enum class Overlap {
  kFuse,      // one layer, remeshed, in the groups of both
  kKeepBase,  // the faces of the base stay as they are, those of the part on them go
  kKeepPart,  // the other way round
  kProject,   // two layers on the same nodes, each with its own groups and attributes
};

/// How the zone is filled.
enum class Method {
  kAdaptive,  // the faces that were there, cut along the junction, are improved step by step
  kPaper,     // deleted and filled anew (paper 5.3 to 5.6)
};

/// How an area that was filled anew meets its surroundings (paper 5.6).
enum class Blend { kPosition, kTangency, kCurvature };

/// A length given as such or as a share of the local edge length.
struct Tolerance {
  double value = 0.01;
  bool relative = true;
  /// The length meant where the mean edge length is `local_edge_length`.
  [[nodiscard]] double at(double local_edge_length) const { return relative ? value * local_edge_length : value; }
};

/// Two element groups whose faces are joined where they meet.
struct JoinedGroups {
  std::string a, b;
};

struct MergeOptions {
  Mode mode = Mode::kAuto;
  Method method = Method::kAdaptive;
  Overlap overlap = Overlap::kFuse;
  Blend blend = Blend::kTangency;  // of curved areas, with Method::kPaper

  /// Faces meeting at less than this are in contact (paper 2.4). Radians, in (0, pi/2).
  double contact_angle = 20.0 / 180.0 * std::numbers::pi;
  /// Gap or penetration that is closed where a free edge ends on another mesh.
  Tolerance tolerance;
  /// Loose ends of parts that are shorter than this from the junction on, in file units, are dropped; by default none.
  std::optional<double> trim;
  /// Edge length along the junction, in file units; by default l_a of paper 5.3.
  std::optional<double> size;
  /// Neighbourhoods remeshed on both sides; by default chosen mesh by mesh (paper 5.4 and beyond).
  std::optional<int> bandwidth;
  /// Least aspect ratio Q (paper 5.5) accepted for a new face.
  double min_quality = 0.5;
  /// Parts that meet nothing are added unjoined, with a warning, instead of kPartsApart.
  bool allow_apart = false;

  /// If not empty, only these are joined: the faces of one group with those of the other.
  std::vector<JoinedGroups> joins;

  /// Called at the start of each stage with its name and the share of the work done, 0 to 1.
  std::function<void(std::string_view stage, double done)> progress;
};

}  // namespace meshgraft
