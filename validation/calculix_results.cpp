#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "calculix.hpp"

namespace meshgraft::validation {
namespace {

Failure stopped_early(const std::string& file, const std::string& what) {
  return failure(ErrorCode::kMalformed, what, "see what ccx printed", {file, 0});
}

/// A number in columns [first, first + width) of a line; none if there is none.
std::optional<double> number(const std::string& line, std::size_t first, std::size_t width) {
  if (line.size() < first + width) return {};
  const std::string field = line.substr(first, width);
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  return end == field.c_str() ? std::nullopt : std::optional(value);
}

/// The displacement fields of a .frd file, in the ASCII form of CGX: blocks between a line `100CL` and a line `-3`, one
/// line `-1` for each node.
class FieldReader {
 public:
  FieldReader(const std::string& path, std::size_t n_nodes) : path_(path), n_nodes_(n_nodes) {}

  Result<void> read_into(Response& response) {
    std::ifstream in(path_);
    if (!in) return failure(ErrorCode::kCannotRead, "cannot be read", "", {path_, 0});
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with("  100CL")) continue;
      const bool modal = line.find("MODAL") != std::string::npos;
      const auto frequency = number(line, kValue, kWidth);
      auto field = displacements(in);
      if (!field) return Failure(field.error());
      if (!modal) {
        response.displacement = std::move(*field);
      } else {
        if (!frequency) return stopped_early(path_, "a mode without frequency");
        response.frequency.push_back(*frequency);
        response.shape.push_back(std::move(*field));
      }
    }
    return {};
  }

 private:
  static constexpr std::size_t kValue = 12, kNumber = 3, kNumberWidth = 10, kFirst = 13, kWidth = 12;

  Result<std::vector<Vec3>> displacements(std::istream& in) {
    std::vector<Vec3> field(n_nodes_);
    std::size_t found = 0;
    for (std::string line; std::getline(in, line) && !line.starts_with(" -3");) {
      if (!line.starts_with(" -1")) continue;
      const auto node = number(line, kNumber, kNumberWidth);
      if (!node || *node < 1) return stopped_early(path_, "a line without node: " + line);
      const auto at = static_cast<std::size_t>(*node) - 1;
      if (at >= n_nodes_) continue;  // the middle of an edge
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = number(line, kFirst + axis * kWidth, kWidth);
        if (!value) return stopped_early(path_, "a displacement that cannot be read: " + line);
        field[at][axis] = *value;
      }
      ++found;
    }
    if (found != n_nodes_)
      return stopped_early(path_, fmt::format("{} nodes of {} have a displacement", found, n_nodes_));
    return field;
  }

  std::string path_;
  std::size_t n_nodes_;
};

struct StressTensor {
  std::array<double, 6> s{};  // xx, yy, zz, xy, xz, yz
  [[nodiscard]] double von_mises() const {
    const auto square = [](double a) { return a * a; };
    return std::sqrt((square(s[0] - s[1]) + square(s[1] - s[2]) + square(s[2] - s[0])) / 2 +
                     3 * (square(s[3]) + square(s[4]) + square(s[5])));
  }
};

/// The larger von Mises stress of both surfaces above the centroid, from nine integration points: three layers of
/// three, whose outer ones are at -+sqrt(3/5) of half the thickness.
double surface_stress(const std::array<StressTensor, 9>& points) {
  StressTensor low, high;
  for (std::size_t k = 0; k < 6; ++k) {
    const double bottom = (points[0].s[k] + points[1].s[k] + points[2].s[k]) / 3;
    const double top = (points[6].s[k] + points[7].s[k] + points[8].s[k]) / 3;
    const double middle = (bottom + top) / 2, bent = (top - bottom) / 2 / std::sqrt(0.6);
    low.s[k] = middle - bent, high.s[k] = middle + bent;
  }
  return std::max(low.von_mises(), high.von_mises());
}

Result<std::vector<double>> read_stresses(const std::string& path, std::size_t n_faces) {
  std::ifstream in(path);
  if (!in) return failure(ErrorCode::kCannotRead, "cannot be read", "", {path, 0});
  std::vector<std::array<StressTensor, 9>> points(n_faces);
  std::size_t found = 0;
  std::string line;
  while (std::getline(in, line) && !line.starts_with(" stresses")) {
  }
  std::getline(in, line);  // blank
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::size_t face = 0, point = 0;
    StressTensor stress;
    if (!(fields >> face >> point)) break;
    for (double& s : stress.s) fields >> s;
    if (!fields || face < 1 || face > n_faces || point < 1 || point > 9)
      return stopped_early(path, "a line of stresses that cannot be read: " + line);
    points[face - 1][point - 1] = stress;
    ++found;
  }
  if (found != 9 * n_faces) return stopped_early(path, fmt::format("{} stresses, not {}", found, 9 * n_faces));
  std::vector<double> largest;
  for (const auto& p : points) largest.push_back(surface_stress(p));
  return largest;
}

}  // namespace

Result<Response> read_calculix(const std::string& job, const Structure& structure) {
  Response response;
  if (const auto read = FieldReader(job + ".frd", structure.position.size()).read_into(response); !read)
    return Failure(read.error());
  if (response.frequency.empty() || response.displacement.empty())
    return stopped_early(job + ".frd", "no modes, or no displacements of the static step");
  auto stresses = read_stresses(job + ".dat", structure.faces.size());
  if (!stresses) return Failure(stresses.error());
  response.von_mises = std::move(*stresses);
  return response;
}

}  // namespace meshgraft::validation
