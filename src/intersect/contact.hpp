// Which faces of two sides lie on each other, and what of one side lies beneath a point of the
// other (paper 2.4, 4: face/face mode).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box_tree.hpp"
#include "intersect/corefine.hpp"
#include "intersect/meeting.hpp"

namespace meshgraft {

/// Lengths and angles of contact between faces of a size (mean edge length of the input face).
struct ContactRule {
  const CorefineOptions& options;
  const SnapRule& snap;
  /// Faces nearer than this lie on each other: the tolerance, however large.
  [[nodiscard]] double gap(double size) const;
  /// Features of both sides nearer than this, seen along the normal, are one. A large tolerance closes
  /// gaps across surfaces and is no licence to shift things along them.
  [[nodiscard]] double beside(double size) const;
  [[nodiscard]] double weld(double size) const { return snap.at(size).weld; }
  [[nodiscard]] bool is_flat(Vec3 unit_normal, Vec3 other) const;
};

/// Faces of two sides that are flat to each other and come nearer than the gap.
struct Contacts {
  std::vector<std::array<FaceId, 2>> pairs;  // ascending
  /// By pair: within the gap over most of the area that they, and each of them and the other side, have in
  /// common; or without common area and so near that snapping may give them some. None if there is no area, and not
  /// where faces abut around a fold from others that lie on each other.
  std::vector<std::uint8_t> on_each_other;
};
/// `reach`: by face, see FaceMarks; may be empty. `lying_at`: by face, its corners as contact is told by them; empty:
/// where they are.
[[nodiscard]] Contacts find_contacts(const Complex& complex, std::span<const FaceId> first,
                                     std::span<const FaceId> second, std::span<const double> size,
                                     const ContactRule& rule, std::span<const Reach> reach = {},
                                     std::span<const Triangle> lying_at = {});

/// Whether one of two faces lies over part of the other, seen along the normal of the first, at any height.
[[nodiscard]] bool have_common_area(const Triangle& t, const Triangle& u);

/// Faces of one side as a surface to ask.
class Cover {
 public:
  Cover() = default;
  /// `unit_normal`: of the surface at each face, which may be bent there. `corners` tell which faces are neighbours.
  Cover(std::vector<Triangle> faces, std::vector<double> size, std::vector<Vec3> unit_normal,
        std::span<const std::array<VertexId, 3>> corners);

  struct Foot {
    std::uint32_t face = 0;  // position in the list
    Vec3 point;              // the nearest of the surface
    double height = 0;       // of the point asked above the face, along its normal; signed
    double beside = 0;       // how far it is off the face, along the face
    bool on_border = false;  // the nearest point is on the border of the surface
  };
  /// Call only if there are faces.
  [[nodiscard]] Foot foot(Vec3 p) const;
  /// True if a point of a face with this normal lies on the surface.
  [[nodiscard]] bool covers(Vec3 p, Vec3 unit_normal, const ContactRule& rule) const;
  [[nodiscard]] bool empty() const { return faces_.empty(); }

 private:
  void find_border(std::span<const std::array<VertexId, 3>> corners);

  std::vector<Triangle> faces_;
  std::vector<double> size_;
  std::vector<Vec3> unit_normal_;
  std::vector<std::array<std::uint8_t, 3>> border_edge_, border_corner_;  // by face; edge k runs from corner k
  BoxTree tree_;
};

}  // namespace meshgraft
