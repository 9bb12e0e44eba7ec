#include "merge/remesh_zone.hpp"

#include <algorithm>

#include "geometry/quality.hpp"
#include "merge/quality_summary.hpp"
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

double worst_mendable(const Remeshed& remeshed) {
  double worst = 1;
  for (const BadFace& bad : remeshed.bad)
    if (!is_unavoidable(bad)) worst = std::min(worst, bad.q);
  return worst;
}

}  // namespace

RemeshedZone remesh_zone(const Complex& original, const Corefined& corefined, GroupSets& groups,
                         const MergeOptions& options, const WidenLimits& limits) {
  const Complex& complex = corefined.complex;
  const Brep brep = read_brep(complex, corefined.junction_edges, corefined.junction_points, groups);
  SizeOptions size_options;
  size_options.junction_size = options.size;
  const SizeField size(original, complex, brep, size_options);
  RemeshOptions remesh_options;
  remesh_options.min_quality = options.min_quality;

  Zone zone = neighbourhoods(corefined, brep, size, options.bandwidth);
  RemeshedZone best{remesh(complex, brep, size, zone.in_zone, groups, remesh_options), zone.bandwidth, 0};
  std::vector<Vec3> places = mendable_places(best.remeshed);
  for (int round = 1; round <= limits.max_rounds && !places.empty(); ++round) {
    if (!widen(zone, corefined, places, limits.max_neighbourhoods)) break;
    Remeshed wider = remesh(complex, brep, size, zone.in_zone, groups, remesh_options);
    places = mendable_places(wider);
    if (worst_mendable(wider) > worst_mendable(best.remeshed)) best = {std::move(wider), zone.bandwidth, round};
  }
  return best;
}

}  // namespace meshgraft
