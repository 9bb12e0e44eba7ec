// Flat-shaded pictures of triangles, with exact hidden surfaces also where faces pass through each other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshgraft/vec3.hpp"

namespace meshgraft::draw {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// How an edge of a face is drawn.
enum class Stroke : std::uint8_t { kThin, kFree, kJunction, kLine };

struct Face {
  std::array<Vec3, 3> corner;
  std::array<Stroke, 3> stroke;  // of the edge opposite to each corner
  Colour fill;
};

/// Parallel projection.
struct View {
  double azimuth = 0;    // radians around z from the x axis: where the eye is
  double elevation = 0;  // radians above the plane of x and y
  Vec3 centre;           // what is in the middle of the picture
  double half_height = 1;
  std::uint32_t width = 900, height = 640;  // pixels
  double thin = 0.9, thick = 2.6;           // widths of strokes in pixels
};

struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<Colour> pixels;  // row by row from the top
};

/// The same view, moved and scaled to show all of the faces.
[[nodiscard]] View fitted(View view, std::span<const Face> faces);

[[nodiscard]] Image render(std::span<const Face> faces, const View& view);

}  // namespace meshgraft::draw
