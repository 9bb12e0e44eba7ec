#include "structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

namespace meshgraft::validation {
namespace {

constexpr std::uint32_t kNoNode = 0xFFFFFFFF;

/// The names of the groups that an element or node is in.
std::set<std::string> names_of(const Model& model, GroupSetId set) {
  std::set<std::string> names;
  for (const GroupId g : model.group_sets.members(set)) names.insert(model.groups[g.value].name);
  return names;
}

class Builder {
 public:
  Builder(const Model& model, const Study& study) : model_(model), study_(study), place_(model.n_nodes(), kNoNode) {
    built_.reported_faces.resize(study.reported.size());
  }

  Result<Structure> build() {
    for (std::size_t e = 0; e < model_.n_elements(); ++e)
      if (model_.is_face(ElementId(e)))
        if (const auto added = add_face(ElementId(e)); !added) return Failure(added.error());
    for (std::size_t e = 0; e < model_.n_elements(); ++e)
      if (!model_.is_face(ElementId(e)))
        if (const auto added = add_other(ElementId(e)); !added) return Failure(added.error());
    for (std::size_t n = 0; n < model_.n_nodes(); ++n)
      if (names_of(model_, model_.node_groups[n]).contains(study_.clamp)) {
        if (place_[n] == kNoNode) return bad(fmt::format("held node {} has no face", model_.node_label[n]));
        built_.clamped.push_back(place_[n]);
      }
    return checked();
  }

 private:
  [[nodiscard]] Failure bad(std::string what) const {
    return failure(ErrorCode::kMalformed, std::move(what), "", {model_.path, 0});
  }

  Result<void> add_face(ElementId face) {
    const std::set<std::string> groups = names_of(model_, model_.element_groups[face.value]);
    double thickness = 0;
    for (const auto& [group, t] : study_.thickness) thickness += groups.contains(group) ? t : 0;
    if (thickness <= 0) return bad(fmt::format("face {} has no thickness", model_.element_label[face.value]));
    for (std::size_t g = 0; g < study_.reported.size(); ++g)
      if (groups.contains(study_.reported[g]))
        built_.reported_faces[g].push_back(static_cast<std::uint32_t>(built_.faces.size()));
    const auto v = model_.nodes_of(face);
    built_.faces.push_back({place(v[0]), place(v[1]), place(v[2])});
    built_.thickness.push_back(thickness);
    built_.pressed.push_back(groups.contains(study_.pressed));
    return {};
  }

  Result<void> add_other(ElementId e) {
    if (model_.shape(e) != Shape::kLine)
      return bad(fmt::format("element {} is neither triangle nor line", model_.element_label[e.value]));
    if (!names_of(model_, model_.element_groups[e.value]).contains(study_.beams)) return {};
    const auto v = model_.nodes_of(e);
    const std::array beam{place_[v[0].value], place_[v[1].value]};
    if (std::ranges::find(beam, kNoNode) != beam.end())
      return bad(fmt::format("beam {} has a node without a face", model_.element_label[e.value]));
    built_.beams.push_back(beam);
    return {};
  }

  [[nodiscard]] Result<Structure> checked() {
    for (std::size_t g = 0; g < study_.reported.size(); ++g)
      if (built_.reported_faces[g].empty()) return bad("no face in group " + study_.reported[g]);
    if (!study_.beams.empty() && built_.beams.empty()) return bad("no line in group " + study_.beams);
    if (built_.clamped.empty()) return bad("no node in group " + study_.clamp);
    if (std::ranges::find(built_.pressed, true) == built_.pressed.end())
      return bad("no face in group " + study_.pressed);
    return std::move(built_);
  }

  std::uint32_t place(NodeId node) {
    std::uint32_t& p = place_[node.value];
    if (p == kNoNode) {
      p = static_cast<std::uint32_t>(built_.position.size());
      built_.position.push_back(model_.position[node.value]);
    }
    return p;
  }

  const Model& model_;
  const Study& study_;
  std::vector<std::uint32_t> place_;  // by node of the model
  Structure built_;
};

}  // namespace

Result<Study> read_study(const std::string& path) {
  std::ifstream in(path);
  if (!in) return failure(ErrorCode::kCannotRead, "cannot be read", "", {path, 0});
  try {
    const auto json = nlohmann::json::parse(in);
    Study study;
    study.young = json.at("young");
    study.poisson = json.at("poisson");
    study.density = json.at("density");
    study.thickness = json.at("shells").get<std::map<std::string, double>>();
    study.beams = json.at("beams").at("group");
    study.beam_width = json.at("beams").at("width");
    const auto& normal = json.at("beams").at("normal");
    study.beam_normal = {normal.at(0), normal.at(1), normal.at(2)};
    study.clamp = json.at("clamp");
    study.pressed = json.at("pressure").at("group");
    study.pressure = json.at("pressure").at("value");
    study.reported = json.at("reported").get<std::vector<std::string>>();
    study.n_modes = json.at("modes");
    study.spare_modes = json.at("spare_modes");
    return study;
  } catch (const nlohmann::json::exception& e) {
    return failure(ErrorCode::kMalformed, e.what(), "", {path, 0});
  }
}

Result<Structure> structure_of(const Model& model, const Study& study) { return Builder(model, study).build(); }

}  // namespace meshgraft::validation
