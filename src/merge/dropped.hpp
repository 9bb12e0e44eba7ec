// Pieces of a corefined complex, and what becomes of the complex when some of them are taken out.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "intersect/corefine.hpp"
#include "merge/node_places.hpp"
#include "meshgraft/graft.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft {

/// What an operation took out or added on purpose, so that no check takes it for a fault.
struct Dropped {
  using Segment = std::array<Vec3, 2>;
  std::vector<Segment> borders;     // edges that became free
  std::vector<Segment> free_edges;  // free edges that went
  std::vector<double> area;         // by merged group, of the faces that went; empty: nothing went
  std::vector<double> length;       // by merged group, of the 1D elements that went

  [[nodiscard]] bool touches(GroupId g) const { return touched.size() > g.value && touched[g.value] != 0; }
  [[nodiscard]] double area_of(GroupId g) const { return area.size() > g.value ? area[g.value] : 0; }
  [[nodiscard]] double length_of(GroupId g) const { return length.size() > g.value ? length[g.value] : 0; }
  [[nodiscard]] double stretched_area_of(GroupId g) const {
    return stretched_area.size() > g.value ? stretched_area[g.value] : 0;
  }
  [[nodiscard]] double stretched_length_of(GroupId g) const {
    return stretched_length.size() > g.value ? stretched_length[g.value] : 0;
  }
  std::vector<std::uint8_t> touched;  // by merged group: 1 if a member went or lost a face around it
  /// By input, ascending: whole elements that went and are neither faces of the complex nor lines on
  /// their edges. The amounts above are without them.
  std::vector<std::vector<ElementId>> elements;
  /// By merged group: what faces and 1D elements have grown by (less than 0: shrunk) because nodes were moved to
  /// close gaps; empty: none was.
  std::vector<double> stretched_area, stretched_length;
  std::vector<double> filled_area;  // by merged group: of faces that fill holes; empty: none does
  [[nodiscard]] double filled_area_of(GroupId g) const {
    return filled_area.size() > g.value ? filled_area[g.value] : 0;
  }
  double slack = 0;                 // area between curved borders and their chords, by which amounts may differ
  std::vector<double> facet_slack;  // by merged group: the same for facets laid on others; empty: none was
  [[nodiscard]] double slack_of(GroupId g) const {
    return slack + (facet_slack.size() > g.value ? facet_slack[g.value] : 0);
  }
};

/// By face: the piece it is in, named after its smallest face. Faces that share an edge are in one piece,
/// unless the edge is one of `borders` ((smaller, larger) vertex, ascending) or they are of different
/// components.
[[nodiscard]] std::vector<std::uint32_t> pieces_of(const Complex& complex,
                                                   std::span<const std::array<VertexId, 2>> borders);

/// Takes the marked faces out, and the lines that lie on none but their edges. Vertices keep their ids.
/// Junction edges, junction points and meetings are found anew. What went is added to `dropped`.
///
///   marked    by face
///   sets      the groups of the complex, of `n_groups` merged groups
void drop_faces(Corefined& corefined, std::span<const std::uint8_t> marked, const GroupSets& sets, std::size_t n_groups,
                Dropped& dropped);

/// Adds what faces and lines of the workpiece have grown by because nodes of theirs were moved. Faces that lay on
/// others (Corefined::covered) are not looked at: they went.
void add_stretch(const Complex& original, const Corefined& corefined, const NodePlaces& places, const GroupSets& sets,
                 std::size_t n_groups, Dropped& dropped);

/// Adds by how much what was laid on faces may have been larger or smaller than they are: 1 / cos of the angle between
/// the two, as facets of curved surfaces that do not match lean on each other.
void add_facet_slack(const Complex& corefined, const NodePlaces& places, const GroupSets& sets, std::size_t n_groups,
                     Dropped& dropped);

/// The entry of the report for faces of one input.
[[nodiscard]] DroppedEntry entry_of(const Complex& complex, std::span<const FaceId> faces, const GroupSets& sets,
                                    std::span<const MergedGroup> groups);

}  // namespace meshgraft
