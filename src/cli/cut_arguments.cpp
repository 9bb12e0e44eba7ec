#include "cli/cut_arguments.hpp"

#include <array>

#include "cli/zone_options.hpp"

namespace meshgraft::cli {
namespace {

constexpr const char* kSources = "TOOL, --box, --cylinder or --plane";

Result<CutTool> box(const Typed& typed) {
  return numbers(typed, 6, "six lengths X0,Y0,Z0,X1,Y1,Z1: the lowest and the highest corner")
      .map([](const std::vector<double>& v) {
        return CutTool(BoxTool{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
      });
}

Result<CutTool> cylinder(const Typed& typed) {
  return numbers(typed, 7, "seven numbers X,Y,Z,AX,AY,AZ,R: a point of the axis, its direction, the radius")
      .map([](const std::vector<double>& v) {
        return CutTool(CylinderTool{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6]});
      });
}

Result<CutTool> plane(const Typed& typed) {
  return numbers(typed, 6, "six numbers X,Y,Z,NX,NY,NZ: a point and the normal, which points outside")
      .map([](const std::vector<double>& v) {
        return CutTool(PlaneTool{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
      });
}

Result<Drop> drop(const Typed& typed) {
  if (typed.text == "inside") return Drop{Drop::What::kInside, {}};
  if (typed.text == "outside") return Drop{Drop::What::kOutside, {}};
  return Drop{Drop::What::kGroup, typed.text};
}

}  // namespace

CutReader::CutReader(CLI::App& app) : CommandReader(app, "cut", "take out of BASE what a tool cuts off") {
  a_.name("BASE", out_.mesh.base, "mesh that is cut (UNV)");
  a_.name("TOOL", out_.tool_file, "surface that cuts (UNV), closed or open; or one of --box, --cylinder, --plane");
  add_output_options(a_);
  a_.value("--drop", "WHAT",
           "what goes: inside or outside of the tool, or, by the name of a group, the pieces next to the cut in which "
           "the group has faces; required");
  a_.value("--box", "X0,Y0,Z0,X1,Y1,Z1", "cut with a box along the axes: its lowest and highest corner");
  a_.value("--cylinder", "X,Y,Z,AX,AY,AZ,R", "cut with a cylinder: a point of its axis, the direction, the radius");
  a_.value("--plane", "X,Y,Z,NX,NY,NZ", "cut with a plane: a point and the normal, which points outside");
  add_zone_options(a_,
                   "an edge or node that must stay and is nearer to the tool than this is taken to lie on it; a length "
                   "in file units, or a share of the local edge length [default: 1%]",
                   out_.mesh);
  common_.add(a_, "no progress and no summary; errors and warnings stay", "also timings and groups that changed");
}

Result<void> CutReader::read_own() {
  if (out_.mesh.base.empty()) return a_.missing("BASE, the mesh to cut,");
  Result<void> done = read_tool();
  if (done && !a_.typed("--drop")) return a_.missing("--drop inside, outside or GROUP");
  if (done) done = store(a_, "--drop", drop, out_.drop);
  return done ? read_zone_options(a_, out_.mesh) : done;
}

Result<void> CutReader::read_tool() {
  int n = out_.tool_file.empty() ? 0 : 1;
  for (const char* option : {"--box", "--cylinder", "--plane"}) n += a_.typed(option) ? 1 : 0;
  if (n == 0) return a_.missing(std::string("what cuts, ") + kSources + ",");
  if (n > 1)
    return failure(ErrorCode::kUsage, std::string("more than one tool; give one of ") + kSources, a_.see_help());
  Result<void> done = store(a_, "--box", box, out_.tool);
  if (done) done = store(a_, "--cylinder", cylinder, out_.tool);
  if (done) done = store(a_, "--plane", plane, out_.tool);
  return done;
}

}  // namespace meshgraft::cli
