// Mending of single faces.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "remesh/improve.hpp"

namespace meshgraft {
namespace {

constexpr int kRounds = 6;  // sweeps over the poor faces
/// If more than this share of the faces of the zone are poor, the wish is a high one; then a sweep that lowers by less
/// than this share what they lack together is the last.
constexpr double kMany = 0.05, kLeastProgress = 0.02;
constexpr double kDeviationWeight = 1.5;  // of the deviation beyond what is allowed, in the cost
constexpr double kLeastGain = 0.01;       // absolute, of the cost; below it a change is not worth making
constexpr int kEvenGain = 2;    // of a flip: excess at its ends less that opposite; this keeps the sum of squares
constexpr double kSafe = 0.05;  // above the wanted worst Q: faces better than that may pay for others
constexpr double kIdealAngle = std::numbers::pi / 3;  // of a corner of a face

/// Which ids were seen since it was last told to forget.
class Sightings {
 public:
  void forget() { ++round_; }
  bool is_first(std::size_t id) {
    if (id >= last_.size()) last_.resize(2 * id + 1, 0);
    return std::exchange(last_[id], round_) != round_;
  }

 private:
  std::vector<std::uint32_t> last_;  // by id: the round it was last seen in
  std::uint32_t round_ = 1;
};

class Mender {
 public:
  Mender(Editor& editor, double target) : editor_(editor), target_(target) {}

  void run() {
    double before = std::numeric_limits<double>::infinity();  // what the poor faces lacked together
    for (int round = 0; round < kRounds; ++round) {
      std::vector<std::pair<double, FaceId>> poor;
      double all = 0, lack = 0;
      for (std::size_t k = 0; k < mesh().n_faces(); ++k) {
        const FaceId f(k);
        if (!mesh().face(f).alive || !mesh().face(f).in_zone) continue;
        ++all;
        if (is_poor(f)) poor.emplace_back(mesh().face(f).q, f), lack += lack_of(f);
      }
      if (static_cast<double>(poor.size()) > kMany * all && lack > (1 - kLeastProgress) * before) return;
      before = lack;
      std::ranges::sort(poor);
      bool better = false;
      for (const auto& [q, f] : poor) {
        editor_.forget();
        if (mesh().face(f).alive && is_poor(f)) better = mend(f) || better;
      }
      if (!better) return;
    }
  }

  /// Changes that bring vertices nearer to their ideal number of faces.
  void regularise(Irregularity wanted) {
    least_gain_ = wanted == Irregularity::kLess ? kEvenGain + 1 : kEvenGain;
    waiting_.assign(mesh().n_vertices(), 1);
    for (int round = 0; round < kRounds; ++round) {
      bool better = false;
      for (std::size_t k = 0; k < mesh().n_vertices(); ++k) {
        if (!std::exchange(waiting_[k], std::uint8_t{0}) || !is_loose(VertexId(k)) || is_settled(editor_, VertexId(k)))
          continue;
        editor_.forget();
        better = regularise(VertexId(k)) || better;
      }
      if (!better) return;
    }
  }

 private:
  [[nodiscard]] const LocalMesh& mesh() const { return editor_.mesh(); }

  /// A vertex of a sheet that may go.
  [[nodiscard]] bool is_loose(VertexId v) const {
    const LocalVertex& vertex = mesh().vertex(v);
    return !vertex.fixed && !vertex.curve.valid() && !mesh().star(v).empty();
  }
  [[nodiscard]] SheetId sheet_of(VertexId v) const { return mesh().face(mesh().star(v)[0]).sheet; }

  /// Faces of a sheet at a vertex beyond the number of equilateral ones that its angle there has room for.
  [[nodiscard]] int excess(VertexId v, SheetId sheet) const {
    double angle = 0;
    int n = 0;
    for (const FaceId f : mesh().star(v)) {
      const LocalFace& face = mesh().face(f);
      if (face.sheet != sheet) continue;
      const std::size_t k = face.corner_of(v);
      const Vec3 a = mesh().position(face.v[(k + 1) % 3]) - mesh().position(v),
                 b = mesh().position(face.v[(k + 2) % 3]) - mesh().position(v);
      angle += std::atan2(norm(cross(a, b)), dot(a, b)), ++n;
    }
    return n - std::max(1, static_cast<int>(std::lround(angle / kIdealAngle)));
  }

  bool regularise(VertexId v) {
    const SheetId sheet = sheet_of(v);
    const int own = excess(v, sheet);
    const std::array<VertexId, 1> only_v{v};
    if (own < 0) return gains(only_v, [&] { return editor_.remove(v); });
    if (own == 0) return false;
    for (const VertexId u : ring(only_v)) {
      const FacesOfEdge faces = mesh().faces_at(u, v);
      if (u == v || faces.size() != 2) continue;
      std::array<VertexId, 4> at{u, v};
      for (const std::size_t i : {0u, 1u})
        for (const VertexId w : mesh().face(faces[i]).v)
          if (w != u && w != v) at[2 + i] = w;
      const int gain = own + excess(u, sheet) - excess(at[2], sheet) - excess(at[3], sheet);
      if (gain >= least_gain_ && gains(at, [&] { return editor_.flip(u, v); })) return true;
    }
    return false;
  }

  /// The same for a change at the given vertices, with what is around them.
  bool gains(std::span<const VertexId> at, const std::function<bool()>& change) {
    const std::vector<VertexId> near = ring(at), region = ring(near);
    added_ = VertexId{};
    if (!gains(change, near, region, state_of(region))) return false;
    for (const VertexId w : near) waiting_[w.value] = 1;
    return true;
  }

  bool is_poor(FaceId f) { return (mesh().face(f).q < target_ && !is_settled(editor_, f)) || editor_.deviation(f) > 1; }

  /// How far a poor face is from what is wanted.
  double lack_of(FaceId f) {
    return std::max(0.0, target_ - mesh().face(f).q) + std::max(0.0, editor_.deviation(f) - 1);
  }

  /// All vertices of faces on the given vertices, ascending.
  [[nodiscard]] std::vector<VertexId> ring(std::span<const VertexId> of) {
    std::vector<VertexId> all;
    seen_vertices_.forget();
    for (const VertexId v : of)
      for (const FaceId f : mesh().star(v))
        for (const VertexId w : mesh().face(f).v)
          if (seen_vertices_.is_first(w.value)) all.push_back(w);
    std::ranges::sort(all);
    return all;
  }

  /// The faces around some vertices.
  struct State {
    double cost = 0, worst = 1;  // Q of the worst
  };

  State state_of(std::span<const VertexId> vertices) {
    faces_.clear(), seen_faces_.forget();
    for (const VertexId v : vertices)
      for (const FaceId f : mesh().star(v))
        if (mesh().face(f).in_zone && seen_faces_.is_first(f.value)) faces_.push_back(f);
    std::ranges::sort(faces_);
    State state{editor_.cost(faces_)};
    for (const FaceId f : faces_) {
      state.cost += kDeviationWeight * std::max(0.0, editor_.deviation(f) - 1);
      state.worst = std::min(state.worst, mesh().face(f).q);
    }
    return state;
  }

  /// Costs less, and is not bought with a face poorer than wanted.
  [[nodiscard]] bool is_better(const State& after, const State& before) const {
    const double least = std::min(before.worst, editor_.options().min_quality + kSafe);
    return after.cost < before.cost - kLeastGain && after.worst >= least;
  }

  /// Runs one change and relaxes `around` after it; keeps it if the region is better.
  bool gains(const std::function<bool()>& change, std::span<const VertexId> around, std::span<const VertexId> region,
             const State& before) {
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
    if (is_better(state_of(all), before)) return true;
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
    const State before = state_of(region);
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
  int least_gain_ = 0;                 // of a flip that regularises
  VertexId added_;                     // by the split under trial
  std::vector<std::uint8_t> waiting_;  // by vertex: to be regularised, for something around it has changed
  std::vector<FaceId> faces_;
  Sightings seen_vertices_, seen_faces_;
};

}  // namespace

void regularise(Editor& editor, Irregularity wanted) { Mender(editor, 0).regularise(wanted); }

void mend(Editor& editor, double target) { Mender(editor, target).run(); }

}  // namespace meshgraft
