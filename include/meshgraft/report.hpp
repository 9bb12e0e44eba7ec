// The ledger of a merge: all figures, for people and for programs. Plain data; the JSON form has
// the same names. Lengths and areas are in the file's unit, times in seconds.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meshgraft/result.hpp"
#include "meshgraft/vec3.hpp"

namespace meshgraft {

struct InputSummary {
  std::string path, sha256;
  std::uint64_t bytes = 0, nodes = 0, elements = 0;
  std::map<std::string, std::uint64_t> elements_by_kind;  // "triangle", "line", ...
  std::uint64_t groups = 0;
};

/// One of the meshes that are joined: the base, a part; or, where a model is joined with itself, a
/// connected mesh of it, or what the groups to be joined have of that.
struct ComponentSummary {
  std::uint32_t input = 0;
  std::uint64_t faces = 0;
  std::int64_t element = 0;         // label of the first face, in that input
  std::vector<std::string> groups;  // that all its faces are in
};

/// A curve along which inputs are joined, or a single node where they are joined in no curve.
struct PolylineSummary {
  /// "crossing": every input goes on beyond the curve on both sides; "touching": one of them ends on
  /// it; "overlap": it borders an area in which they lie on each other; "point": a single node.
  std::string kind;
  bool closed = false;
  double length = 0;
  std::uint64_t nodes = 0, corners = 0;
  std::vector<std::uint32_t> inputs;      // the inputs that meet along it, ascending
  std::vector<std::uint32_t> components;  // the same in terms of Report::components, ascending
};

/// An area in which meshes lie on each other, and what became of it.
struct OverlapEntry {
  std::string rule;                       // "fused", "projected" or "deleted": all meshes but the first went there
  std::vector<std::uint32_t> inputs;      // that of the surface that stays first
  std::vector<std::uint32_t> components;  // the same in terms of Report::components
  std::uint64_t faces = 0;                // that stand for all; of the input, where they were deleted
  double area = 0;
  Vec3 at;  // centre of area
};

/// A place in the merged mesh where something is not as it should be.
struct QualityPlace {
  double q = 0;
  Vec3 at;
  std::int64_t element = 0;  // label in the output
  std::string cause;         // "input angle of 9 degrees between ...", empty if none was found
};

struct QualitySummary {
  std::uint64_t faces = 0;
  double min = 1, p01 = 1, mean = 1;
  std::uint64_t below = 0;          // faces under the wanted Q
  std::vector<QualityPlace> worst;  // at most ten, worst first
};

struct GroupEntry {
  std::string name;
  std::string kind;  // "nodes", "faces", "lines", "other", or several joined by "+"
  std::uint64_t members_before = 0, members_after = 0;
  double area_before = 0, area_after = 0;
  double length_before = 0, length_after = 0;
  std::string rule;  // "untouched", "inherited from parent", "united from 2 inputs", ...
};

struct MovedEntry {
  std::uint32_t input = 0;
  std::int64_t node = 0;  // label in that input
  Vec3 from, to;
  double distance = 0;
};

struct LabelShift {
  std::uint32_t input = 0;
  std::string kind;  // "node" or "element"
  std::int64_t from = 0, to = 0;
};

/// Text of an input that was not understood, and what became of it.
struct DatasetEntry {
  std::uint32_t input = 0;
  std::string number;  // as in the file: "2414", "58b"
  std::uint64_t line = 0, bytes = 0;
  std::string fate;  // "kept", "kept, stale: names removed nodes", "side file", "same as base"
};

/// A piece of an input that was taken out on purpose.
struct DroppedEntry {
  std::uint32_t input = 0;
  std::string cause;        // "trimmed" or "cut"
  std::uint64_t faces = 0;  // triangles of the input that are in it, wholly or in part
  double area = 0;
  Vec3 at;                          // its centre of area
  std::vector<std::string> groups;  // that its faces are in, in the order of the output
};

struct Report {
  std::string version;
  std::vector<InputSummary> inputs;
  std::vector<ComponentSummary> components;
  std::vector<PolylineSummary> junction;
  std::vector<OverlapEntry> overlaps;  // one for each set of meshes and rule
  struct Zone {
    std::uint64_t faces_removed = 0, faces_created = 0, nodes_removed = 0, nodes_created = 0;
    std::vector<int> bandwidth;  // by input
    int widened = 0;             // times the zone was grown to reach the wanted quality
  } zone;
  QualitySummary quality;
  /// None where no face was replaced but new ones made (filling): there is no surface to measure from.
  struct Fidelity {
    double max_distance = 0, max_distance_relative = 0;  // relative: over the local edge length
    Vec3 at;
    /// The other way: from the surface that was removed to the new faces with its groups and attributes.
    struct Removed {
      double max_distance = 0, max_distance_relative = 0;
      Vec3 at;
    } removed;
  };
  std::optional<Fidelity> fidelity;
  std::vector<GroupEntry> groups;
  struct Untouched {
    std::uint64_t nodes = 0, elements = 0, bytes = 0;
  } untouched;
  std::vector<DroppedEntry> dropped;
  std::vector<LabelShift> labels;
  std::vector<std::int64_t> removed_nodes, removed_elements;  // labels of the base that are gone
  std::vector<MovedEntry> moved;
  std::vector<DatasetEntry> datasets;
  std::vector<std::pair<std::string, double>> timings;  // in order of the stages
  std::uint64_t peak_memory_bytes = 0;
  std::vector<Warning> warnings;
  std::vector<Error> broken_promises;  // nothing should be written while this is not empty
};

/// Pretty-printed JSON with the field names of docs/report.md.
[[nodiscard]] std::string to_json(const Report& report);

}  // namespace meshgraft
