// Solutions on different meshes of one assembly beside each other.
#pragma once

#include <vector>

#include "geometry/box_tree.hpp"
#include "solve.hpp"
#include "structure.hpp"

namespace meshgraft::validation {

/// Carries fields from the nodes of one mesh to those of another by the nearest place on its faces.
class Interpolation {
 public:
  Interpolation(const Structure& from, const Structure& to);
  [[nodiscard]] std::vector<Vec3> operator()(const std::vector<Vec3>& field) const;

 private:
  struct Place {
    std::array<std::uint32_t, 3> nodes;
    std::array<double, 3> weight;
  };
  std::vector<Place> places_;  // by node of `to`
};

/// Modal assurance criterion of two fields on the nodes of `on`, weighted by the areas around them: 1 for fields that
/// differ by a factor only, 0 for orthogonal ones.
[[nodiscard]] double mac(const Structure& on, const std::vector<Vec3>& a, const std::vector<Vec3>& b);

/// How much of a field lies in the span of others, weighted alike: that of one other is its MAC. Neighbours in
/// frequency mix differently on each mesh; together they still span the same.
[[nodiscard]] double spanned_share(const Structure& on, const std::vector<Vec3>& field,
                                   const std::vector<std::vector<Vec3>>& by);

struct ModePair {
  std::size_t mode = 0;  // of the other solution
  double mac = 0;
};

/// For each mode of `reference` the mode of `other` that is most like it, no mode twice; `reference` is on the nodes of
/// `on`, and so are the shapes of `other` already.
[[nodiscard]] std::vector<ModePair> paired_modes(const Structure& on, const std::vector<std::vector<Vec3>>& reference,
                                                 const std::vector<std::vector<Vec3>>& other);

/// Places on one group of faces at which all meshes are compared.
struct SamplePoint {
  Vec3 at;
  double thickness = 0;  // of the plate there
  double area = 0;       // that it stands for
};

/// The centroids of those of `faces` that are farther than `margin` from every place where the exact stress may be
/// infinite: edges of more than two faces, folds, held edges.
[[nodiscard]] std::vector<SamplePoint> sample_points(const Structure& structure,
                                                     const std::vector<std::uint32_t>& faces, double margin);

/// The field `of_faces` at these points, on any mesh of the same assembly: means over the faces of the group and of
/// equal thickness around each node, linear between nodes.
///
/// REQUIRES: `faces` has some of each thickness that `points` have.
[[nodiscard]] std::vector<double> sampled(const Structure& structure, const std::vector<std::uint32_t>& faces,
                                          const std::vector<double>& of_faces, const std::vector<SamplePoint>& points);

struct StressSummary {
  double p95 = 0, max = 0;  // 95 % of the area have at most p95
};

/// Of the stresses at `points`.
[[nodiscard]] StressSummary stress_summary(const std::vector<SamplePoint>& points, const std::vector<double>& stress);

}  // namespace meshgraft::validation
