#include "fill/unfollowed.hpp"

#include <array>
#include <map>

#include "merge/inputs.hpp"

namespace meshgraft {
namespace {

struct Words {
  const char* why;
  const char* advice;
};

Words words_for(Obstacle why) {
  switch (why) {
    case Obstacle::kNoLength:
      return {"they have no length", "make the two nodes one where they shall be one point of the surface"};
    case Obstacle::kSamePlace:
      return {"another node lies on one of theirs, and faces can be made on one of both only",
              "make the two nodes one"};
    case Obstacle::kBeside:
      return {"they pass over faces around it", "mesh them with the surface if they shall be joined to it"};
    case Obstacle::kTooSteep:
      return {"they make more than 20 degrees with the surface",
              "mesh the hole with them in your pre-processor if they shall lie in it"};
    case Obstacle::kTooLong:
      return {"they are longer than two sides of the rim", "split them"};
    case Obstacle::kCutOff:
      return {"others between them and the rim are not", "see these"};
    case Obstacle::kNoFaces:
      return {"no faces can be made along all of them", "where they cross each other, give both a node there"};
    case Obstacle::kPoorFaces:
      return {"faces beside them would be too poor to be written, or break another promise",
              "move their nodes away from others, or give a smaller --min-quality"};
  }
  return {};
}

}  // namespace

std::vector<Warning> warnings_about(std::span<const UnfollowedBeam> beams, const Model& base) {
  std::map<Obstacle, std::vector<ElementId>> elements;
  for (const UnfollowedBeam& beam : beams) elements[beam.why].push_back(beam.element);
  std::vector<Warning> warnings;
  for (const auto& [why, all] : elements) {
    const ElementId first = all.front();
    const auto ends = base.nodes_of(first);
    const auto [reason, advice] = words_for(why);
    std::string text = std::string("1D elements in a hole are not followed, because ") + reason + ": element " +
                       std::to_string(base.element_label[first.value]) + " at " +
                       text_of(midpoint(base.position[ends[0].value], base.position[ends[1].value]));
    if (all.size() > 1) text += ", and " + std::to_string(all.size() - 1) + " more";
    warnings.push_back({"beam-not-followed", text + "; " + advice, place_of(base, first)});
  }
  return warnings;
}

}  // namespace meshgraft
