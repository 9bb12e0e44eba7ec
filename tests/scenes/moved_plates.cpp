#include "scenes/moved_plates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "meshgraft/merge.hpp"
#include "scenes/expect.hpp"
#include "support/random_plates.hpp"
#include "support/scenes.hpp"

namespace meshgraft::scenes {
namespace {

constexpr double kNoise = 1e-9;          // edges are about 1
constexpr double kNear = 10;             // motions
constexpr double kFar = 1e4;             // motions far from the origin
constexpr double kMostSwept = 2;         // of outline times reach: what a border may sweep on both sides
constexpr double kMostByRounding = 0.1;  // of the same: what may depend on rounding
constexpr double kSameArea = 1e-6;       // relative

template <class... Words>
std::string text(const Words&... words) {
  std::ostringstream all;
  all.precision(10);
  (all << ... << words);
  return all.str();
}

/// What must not depend on where the plates are.
struct Outcome {
  std::string verdict, why;
  std::multiset<std::string> lines;            // of the junction
  std::map<std::string, long> characteristic;  // nodes - edges + faces, by group
  std::map<std::string, double> area;          // by group
  double whole_area = 0;
  std::vector<std::string> unsound;
};

std::map<std::string, long> characteristics(const Model& m) {
  struct Parts {
    std::set<NodeId> nodes;
    std::set<std::array<NodeId, 2>> edges;
    long faces = 0;
  };
  std::map<GroupId, Parts> of_group;
  for (std::size_t e = 0; e < m.n_elements(); ++e) {
    const auto v = m.nodes_of(ElementId(e));
    for (const GroupId g : m.group_sets.members(m.element_groups[e])) {
      Parts& parts = of_group[g];
      ++parts.faces;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(v[k], v[(k + 1) % 3]);
        parts.nodes.insert(low), parts.nodes.insert(high);
        parts.edges.insert({low, high});
      }
    }
  }
  std::map<std::string, long> all;
  for (const auto& [g, parts] : of_group)
    all[m.groups[g.value].name] =
        static_cast<long>(parts.nodes.size()) - static_cast<long>(parts.edges.size()) + parts.faces;
  return all;
}

std::string in_words(const PolylineSummary& line) {
  std::string words = text(line.kind, line.closed ? " closed" : "", " of");
  for (const std::uint32_t input : line.inputs) words += text(' ', input);
  return words + text(" with ", line.corners, " corners; ");
}

Outcome outcome(const Merge& scene, const std::function<Vec3(Vec3)>& motion) {
  Outcome out;
  const Model base = moved(scene.base, motion);
  std::vector<Model> parts;
  for (const Model& part : scene.parts) parts.push_back(moved(part, motion));
  const auto merged = merge(base, parts, scene.options);
  if (!merged) {
    out.verdict = name(merged.error().code), out.why = to_string(merged.error());
    return out;
  }
  const Report& report = merged->report;
  for (const Error& e : report.broken_promises)
    if (e.what.find("Q below") == std::string::npos) out.verdict = name(e.code), out.why = to_string(e);
  for (const PolylineSummary& line : report.junction) out.lines.insert(in_words(line));
  const Model result = apply(base, parts, *merged);
  out.area = area_by_group(result), out.characteristic = characteristics(result);
  const CheckResult found = check(result);
  out.whole_area = found.area;
  const bool may_be_double = scene.options.overlap == Overlap::kProject;
  if (found.n_degenerate_faces > 0) out.unsound.emplace_back("degenerate faces");
  if (found.n_duplicate_faces > 0 && !may_be_double) out.unsound.emplace_back("duplicate faces");
  if (found.intersections > 0) out.unsound.emplace_back("intersections");
  if (found.n_orphan_nodes > 0) out.unsound.emplace_back("nodes without element");
  if (found.n_coincident_nodes > 0) out.unsound.emplace_back("nodes in one place");
  return out;
}

std::string joined(const std::multiset<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line;
  return all;
}

}  // namespace

std::vector<std::string> faults_of_moved_plates(std::uint32_t seed) {
  const Draw draw = draw_from(seed);
  RandomPlates plates = random_plates(draw);
  Merge& scene = plates.merge;
  constexpr std::array kVariants{Overlap::kFuse, Overlap::kProject, Overlap::kKeepPart, Overlap::kFuse};
  scene.options.overlap = kVariants[static_cast<std::size_t>(draw(0, kVariants.size()))];
  const double noise = draw(0, 3) > 1 ? kNoise : 0, far = draw(0, 3) < 1 ? kFar : kNear;
  const Outcome still = outcome(scene, [](Vec3 p) { return p; });
  const Outcome there = outcome(scene, any_motion(draw, far, noise));

  std::vector<std::string> faults;
  if (still.verdict != there.verdict) {
    faults.push_back(text("refused in one place only: ", still.why, there.why));
    return faults;
  }
  if (!still.verdict.empty()) return faults;
  const double swept = plates.outline * plates.reach;
  for (const Outcome* o : {&still, &there}) {
    for (const std::string& what : o->unsound) faults.push_back("there are " + what);
    const double area = scene.options.overlap == Overlap::kProject ? plates.layers : plates.layer;
    if (std::abs(o->whole_area - area) > kMostSwept * swept)
      faults.push_back(text("the area is ", o->whole_area, " instead of ", area));
  }
  if (still.lines != there.lines)
    faults.push_back(text("the meshes meet in ", joined(still.lines), "and, moved, in ", joined(there.lines)));
  for (const auto& [group, area] : still.area) {
    const auto after = there.area.find(group);
    if (after == there.area.end() || still.characteristic.at(group) != there.characteristic.at(group))
      faults.push_back("group " + group + " has another shape");
    else if (std::abs(area - after->second) > kSameArea * area + kMostByRounding * swept)
      faults.push_back(text("group ", group, " has an area of ", area, " and, moved, of ", after->second));
  }
  return faults;
}

}  // namespace meshgraft::scenes
