#include "tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meshgraft::validation {
namespace {

// The aims of the study.
constexpr double kLeastShare = 0.9;   // a mode of which the modes of a mesh span less is lost
constexpr double kWorstError = 0.01;  // of a frequency of a merged mesh, against the refined one
constexpr double kMeanError = 0.004;

double relative(double value, double reference) { return value / reference - 1; }

/// A row of a table; the first cell is the heading of the row.
void add_row(std::string& text, const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) text += "| " + cell + ' ';
  text += "|\n";
}

void add_heading(std::string& text, const std::vector<std::string>& cells) {
  add_row(text, cells);
  for (std::size_t k = 0; k < cells.size(); ++k) text += "|---";
  text += "|\n";
}

/// How the frequencies of a case differ from those of the refined one, mode by mode of the latter.
struct Agreement {
  std::vector<double> frequency, error;
  std::vector<ModePair> pairs;
  double mean = 0, worst = 0, least_share = 1;
};

Agreement agreement(const Case& refined, const Case& other, std::size_t n_modes) {
  const Structure& on = other.structure;
  const Interpolation carry(refined.structure, on);
  std::vector<std::vector<Vec3>> shapes;
  for (std::size_t k = 0; k < n_modes; ++k) shapes.push_back(carry(refined.response.shape[k]));
  Agreement a;
  a.pairs = paired_modes(on, shapes, other.response.shape);
  for (std::size_t k = 0; k < n_modes; ++k) {
    a.frequency.push_back(other.response.frequency[a.pairs[k].mode]);
    a.error.push_back(relative(a.frequency[k], refined.response.frequency[k]));
    a.mean += std::abs(a.error[k]) / static_cast<double>(n_modes);
    a.worst = std::max(a.worst, std::abs(a.error[k]));
    a.least_share = std::min(a.least_share, spanned_share(on, shapes[k], other.response.shape));
  }
  return a;
}

/// Of the figures of the meshes from CAD.
class Range {
 public:
  void add(double value) { values_.push_back(value), low = std::min(low, value), high = std::max(high, value); }
  /// From the nearest of them.
  [[nodiscard]] double distance(double value) const {
    double least = std::numeric_limits<double>::infinity();
    for (const double v : values_) least = std::min(least, std::abs(value - v));
    return least;
  }
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

 private:
  std::vector<double> values_;
};

class Writer {
 public:
  Writer(const std::vector<Case>& cases, const Study& study, double margin)
      : cases_(cases), study_(study), margin_(margin) {
    refined_ = &*std::ranges::find(cases, Role::kRefined, &Case::role);
    for (const Case& c : cases)
      if (c.role != Role::kRefined) others_.push_back(&c);
  }

  Tables write() {
    meshes();
    frequencies();
    stresses();
    return std::move(tables_);
  }

 private:
  void meshes() {
    std::string& text = tables_.text;
    std::vector<std::string> heading{""}, nodes{"nodes"}, faces{"faces"}, worst{"worst Q"}, mean{"mean Q"};
    for (const Case& c : cases_) {
      std::vector<double> q;
      for (std::size_t f = 0; f < c.structure.faces.size(); ++f) q.push_back(aspect_ratio(c.structure.corners(f)));
      heading.push_back(c.name);
      nodes.push_back(fmt::format("{}", c.structure.position.size()));
      faces.push_back(fmt::format("{}", q.size()));
      worst.push_back(fmt::format("{:.3f}", *std::ranges::min_element(q)));
      mean.push_back(fmt::format("{:.3f}", std::reduce(q.begin(), q.end()) / static_cast<double>(q.size())));
    }
    add_heading(text, heading);
    for (const auto& row : {nodes, faces, worst, mean}) add_row(text, row);
    for (std::size_t g = 0; g < study_.reported.size(); ++g) {
      std::vector<std::string> row{"faces in " + study_.reported[g]};
      for (const Case& c : cases_) row.push_back(fmt::format("{}", c.structure.reported_faces[g].size()));
      add_row(text, row);
    }
    text += '\n';
  }

  void frequencies() {
    std::vector<Agreement> agreements;
    for (const Case* c : others_) agreements.push_back(agreement(*refined_, *c, study_.n_modes));

    std::string& text = tables_.text;
    std::vector<std::string> heading{"mode", refined_->name + ", Hz"};
    for (const Case* c : others_) heading.push_back(c->name);
    heading.push_back("least MAC");
    add_heading(text, heading);
    for (std::size_t k = 0; k < study_.n_modes; ++k) {
      std::vector<std::string> row{fmt::format("{}", k + 1), fmt::format("{:.2f}", refined_->response.frequency[k])};
      double least = 1;
      for (const Agreement& a : agreements) {
        row.push_back(fmt::format("{:.2f} ({:+.2f} %)", a.frequency[k], 100 * a.error[k]));
        least = std::min(least, a.pairs[k].mac);
      }
      row.push_back(fmt::format("{:.4f}", least));
      add_row(text, row);
    }
    std::vector<std::string> worst{"worst", ""}, mean{"mean", ""};
    for (const Agreement& a : agreements) {
      worst.push_back(fmt::format("{:.2f} %", 100 * a.worst));
      mean.push_back(fmt::format("{:.2f} %", 100 * a.mean));
    }
    worst.emplace_back(), mean.emplace_back();
    add_row(text, worst);
    add_row(text, mean);
    text += '\n';
    judge(agreements);
  }

  void judge(const std::vector<Agreement>& agreements) {
    Range cad_worst, cad_mean;
    for (std::size_t i = 0; i < others_.size(); ++i)
      if (others_[i]->role == Role::kCad) cad_worst.add(agreements[i].worst), cad_mean.add(agreements[i].mean);
    for (std::size_t i = 0; i < others_.size(); ++i) {
      const Agreement& a = agreements[i];
      const std::string& name = others_[i]->name;
      if (a.least_share < kLeastShare)
        unmet(fmt::format("{}: a mode is lost ({:.0f} % of it found)", name, 100 * a.least_share));
      if (others_[i]->role != Role::kMerged) continue;
      if (a.worst > kWorstError) unmet(fmt::format("{}: a frequency is {:.2f} % off", name, 100 * a.worst));
      if (a.mean > kMeanError) unmet(fmt::format("{}: frequencies are {:.2f} % off in the mean", name, 100 * a.mean));
      if (a.worst > cad_worst.high || a.mean > cad_mean.high)
        unmet(
            fmt::format("{}: frequencies are {:.2f} % off at worst and {:.2f} % in the mean, meshes from CAD at most "
                        "{:.2f} % and {:.2f} %",
                        name, 100 * a.worst, 100 * a.mean, 100 * cad_worst.high, 100 * cad_mean.high));
    }
  }

  void stresses() {
    std::string& text = tables_.text;
    std::vector<std::string> heading{"group"};
    for (const Case& c : cases_) heading.push_back(c.name);
    add_heading(text, heading);
    for (std::size_t g = 0; g < study_.reported.size(); ++g) {
      std::vector<std::string> row{study_.reported[g]};
      std::vector<StressSummary> found;
      Range p95, max;
      const std::vector<SamplePoint> points =
          sample_points(refined_->structure, refined_->structure.reported_faces[g], margin_);
      for (std::size_t i = 0; i < cases_.size(); ++i) {
        const Case& c = cases_[i];
        found.push_back(
            stress_summary(points, sampled(c.structure, c.structure.reported_faces[g], c.response.von_mises, points)));
        row.push_back(fmt::format("{:.2f}, {:.2f}", found[i].p95, found[i].max));
        if (c.role == Role::kCad) p95.add(found[i].p95), max.add(found[i].max);
      }
      add_row(text, row);
      for (std::size_t i = 0; i < cases_.size(); ++i)
        if (cases_[i].role == Role::kMerged) {
          compare(cases_[i].name, "95 % stress of " + study_.reported[g], found[i].p95, p95);
          compare(cases_[i].name, "largest stress of " + study_.reported[g], found[i].max, max);
        }
    }
  }

  /// A merged mesh may differ from the nearest mesh from CAD as much as these differ among themselves.
  void compare(const std::string& name, const std::string& what, double value, const Range& cad) {
    if (cad.distance(value) > cad.high - cad.low)
      unmet(fmt::format("{}: {} is {:.2f}, that of the meshes from CAD {:.2f} to {:.2f}", name, what, value, cad.low,
                        cad.high));
  }

  void unmet(std::string what) { tables_.unmet.push_back(std::move(what)); }

  const std::vector<Case>& cases_;
  const Study& study_;
  double margin_;
  const Case* refined_;
  std::vector<const Case*> others_;
  Tables tables_;
};

}  // namespace

Tables tables_of(const std::vector<Case>& cases, const Study& study, double margin) {
  return Writer(cases, study, margin).write();
}

std::string convergence_of(const std::vector<Case>& cases, const std::vector<Case>& finer, const Study& study) {
  const Case& refined = *std::ranges::find(cases, Role::kRefined, &Case::role);
  std::string text;
  add_heading(text, {"mesh", "faces", "mode 1", "worst", "mean"});
  const auto add = [&](const Case& c) {
    const Agreement a = agreement(refined, c, study.n_modes);
    add_row(text, {c.name, fmt::format("{}", c.structure.faces.size()), fmt::format("{:+.2f} %", 100 * a.error.front()),
                   fmt::format("{:.2f} %", 100 * a.worst), fmt::format("{:.2f} %", 100 * a.mean)});
  };
  for (const Case& c : cases)
    if (&c != &refined) add(c);
  for (const Case& c : finer) add(c);
  return text;
}

}  // namespace meshgraft::validation
