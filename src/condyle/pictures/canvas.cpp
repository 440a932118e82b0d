#include "condyle/pictures/canvas.h"

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

/// Pixels whose centres lie within [low, high], widened by one for anti-aliasing and cut to [0,
/// size).
struct Span {
  int first, last;
};
Span pixels(double low, double high, int size) {
  if (!(low <= high)) return {0, -1};  // places of damaged results may lie nowhere, or anywhere
  const double end = size;
  return {static_cast<int>(std::min(end, std::max(0.0, std::floor(low - 1)))),
          static_cast<int>(std::max(-1.0, std::min(end - 1, std::ceil(high + 1))))};
}

/// Distance from p to the segment a b.
double distance_to_segment(const Eigen::Vector2d& p,
                           const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double square = ab.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(ab) / square, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

std::size_t index_of(const TextMask& mask, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
         static_cast<std::size_t>(x);
}

/// The mask grown by `radius` pixels.
TextMask grown(const TextMask& mask, int radius) {
  TextMask result = mask;
  std::fill(result.coverage.begin(), result.coverage.end(), std::uint8_t{0});
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const std::uint8_t value = mask.coverage[index_of(mask, x, y)];
      if (value == 0) continue;
      for (int dy = -radius; dy <= radius; ++dy) {
        for (int dx = -radius; dx <= radius; ++dx) {
          const int tx = x + dx, ty = y + dy;
          if (dx * dx + dy * dy > radius * radius || tx < 0 || ty < 0 || tx >= mask.width ||
              ty >= mask.height)
            continue;
          std::uint8_t& to = result.coverage[index_of(mask, tx, ty)];
          to = std::max(to, value);
        }
      }
    }
  }
  return result;
}

}  // namespace

void Canvas::blend(int x, int y, Rgb color, double opacity) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || opacity <= 0) return;
  std::uint8_t* p = image_.rgb.data() + image_.offset(x, y);
  for (std::size_t c = 0; c < 3; ++c) {
    p[c] =
        static_cast<std::uint8_t>(std::lround(p[c] + std::min(1.0, opacity) * (color[c] - p[c])));
  }
}

void Canvas::line(
    const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width, Rgb color, double opacity) {
  const double r = 0.5 * width;
  const Span xs = pixels(std::min(a.x(), b.x()) - r, std::max(a.x(), b.x()) + r, image_.width);
  const Span ys = pixels(std::min(a.y(), b.y()) - r, std::max(a.y(), b.y()) + r, image_.height);
  for (int y = ys.first; y <= ys.last; ++y) {
    for (int x = xs.first; x <= xs.last; ++x) {
      const double d = distance_to_segment({x + 0.5, y + 0.5}, a, b);
      blend(x, y, color, opacity * std::clamp(r + 0.5 - d, 0.0, std::min(1.0, width)));
    }
  }
}

void Canvas::disc(const Eigen::Vector2d& center, double radius, Rgb color, double opacity) {
  line(center, center, 2 * radius, color, opacity);
}

void Canvas::rectangle(const Frame& frame, Rgb color) {
  const auto inside = [](double low, double high, int i) {
    return std::clamp(std::min(high, i + 1.0) - std::max(low, 1.0 * i), 0.0, 1.0);
  };
  const Span xs = pixels(frame.left, frame.right, image_.width),
             ys = pixels(frame.top, frame.bottom, image_.height);
  for (int y = ys.first; y <= ys.last; ++y) {
    for (int x = xs.first; x <= xs.last; ++x) {
      blend(x, y, color, inside(frame.left, frame.right, x) * inside(frame.top, frame.bottom, y));
    }
  }
}

int Canvas::text_width(const std::string& text, const TextStyle& style) {
  return shared_font(style.bold).width(text, style.size);
}

void Canvas::text(const Eigen::Vector2d& at, const std::string& text, const TextStyle& style) {
  const TextMask letters = shared_font(style.bold).render(text, style.size, style.halo);
  const double shift = style.align == Align::kLeft ? 0 : style.align == Align::kCenter ? 0.5 : 1;
  const int left =
      static_cast<int>(std::lround(at.x() - shift * letters.advance)) - letters.origin.x();
  const int top = static_cast<int>(std::lround(at.y())) - letters.origin.y();
  const auto stamp = [&](const TextMask& mask, Rgb color, double opacity) {
    for (int y = 0; y < mask.height; ++y) {
      for (int x = 0; x < mask.width; ++x) {
        blend(left + x, top + y, color, opacity * mask.coverage[index_of(mask, x, y)] / 255.0);
      }
    }
  };
  if (style.halo > 0) stamp(grown(letters, style.halo), {255, 255, 255}, 0.85);
  stamp(letters, style.color, 1);
}

}  // namespace condyle
