#include "condyle/pictures/scene_page.h"

#include <algorithm>
#include <array>
#include <utility>

#include "condyle/pictures/joint_axes.h"
#include "condyle/pictures/knee_picture.h"
#include "condyle/pictures/pen.h"

namespace condyle {
namespace {

constexpr int kPanelWide = 1000, kPanelHigh = 750;  // of one picture [pixel]
constexpr int kLine = 26, kMargin = 30;
constexpr std::array<View, 6> kViews = {View::kAnterior, View::kPosterior, View::kMedial,
                                        View::kLateral,  View::kCondyles,  View::kPlateau};

/// A line cut into as many as it takes to stay within the width.
std::vector<std::string> wrapped(Canvas& canvas,
                                 const std::string& text,
                                 double room,
                                 const TextStyle& style) {
  std::vector<std::string> lines;
  std::string line, word;
  const auto put = [&] {
    if (word.empty()) return;
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && canvas.text_width(longer, style) > room) {
      lines.push_back(std::exchange(line, "    " + word));
    } else {
      line = longer;
    }
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ')
      put();
    else
      word += c;
  }
  put();
  if (!line.empty()) lines.push_back(line);
  return lines;
}

/// What the arrows mean.
void draw_axis_key(const Pen& pen, double x, double y) {
  const std::array<std::pair<const char*, Rgb>, 3> keys = {
      {{"lateral", kLateralColor}, {"anterior", kAnteriorColor}, {"proximal", kProximalColor}}};
  const TextStyle style = pen.style(17);
  const auto write = [&](const std::string& text, const TextStyle& how) {
    pen.canvas.text({x, y}, text, how);
    x += pen.canvas.text_width(text, how);
  };
  write("Frames of the joint, the femur's thick, the tibia's thin:   ", style);
  for (const auto& [word, color] : keys) {
    pen.canvas.line({x, y - 6}, {x + 34, y - 6}, 5, color);
    x += 42;
    write(std::string(word) + "     ", style);
  }
}

}  // namespace

Image draw_scene_page(const Run& run, const std::vector<std::string>& remarks) {
  Image measure = blank_image(8, 8, {255, 255, 255});
  Canvas ruler(measure);
  const TextStyle style = Pen{ruler, 1}.style(17);
  std::vector<std::string> lines;
  if (!remarks.empty()) lines.emplace_back("To look at:");
  for (const std::string& remark : remarks)
    for (const std::string& line :
         wrapped(ruler, "- " + remark, 2 * kPanelWide - 2 * kMargin, style))
      lines.push_back(line);

  const int pictures = kPanelHigh * static_cast<int>(kViews.size()) / 2;
  const int below = 2 * kMargin + kLine * (1 + static_cast<int>(lines.size()));
  Image page = blank_image(2 * kPanelWide, pictures + below, {255, 255, 255});
  PictureOptions options;
  options.width = kPanelWide;
  options.height = kPanelHigh;
  options.frames = true;
  KneePictures knee(run, options);
  for (std::size_t i = 0; i < kViews.size(); ++i)
    paste(knee.draw(kViews[i], 0), page, static_cast<int>(i % 2) * kPanelWide,
          static_cast<int>(i / 2) * kPanelHigh);

  Canvas canvas(page);
  const Pen pen{canvas, 1};
  double y = pictures + kMargin;
  draw_axis_key(pen, kMargin, y);
  for (const std::string& line : lines) canvas.text({double(kMargin), y += kLine}, line, style);
  return page;
}

}  // namespace condyle
