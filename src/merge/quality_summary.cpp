#include "merge/quality_summary.hpp"

#include <algorithm>

#include "geometry/quality.hpp"

namespace meshgraft {
namespace {

constexpr double kExcused = 0.1;  // Q below which no input is an excuse: that of an angle of 3.5 degrees
constexpr double kWorse = 0.99;   // share of its Q that rounding leaves a face
constexpr std::size_t kWorstListed = 10;
constexpr double kFirstPercentile = 0.01;

struct FaceQuality {
  double q = 0;
  FaceId face;
  friend constexpr auto operator<=>(const FaceQuality&, const FaceQuality&) = default;
};

/// The remesher's word on each poor face, ascending by face.
class Causes {
 public:
  explicit Causes(std::span<const BadFace> bad) : bad_(bad.begin(), bad.end()) {
    std::ranges::sort(bad_, {}, &BadFace::face);
  }
  [[nodiscard]] const BadFace* find(FaceId f) const {
    const auto it = std::ranges::lower_bound(bad_, f, {}, &BadFace::face);
    return it != bad_.end() && it->face == f ? &*it : nullptr;
  }

 private:
  std::vector<BadFace> bad_;
};

/// A face that is kept and has become poor because a corner of it is at another place.
bool is_made_poor(const Outcome& outcome, FaceId f, double min_quality) {
  if (outcome.is_new(f) || !outcome.is_changed(f)) return false;
  const double q = aspect_ratio(outcome.final_complex.corners(f));
  const ElementRef parent = outcome.final_complex.parent[f.value];
  return q < min_quality && q < kWorse * aspect_ratio(outcome.inputs[parent.input]->corners(parent.element));
}

/// "3 new faces", "1 face that stays", "3 faces, 1 of which stays".
std::string counted(const Outcome& outcome, const std::vector<FaceQuality>& faces) {
  const std::size_t n = faces.size();
  const auto stays = static_cast<std::size_t>(
      std::ranges::count_if(faces, [&](const FaceQuality& f) { return !outcome.is_new(f.face); }));
  const std::string number = std::to_string(n), ending = n == 1 ? "" : "s", verb = stays == 1 ? " stays" : " stay";
  if (stays == 0) return number + " new face" + ending;
  if (stays == n) return number + " face" + ending + " that" + verb;
  return number + " faces, " + std::to_string(stays) + " of which" + verb + ",";
}

std::string finding(const Outcome& outcome, const std::vector<FaceQuality>& faces, const Causes& causes,
                    double min_quality) {
  const FaceQuality& worst = faces.front();
  const BadFace* bad = causes.find(worst.face);
  std::string text = counted(outcome, faces) + (faces.size() == 1 ? " has" : " have") + " Q below " +
                     text_of(min_quality) + "; the worst, Q " + text_of(worst.q) + ", is " + outcome.text(worst.face);
  if (bad != nullptr && !bad->cause.text.empty())
    text += ": " + bad->cause.text;
  else if (!outcome.is_new(worst.face))
    text += ": a node of it was moved";
  return text;
}

/// `keeps`: what lies on the other mesh is kept, and its nodes with it.
std::string hint_for(const BadFace* bad, OperationKind kind, bool keeps) {
  using enum Cause::Kind;
  if (kind == OperationKind::kFill) return "give another --size or --blend, a smaller --min-quality, or --allow-poor";
  // Nodes that are kept are where they are, whatever the size and the width of the zone beside them.
  const std::string others =
      keeps ? "--overlap fuse, which remeshes the side that is kept too" : "another --size or --bandwidth";
  const bool between_lines = bad != nullptr && (bad->cause.kind == kStrip || bad->cause.kind == kFixedNodes ||
                                                bad->cause.kind == kInputDetail);
  if (between_lines && kind == OperationKind::kCut)
    return "where the tool is meant to run along a line, give a larger --tolerance, or move it; else another --size or "
           "--bandwidth, a smaller --min-quality, or --allow-poor";
  if (bad != nullptr && is_unavoidable(*bad))
    return "the meshes are that narrow there, which no --size or --bandwidth changes: where two lines are meant to be "
           "one, make them one in the input (`meshgraft check` lists its poor triangles), give a larger --tolerance, "
           "or "
           "--trim beyond=LENGTH for what sticks out; else give --allow-poor";
  if (between_lines)
    return "where two lines are meant to be one, give a larger --tolerance, or --trim beyond=LENGTH for what sticks "
           "out; else " +
           others + ", a smaller --min-quality, or --allow-poor";
  return "give " + others + ", a smaller --min-quality, or --allow-poor";
}

}  // namespace

bool is_unavoidable(const BadFace& bad) {
  return bad.cause.kind == Cause::Kind::kInputAngle || bad.cause.kind == Cause::Kind::kInputDetail;
}

bool is_excused(const BadFace& bad) {
  return (is_unavoidable(bad) || bad.cause.kind == Cause::Kind::kFixedEdges) && bad.q >= kExcused;
}

QualityVerdict quality_of(const Outcome& outcome, std::span<const BadFace> bad, double min_quality) {
  const Complex& complex = outcome.final_complex;
  std::vector<FaceQuality> faces;
  for (std::size_t f = 0; f < complex.n_faces(); ++f)
    if (outcome.is_new(FaceId(f)) || is_made_poor(outcome, FaceId(f), min_quality))
      faces.push_back({aspect_ratio(complex.corners(FaceId(f))), FaceId(f)});
  std::sort(faces.begin(), faces.end());

  QualityVerdict verdict;
  QualitySummary& s = verdict.summary;
  s.faces = faces.size();
  if (faces.empty()) return verdict;
  s.min = faces.front().q;
  s.p01 = faces[static_cast<std::size_t>(kFirstPercentile * static_cast<double>(faces.size() - 1))].q;
  double sum = 0;
  for (const FaceQuality& f : faces) sum += f.q;
  s.mean = sum / static_cast<double>(faces.size());

  const Causes causes(bad);
  std::vector<FaceQuality> avoidable, unavoidable;
  for (const FaceQuality& f : faces) {
    const BadFace* cause = causes.find(f.face);
    if (s.worst.size() < kWorstListed)
      s.worst.push_back(
          {f.q, centroid(complex.corners(f.face)), outcome.label(f.face), cause ? cause->cause.text : ""});
    if (f.q >= min_quality) continue;
    ++s.below;
    (cause != nullptr && is_excused(*cause) ? unavoidable : avoidable).push_back(f);
  }
  if (!avoidable.empty())
    verdict.broken.push_back(
        {ErrorCode::kPromiseBroken, finding(outcome, avoidable, causes, min_quality),
         hint_for(causes.find(avoidable.front().face), outcome.kind, !outcome.corefined.kept.empty()),
         outcome.parent_place(avoidable.front().face)});
  if (!unavoidable.empty())
    verdict.warnings.push_back({"poor-face", finding(outcome, unavoidable, causes, min_quality),
                                outcome.parent_place(unavoidable.front().face)});
  return verdict;
}

}  // namespace meshgraft
