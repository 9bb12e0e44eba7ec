#include "render.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshgraft::draw {
namespace {

constexpr std::uint32_t kSamples = 3;  // along each side of a pixel
constexpr Colour kPaper{255, 255, 255};
constexpr double kAmbient = 0.72;  // share of light that does not depend on the direction

Colour stroke_colour(Stroke stroke) {
  switch (stroke) {
    case Stroke::kThin:
      return {90, 96, 104};
    case Stroke::kFree:
      return {40, 44, 52};
    case Stroke::kJunction:
      return {190, 20, 30};
    case Stroke::kLine:
      return {10, 70, 190};
  }
  return {};
}

struct Axes {
  explicit Axes(const View& view)
      : towards_eye{std::cos(view.elevation) * std::cos(view.azimuth),
                    std::cos(view.elevation) * std::sin(view.azimuth), std::sin(view.elevation)},
        right{-std::sin(view.azimuth), std::cos(view.azimuth), 0},
        up(cross(towards_eye, right)) {}

  Vec3 towards_eye, right, up;
};

/// A grid of samples with the depth of what each one shows.
class Canvas {
 public:
  explicit Canvas(const View& view)
      : view_(view),
        width_(view.width * kSamples),
        height_(view.height * kSamples),
        depth_(std::size_t{width_} * height_, -std::numeric_limits<double>::infinity()),
        colour_(depth_.size(), kPaper),
        axes_(view) {
    light_ = normalized(axes_.towards_eye + 0.5 * axes_.up - 0.6 * axes_.right);
    scale_ = 0.5 * height_ / view.half_height;
  }

  void paint(const Face& face) {
    std::array<Vec3, 3> p;  // x and y in samples, z towards the eye
    for (std::size_t k = 0; k < 3; ++k) p[k] = projected(face.corner[k]);
    const double doubled_area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (doubled_area == 0) return;

    const Colour fill = shaded(face);
    std::array<double, 3> height{};  // of the corner over its opposite edge, in samples
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = p[(k + 2) % 3] - p[(k + 1) % 3];
      height[k] = std::abs(doubled_area) / std::hypot(edge.x, edge.y);
    }
    const auto [x0, x1] = sample_range(std::min({p[0].x, p[1].x, p[2].x}), std::max({p[0].x, p[1].x, p[2].x}), width_);
    const auto [y0, y1] = sample_range(std::min({p[0].y, p[1].y, p[2].y}), std::max({p[0].y, p[1].y, p[2].y}), height_);
    for (std::int64_t y = y0; y <= y1; ++y)
      for (std::int64_t x = x0; x <= x1; ++x) {
        const double sx = static_cast<double>(x) + 0.5, sy = static_cast<double>(y) + 0.5;
        std::array<double, 3> weight{};
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
          weight[k] = ((b.x - sx) * (c.y - sy) - (b.y - sy) * (c.x - sx)) / doubled_area;
        }
        if (weight[0] < 0 || weight[1] < 0 || weight[2] < 0) continue;
        const double depth = weight[0] * p[0].z + weight[1] * p[1].z + weight[2] * p[2].z;
        const std::size_t sample = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
        if (depth <= depth_[sample]) continue;
        depth_[sample] = depth;
        colour_[sample] = with_strokes(face, fill, weight, height);
      }
  }

  /// Each pixel is the mean of its samples.
  [[nodiscard]] Image image() const {
    Image image{view_.width, view_.height, {}};
    image.pixels.reserve(std::size_t{image.width} * image.height);
    for (std::uint32_t y = 0; y < image.height; ++y)
      for (std::uint32_t x = 0; x < image.width; ++x) {
        std::uint32_t red = 0, green = 0, blue = 0;
        for (std::uint32_t j = 0; j < kSamples; ++j)
          for (std::uint32_t i = 0; i < kSamples; ++i) {
            const Colour& c = colour_[(std::size_t{y} * kSamples + j) * width_ + std::size_t{x} * kSamples + i];
            red += c.red, green += c.green, blue += c.blue;
          }
        const auto mean = [](std::uint32_t sum) { return static_cast<std::uint8_t>(sum / (kSamples * kSamples)); };
        image.pixels.push_back({mean(red), mean(green), mean(blue)});
      }
    return image;
  }

 private:
  [[nodiscard]] Vec3 projected(Vec3 p) const {
    const Vec3 d = p - view_.centre;
    return {0.5 * width_ + scale_ * dot(d, axes_.right), 0.5 * height_ - scale_ * dot(d, axes_.up),
            scale_ * dot(d, axes_.towards_eye)};
  }

  static std::pair<std::int64_t, std::int64_t> sample_range(double low, double high, std::uint32_t size) {
    return {std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(low))),
            std::min<std::int64_t>(size - 1, static_cast<std::int64_t>(std::ceil(high)))};
  }

  /// Both sides of a face are lit alike.
  [[nodiscard]] Colour shaded(const Face& face) const {
    const Vec3 normal = normalized(cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]));
    const double light = kAmbient + (1 - kAmbient) * std::abs(dot(normal, light_));
    const auto lit = [&](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(c * light)); };
    return {lit(face.fill.red), lit(face.fill.green), lit(face.fill.blue)};
  }

  /// The colour of the heaviest stroke that covers a sample; half of its width lies in each face.
  [[nodiscard]] Colour with_strokes(const Face& face, Colour fill, const std::array<double, 3>& weight,
                                    const std::array<double, 3>& height) const {
    Stroke heaviest = Stroke::kThin;
    bool covered = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const double width = face.stroke[k] == Stroke::kThin ? view_.thin : view_.thick;
      if (weight[k] * height[k] > 0.5 * kSamples * width) continue;
      covered = true;
      heaviest = std::max(heaviest, face.stroke[k]);
    }
    return covered ? stroke_colour(heaviest) : fill;
  }

  View view_;
  std::uint32_t width_, height_;
  std::vector<double> depth_;
  std::vector<Colour> colour_;
  Axes axes_;
  Vec3 light_;
  double scale_ = 1;
};

}  // namespace

View fitted(View view, std::span<const Face> faces) {
  constexpr double kMargin = 1.04;
  const Axes axes(view);
  Box box;  // in the directions of the picture
  for (const Face& face : faces)
    for (const Vec3& p : face.corner) box.add(Vec3{dot(p, axes.right), dot(p, axes.up), dot(p, axes.towards_eye)});
  if (box.empty()) return view;
  const Vec3 middle = midpoint(box.low, box.high), size = box.high - box.low;
  view.centre = middle.x * axes.right + middle.y * axes.up + middle.z * axes.towards_eye;
  view.half_height = kMargin * 0.5 * std::max(size.y, size.x * view.height / view.width);
  return view;
}

Image render(std::span<const Face> faces, const View& view) {
  Canvas canvas(view);
  for (const Face& face : faces) canvas.paint(face);
  return canvas.image();
}

}  // namespace meshgraft::draw
