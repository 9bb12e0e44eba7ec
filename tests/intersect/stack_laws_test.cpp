// Laws of three and four meshes that lie on each other, over random plates and those that were once wrong.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "checks.hpp"
#include "plate_stacks.hpp"

namespace meshgraft {
namespace {

using checks::PlatePair;

double number(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000) / 1000.0; }

/// Two or three plates on the base, over its middle or its border, of any edge length; some share its lattice.
std::vector<PlatePair> any_stack() {
  const bool aligned = *rc::gen::arbitrary<bool>();
  PlatePair frame;
  frame.base_jitter = aligned ? 0 : *rc::gen::element(0.0, 0.3);
  frame.noise = *rc::gen::element(0.0, 0.0, 1e-15, 1e-13, 1e-9, 1e-6, 1e-5);
  frame.tilt = *rc::gen::element(0.0, 1.0) * number(0, 1.5);
  frame.staggered = *rc::gen::arbitrary<bool>();
  std::vector<PlatePair> stack(static_cast<std::size_t>(*rc::gen::inRange(2, 4)), frame);
  for (PlatePair& p : stack) {
    p.x = number(0, 3.5), p.y = number(0, 3.5), p.turn = number(0, std::numbers::pi);
    p.length = number(1.5, 4), p.width = number(1.5, 4);
    p.size = *rc::gen::element(1.0, 1.0, 0.43, 0.8, 1.7);
    p.jitter = aligned ? 0 : *rc::gen::element(0.0, 0.3);
    if (!aligned) continue;
    p.size = *rc::gen::element(1.0, 1.0, 0.5);
    p.turn = *rc::gen::element(0.0, 0.5, 1.0, 2.0) * std::numbers::pi / 2;
    p.x = std::round(p.x / p.size) * p.size, p.y = std::round(p.y / p.size) * p.size;
    p.length = std::round(p.length), p.width = std::round(p.width);
  }
  return stack;
}

std::vector<std::string> faults(const std::vector<PlatePair>& stack) {
  const std::vector<Model> models = checks::models(stack);
  GroupSets sets;
  const auto after = corefine(checks::complex_of(models, sets), sets, {});
  if (!after) return {after.error().what};
  return checks::faults(stack, models, *after, sets);
}

RC_GTEST_PROP(StackLaws, NoLayerIsLostOrCountedTwice, ()) {
  const std::vector<PlatePair> stack = any_stack();
  for (const PlatePair& pair : stack) RC_LOG() << checks::to_string(pair) << ",\n";
  const auto found = faults(stack);
  for (const std::string& fault : found) RC_LOG() << fault << '\n';
  RC_ASSERT(found.empty());
}

TEST(Stack, ThreePlatesOverOnePlaceAreOneLayer) {
  const std::vector<PlatePair> stack{{.x = 1.1, .y = 1.2, .length = 3, .width = 2, .turn = 0.3},
                                     {.x = 1.7, .y = 0.9, .length = 2.5, .width = 3, .turn = 0.1, .size = 0.43},
                                     {.x = 2, .y = 1, .length = 3, .width = 3, .size = 0.8}};
  for (const std::string& fault : faults(stack)) ADD_FAILURE() << fault;
}

/// The upper plate is not within the tolerance of the base, but of the plate on it; whichever is joined first, and
/// with the plate between larger or smaller than the upper one.
TEST(Stack, EachPlateMayLieOnTheNextAtADistance) {
  const PlatePair lower{.x = 1, .y = 1, .length = 4, .width = 4, .turn = 0.1, .height = 0.008};
  PlatePair upper{.x = 1.9, .y = 1.8, .length = 2, .width = 2, .turn = 0.2, .height = 0.016};
  PlatePair side = upper;
  side.height = -0.008;
  for (const auto& stack : {std::vector{lower, upper}, std::vector{upper, lower}, std::vector{upper, side, lower},
                            std::vector{lower, side, upper}})
    for (const std::string& fault : faults(stack)) ADD_FAILURE() << fault;
}

/// A face of the third plate lay in a slit between the first two, less than the tolerance wide, that was closed.
TEST(Stack, ASlitThatAnotherPlateFillsIsNotClosed) {
  const PlatePair first{.x = 0, .y = 2.478, .length = 1.5, .width = 1.5, .turn = 1.0744246875277093};
  const PlatePair second{
      .x = 1.0255, .y = 0.6895, .length = 3.1725, .width = 1.5, .turn = 2.1174334485195203, .size = 0.8, .jitter = 0.3};
  const PlatePair third{
      .x = 2.1105, .y = 2.2155, .length = 3.4175, .width = 3.0775, .turn = 1.9980529276831085, .size = 0.43};
  std::vector<PlatePair> stack{first, second, third};
  for (PlatePair& p : stack) p.base_jitter = 0.3, p.staggered = true;
  for (const std::string& fault : faults(stack)) ADD_FAILURE() << fault;
}

}  // namespace
}  // namespace meshgraft
