// Mending of single faces.
#include <algorithm>
#include <functional>

#include "remesh/improve.hpp"

namespace meshgraft {
namespace {

constexpr int kRounds = 6;                // sweeps over the poor faces
constexpr double kDeviationWeight = 1.5;  // of the deviation beyond what is allowed, in the cost
constexpr double kLeastGain = 0.01;       // absolute, of the cost; below it a change is not worth making

class Mender {
 public:
  Mender(Editor& editor, double target) : editor_(editor), target_(target) {}

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      std::vector<std::pair<double, FaceId>> poor;
      for (std::size_t k = 0; k < mesh().n_faces(); ++k) {
        const LocalFace& f = mesh().face(FaceId(k));
        if (f.alive && f.in_zone && is_poor(FaceId(k))) poor.emplace_back(f.q, FaceId(k));
      }
      std::ranges::sort(poor);
      bool better = false;
      for (const auto& [q, f] : poor) {
        editor_.forget();
        if (mesh().face(f).alive && is_poor(f)) better = mend(f) || better;
      }
      if (!better) return;
    }
  }

 private:
  [[nodiscard]] const LocalMesh& mesh() const { return editor_.mesh(); }

  bool is_poor(FaceId f) { return mesh().face(f).q < target_ || editor_.deviation(f) > 1; }

  /// All vertices of faces on the given vertices, ascending.
  [[nodiscard]] std::vector<VertexId> ring(std::span<const VertexId> of) const {
    std::vector<VertexId> all;
    for (const VertexId v : of)
      for (const FaceId f : mesh().star(v)) all.insert(all.end(), mesh().face(f).v.begin(), mesh().face(f).v.end());
    std::ranges::sort(all);
    const auto repeated = std::ranges::unique(all);
    all.erase(repeated.begin(), repeated.end());
    return all;
  }

  double cost_around(std::span<const VertexId> vertices) {
    faces_.clear();
    for (const VertexId v : vertices)
      for (const FaceId f : mesh().star(v))
        if (mesh().face(f).in_zone) faces_.push_back(f);
    std::ranges::sort(faces_);
    const auto repeated = std::ranges::unique(faces_);
    faces_.erase(repeated.begin(), repeated.end());
    double sum = editor_.cost(faces_);
    for (const FaceId f : faces_) sum += kDeviationWeight * std::max(0.0, editor_.deviation(f) - 1);
    return sum;
  }

  /// Runs one change and relaxes `around` after it; keeps it if the region costs less.
  bool gains(const std::function<bool()>& change, std::span<const VertexId> around, std::span<const VertexId> region,
             double before) {
    const auto start = editor_.mark();
    if (!change()) return false;
    const auto n_vertices = mesh().n_vertices();
    for (int sweep = 0; sweep < 2; ++sweep) {
      for (const VertexId v : around)
        if (!mesh().star(v).empty()) editor_.relax(v);
      if (added_.valid() && added_.value < n_vertices) editor_.relax(added_);
    }
    std::vector<VertexId> all(region.begin(), region.end());
    if (added_.valid()) all.push_back(added_);
    if (cost_around(all) < before - kLeastGain) return true;
    editor_.undo(start);
    return false;
  }

  bool mend(FaceId f) {
    const std::array<VertexId, 3> v = mesh().face(f).v;
    bool better = false;
    for (const VertexId u : v) better = editor_.relax(u) || better;
    if (better && (!mesh().face(f).alive || !is_poor(f))) return true;
    for (const VertexId u : v) better = editor_.sharpen(u) || better;
    if (better && !is_poor(f)) return true;
    return change_topology(v) || better;
  }

  bool change_topology(const std::array<VertexId, 3>& v) {
    const std::vector<VertexId> near = ring(v);
    const std::vector<VertexId> region = ring(near);
    const double before = cost_around(region);
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      added_ = VertexId{};
      if (gains([&] { return editor_.flip(a, b); }, near, region, before)) return true;
    }
    for (const VertexId u : v) {
      added_ = VertexId{};
      if (gains([&] { return editor_.remove(u); }, near, region, before)) return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      const auto split = [&] {
        const auto added = editor_.split(a, b);
        if (added) added_ = *added;
        return added.has_value();
      };
      added_ = VertexId{};
      if (gains(split, near, region, before)) return true;
    }
    return false;
  }

  Editor& editor_;
  double target_;
  VertexId added_;  // by the split under trial
  std::vector<FaceId> faces_;
};

}  // namespace

void mend(Editor& editor, double target) { Mender(editor, target).run(); }

}  // namespace meshgraft
