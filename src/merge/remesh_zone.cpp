#include "merge/remesh_zone.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/distinct.hpp"
#include "geometry/quality.hpp"
#include "merge/quality_summary.hpp"
#include "patch/paper_zone.hpp"
#include "zone/brep.hpp"
#include "zone/neighbourhoods.hpp"
#include "zone/size_field.hpp"

namespace meshgraft {
namespace {

/// Poor faces that another zone could make better.
std::vector<Vec3> mendable_places(const Remeshed& remeshed) {
  std::vector<Vec3> places;
  for (const BadFace& bad : remeshed.bad)
    if (!is_unavoidable(bad)) places.push_back(centroid(remeshed.complex.corners(bad.face)));
  return places;
}

/// Of the inputs that such faces have, ascending.
std::vector<NodeRef> nodes_of_mendable(const Remeshed& remeshed) {
  std::vector<NodeRef> nodes;
  for (const BadFace& bad : remeshed.bad)
    if (!is_unavoidable(bad))
      for (const VertexId v : remeshed.complex.face[bad.face.value])
        if (const NodeRef node = remeshed.complex.node[v.value]; node.valid()) nodes.push_back(node);
  make_distinct(nodes);
  return nodes;
}

double worst_mendable(const Remeshed& remeshed) {
  double worst = 1;
  for (const BadFace& bad : remeshed.bad)
    if (!is_unavoidable(bad)) worst = std::min(worst, bad.q);
  return worst;
}

/// How much Q all of them lack together.
double shortfall(const Remeshed& remeshed, double min_quality) {
  double sum = 0;
  for (const BadFace& bad : remeshed.bad)
    if (!is_unavoidable(bad)) sum += min_quality - bad.q;
  return sum;
}

/// Largest ratio of the mean edge lengths of two inputs at the junction.
double size_ratio(const Complex& original, const Corefined& corefined) {
  std::vector<ElementRef> touched;
  for (std::size_t f = 0; f < corefined.touched.size(); ++f)
    if (corefined.touched[f]) touched.push_back(corefined.complex.parent[f]);
  std::ranges::sort(touched);
  std::map<std::uint32_t, std::pair<double, double>> length;  // by component: sum and count
  for (std::size_t f = 0; f < original.n_faces(); ++f)
    if (std::ranges::binary_search(touched, original.parent[f])) {
      auto& [sum, count] = length[original.component[f]];
      sum += mean_edge_length(original.corners(FaceId(f))), ++count;
    }
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& [component, l] : length) {
    least = std::min(least, l.first / l.second);
    most = std::max(most, l.first / l.second);
  }
  return most / least;
}

/// Mean Q of the faces of a zone that the junction leaves whole.
double mean_input_quality(const Zone& zone, const Corefined& corefined) {
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f)
    if (zone.in_zone[f] && !corefined.touched[f]) sum += aspect_ratio(corefined.complex.corners(FaceId(f))), ++count;
  return count > 0 ? sum / count : 1;
}

bool is_collapsed(const Complex& complex, FaceId f) {
  const auto& v = complex.face[f.value];
  return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

/// The first face of a zone that uses a vertex twice: it has no three sides, so that nothing can take its place.
std::optional<FaceId> collapsed_face(const Complex& complex, const Zone& zone) {
  for (std::size_t f = 0; f < zone.in_zone.size(); ++f)
    if (zone.in_zone[f] != 0 && is_collapsed(complex, FaceId(f))) return FaceId(f);
  return std::nullopt;
}

JunctionFault collapsed_fault(const Complex& complex, FaceId f) {
  return {ErrorCode::kDegenerateFace,
          "a face that uses a node twice would have to be remeshed",
          {complex.parent[f.value]},
          centroid(complex.corners(f))};
}

/// Faces to remesh and what became of them.
struct Attempt {
  Zone zone;
  Remeshed remeshed;
};

}  // namespace

tl::expected<RemeshedZone, JunctionFault> remesh_zone(const Complex& original, const Corefined& corefined,
                                                      GroupSets& groups, const MergeOptions& options,
                                                      const WidenLimits& limits) {
  const Complex& complex = corefined.complex;
  BrepOptions brep_options;
  brep_options.original = &original;
  SizeOptions size_options;
  size_options.junction_size = options.size, size_options.kept = corefined.kept;
  Brep brep;
  std::optional<SizeField> field;
  std::optional<InputFaces> inputs;
  tbb::parallel_invoke(
      [&] {
        brep = read_brep(complex, corefined.junction_edges, corefined.junction_points, groups, brep_options);
        field.emplace(original, complex, brep, size_options);
      },
      [&] {
        inputs.emplace(corefined);
        inputs->find_spoiled(original, options.min_quality);
      });
  const SizeField& size = *field;
  const bool alike = size_ratio(original, corefined) < limits.alike;
  const double wanted = alike ? limits.mean_alike : limits.mean_graded;
  RemeshOptions remesh_options;
  remesh_options.min_quality = options.min_quality, remesh_options.wanted_mean = limits.mean_alike;

  if (options.method == Method::kPaper) {
    const Zone zone =
        options.bandwidth ? neighbourhoods(corefined, *inputs, size, options.bandwidth) : paper_zone(corefined);
    if (const auto face = collapsed_face(complex, zone)) return tl::unexpected(collapsed_fault(complex, *face));
    RemeshedByPaper paper = remesh_by_paper(complex, brep, size, zone.in_zone, groups, options.blend, remesh_options);
    return RemeshedZone{std::move(paper.remeshed), zone.bandwidth, 0, std::move(paper.unfilled)};
  }
  const auto attempt = [&](Zone zone) {
    Remeshed remeshed = remesh(complex, brep, size, zone.in_zone, groups, remesh_options);
    return Attempt{std::move(zone), std::move(remeshed)};
  };
  const auto is_better = [&](const Attempt& a, const Attempt& b) {
    return shortfall(a.remeshed, options.min_quality) < shortfall(b.remeshed, options.min_quality);
  };
  const auto zone_of = [&](int more) { return neighbourhoods(corefined, *inputs, size, options.bandwidth, more); };

  Zone narrow = zone_of(0);
  const bool irregular = alike && mean_input_quality(narrow, corefined) < limits.regular_input;
  const int start = !options.bandwidth && irregular ? limits.more_at_once : 0;
  Zone first = start > 0 ? zone_of(start) : std::move(narrow);
  if (const auto face = collapsed_face(complex, first)) return tl::unexpected(collapsed_fault(complex, *face));
  Attempt best = attempt(std::move(first));
  int widened = 0;
  // Wider is better nearly always; where it is not, because it reaches other sheets, the narrow zone may be.
  for (const int more : {limits.more, 0}) {
    if (options.bandwidth || more == start || best.remeshed.mean_quality >= wanted) continue;
    Zone other_zone = zone_of(more);
    if (collapsed_face(complex, other_zone)) continue;
    Attempt other = attempt(std::move(other_zone));
    // Poor faces of a narrow zone are mended below.
    const bool sound = more == 0 || worst_mendable(other.remeshed) >= worst_mendable(best.remeshed);
    if (!sound || other.remeshed.mean_quality <= best.remeshed.mean_quality) continue;
    best = std::move(other), widened = more > 0 ? 1 : 0;
  }

  const int automatic = best.zone.bandwidth.empty() ? 0 : *std::ranges::max_element(best.zone.bandwidth);
  const int most = std::max(limits.max_neighbourhoods, automatic + limits.beyond);
  const auto widen_around = [&](std::vector<Vec3> places, Zone zone) {
    int in_vain = 0;  // rounds since the last one that was better
    for (int round = 1; round <= limits.max_rounds && in_vain < limits.max_in_vain && !places.empty(); ++round) {
      if (!widen(zone, corefined, *inputs, size, places, most) || collapsed_face(complex, zone)) break;
      Attempt wider = attempt(zone);
      places = mendable_places(wider.remeshed);
      ++in_vain;
      if (is_better(wider, best)) best = std::move(wider), ++widened, in_vain = 0;
    }
  };
  widen_around(mendable_places(best.remeshed), best.zone);
  if (!mendable_places(best.remeshed).empty() && !best.remeshed.let_go.empty()) {
    remesh_options.loose = best.remeshed.let_go;
    Attempt looser = attempt(best.zone);
    std::vector<Vec3> places = mendable_places(looser.remeshed);
    if (is_better(looser, best)) best = std::move(looser);
    widen_around(std::move(places), best.zone);
  }
  // Beside what is kept it may be so narrow that no good face fits on the nodes there.
  if (const std::vector<NodeRef> nodes = nodes_of_mendable(best.remeshed); !corefined.kept.empty() && !nodes.empty()) {
    Zone zone = best.zone;
    for (const std::uint32_t i : inputs->release(nodes))
      for (const FaceId f : inputs->pieces(i))
        zone.in_zone[f.value] = inputs->frozen(i) || is_collapsed(complex, f) ? 0 : 1;
    Attempt freed = attempt(std::move(zone));
    std::vector<Vec3> places = mendable_places(freed.remeshed);
    if (is_better(freed, best)) best = std::move(freed);
    widen_around(std::move(places), best.zone);
  }
  return RemeshedZone{std::move(best.remeshed), best.zone.bandwidth, widened};
}

}  // namespace meshgraft
