#include "condyle/pictures/label_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "condyle/pictures/page_scales.h"

namespace condyle {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
bool cross_each_other(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 &&
         cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

std::vector<Vector2d> scattered(int n, unsigned seed) {
  std::vector<Vector2d> anchors;
  for (int i = 0; i < n; ++i) {
    const auto next = [&] { return (seed = seed * 1664525u + 1013904223u) / 4294967296.0; };
    const double x = 320 + 160 * next();
    anchors.emplace_back(x, 260 + 120 * next());
  }
  return anchors;
}

TEST(LabelLayout, NoLeaderLinesOfAColumnCrossAndNoLabelsOverlap) {
  const Frame frame{100, 50, 700, 550};
  for (unsigned seed = 0; seed < 50; ++seed) {
    const auto anchors = scattered(14, seed);
    const auto placed = place_labels(anchors, frame, 38);
    ASSERT_EQ(placed.size(), anchors.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (placed[i].left != placed[j].left) continue;
        EXPECT_GE(std::abs(placed[i].at.y() - placed[j].at.y()), 38 - 1e-9);
        EXPECT_FALSE(cross_each_other(placed[i].at, anchors[placed[i].index], placed[j].at,
                                      anchors[placed[j].index]));
      }
    }
  }
}

TEST(LabelLayout, EveryAnchorHasOneLabelInsideTheFrameWhereThereIsRoom) {
  const Frame frame{100, 50, 700, 550};
  const auto placed = place_labels(scattered(9, 7), frame, 38);
  std::vector<int> seen(9, 0);
  for (const PlacedLabel& label : placed) {
    ++seen[label.index];
    EXPECT_EQ(label.at.x(), label.left ? frame.left : frame.right);
    EXPECT_GE(label.at.y(), frame.top);
    EXPECT_LE(label.at.y(), frame.bottom);
  }
  EXPECT_EQ(seen, std::vector<int>(9, 1));
}

TEST(LabelLayout, NothingToPlaceIsNothingPlaced) {
  EXPECT_TRUE(place_labels({}, {0, 0, 10, 10}, 5).empty());
}

TEST(ScaleBar, HasARoundLengthThatFits) {
  for (const auto& [longest, length] : {std::pair{39.0, 20.0},
                                        {20.0, 20.0},
                                        {4.9, 2.0},
                                        {1.5, 1.0},
                                        {0.07, 0.05},
                                        {700.0, 500.0},
                                        {999.0, 500.0}})
    EXPECT_DOUBLE_EQ(scale_bar_length(longest), length) << longest;
}

}  // namespace
}  // namespace condyle
