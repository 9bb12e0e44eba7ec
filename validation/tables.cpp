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

using Format = std::string (*)(double);
std::string whole(double v) { return fmt::format("{:.0f}", v); }
std::string three_decimals(double v) { return fmt::format("{:.3f}", v); }
std::string two_decimals(double v) { return fmt::format("{:.2f}", v); }
std::string percent(double v) { return fmt::format("{:.2f} %", 100 * v); }
std::string signed_percent(double v) { return fmt::format("{:+.2f} %", 100 * v); }

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

/// Columns: the refined mesh, all meshes from CAD together, each merged mesh.
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
  void heading(const std::string& rows, const std::string& unit = "", const std::string& last = "") {
    std::vector<std::string> cells{rows, refined_->name + unit};
    cells.push_back(fmt::format("{} from CAD", std::ranges::count(cases_, Role::kCad, &Case::role)));
    for (const Case* c : merged()) cells.push_back(c->name);
    if (!last.empty()) cells.push_back(last);
    add_heading(tables_.text, cells);
  }

  [[nodiscard]] std::vector<const Case*> merged() const {
    std::vector<const Case*> found;
    for (const Case* c : others_)
      if (c->role == Role::kMerged) found.push_back(c);
    return found;
  }

  /// The figures of the meshes from CAD, from the least to the largest.
  [[nodiscard]] std::string cad_range(Format format, const std::vector<double>& of_others) const {
    Range range;
    for (std::size_t i = 0; i < others_.size(); ++i)
      if (others_[i]->role == Role::kCad) range.add(of_others[i]);
    const std::string low = format(range.low), high = format(range.high);
    return low == high ? low : low + " to " + high;
  }

  /// A figure of each case.
  template <class F>
  void figures(const std::string& name, Format format, F&& of) {
    std::vector<double> of_others;
    for (const Case* c : others_) of_others.push_back(of(*c));
    std::vector<std::string> cells{name, format(of(*refined_)), cad_range(format, of_others)};
    for (const Case* c : merged()) cells.push_back(format(of(*c)));
    add_row(tables_.text, cells);
  }

  void meshes() {
    const auto q = [](const Case& c) {
      std::vector<double> values;
      for (std::size_t f = 0; f < c.structure.faces.size(); ++f) values.push_back(aspect_ratio(c.structure.corners(f)));
      return values;
    };
    heading("");
    figures("nodes", whole, [](const Case& c) { return static_cast<double>(c.structure.position.size()); });
    figures("faces", whole, [](const Case& c) { return static_cast<double>(c.structure.faces.size()); });
    figures("worst Q", three_decimals, [&](const Case& c) { return std::ranges::min(q(c)); });
    figures("mean Q", three_decimals, [&](const Case& c) {
      const std::vector<double> values = q(c);
      return std::reduce(values.begin(), values.end()) / static_cast<double>(values.size());
    });
    for (std::size_t g = 0; g < study_.reported.size(); ++g)
      figures("faces in " + study_.reported[g], whole,
              [&](const Case& c) { return static_cast<double>(c.structure.reported_faces[g].size()); });
    tables_.text += '\n';
  }

  void frequencies() {
    std::vector<Agreement> agreements;
    for (const Case* c : others_) agreements.push_back(agreement(*refined_, *c, study_.n_modes));

    std::string& text = tables_.text;
    heading("mode", ", Hz", "least MAC");
    for (std::size_t k = 0; k < study_.n_modes; ++k) {
      std::vector<double> errors;
      double least = 1;
      for (const Agreement& a : agreements) errors.push_back(a.error[k]), least = std::min(least, a.pairs[k].mac);
      std::vector<std::string> row{fmt::format("{}", k + 1), two_decimals(refined_->response.frequency[k]),
                                   cad_range(signed_percent, errors)};
      for (std::size_t i = 0; i < others_.size(); ++i)
        if (others_[i]->role == Role::kMerged)
          row.push_back(fmt::format("{:.2f} ({})", agreements[i].frequency[k], signed_percent(errors[i])));
      row.push_back(fmt::format("{:.4f}", least));
      add_row(text, row);
    }
    for (const auto& [name, of] : {std::pair{"worst", &Agreement::worst}, {"mean", &Agreement::mean}}) {
      std::vector<double> values;
      for (const Agreement& a : agreements) values.push_back(a.*of);
      std::vector<std::string> row{name, "", cad_range(percent, values)};
      for (std::size_t i = 0; i < others_.size(); ++i)
        if (others_[i]->role == Role::kMerged) row.push_back(percent(values[i]));
      row.emplace_back();
      add_row(text, row);
    }
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
    heading("group");
    for (std::size_t g = 0; g < study_.reported.size(); ++g) {
      const std::vector<SamplePoint> points =
          sample_points(refined_->structure, refined_->structure.reported_faces[g], margin_);
      const auto summary = [&](const Case& c) {
        return stress_summary(points,
                              sampled(c.structure, c.structure.reported_faces[g], c.response.von_mises, points));
      };
      const auto cell = [](const StressSummary& s) { return two_decimals(s.p95) + ", " + two_decimals(s.max); };
      std::vector<double> p95, max;
      std::vector<std::string> of_merged;
      for (const Case* c : others_) {
        const StressSummary s = summary(*c);
        p95.push_back(s.p95), max.push_back(s.max);
        if (c->role == Role::kMerged) of_merged.push_back(cell(s));
      }
      std::vector<std::string> row{study_.reported[g], cell(summary(*refined_)),
                                   cad_range(two_decimals, p95) + ", " + cad_range(two_decimals, max)};
      row.insert(row.end(), of_merged.begin(), of_merged.end());
      add_row(tables_.text, row);
      compare("95 % stress of " + study_.reported[g], p95);
      compare("largest stress of " + study_.reported[g], max);
    }
  }

  /// A merged mesh may differ from the nearest mesh from CAD as much as these differ among themselves.
  void compare(const std::string& what, const std::vector<double>& of_others) {
    Range cad;
    for (std::size_t i = 0; i < others_.size(); ++i)
      if (others_[i]->role == Role::kCad) cad.add(of_others[i]);
    for (std::size_t i = 0; i < others_.size(); ++i)
      if (others_[i]->role == Role::kMerged && cad.distance(of_others[i]) > cad.high - cad.low)
        unmet(fmt::format("{}: {} is {:.2f}, that of the meshes from CAD {:.2f} to {:.2f}", others_[i]->name, what,
                          of_others[i], cad.low, cad.high));
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

std::string convergence_of(const std::vector<Case>& cases, const std::vector<Case>& others, const Study& study) {
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
  for (const Case& c : others) add(c);
  return text;
}

}  // namespace meshgraft::validation
