/// A surface that is moved is the same surface elsewhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <memory>
#include <vector>

#include "condyle/surface/exact_surfaces.h"
#include "condyle/surface/patch.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

std::vector<std::unique_ptr<Surface>> one_of_each() {
  std::vector<std::unique_ptr<Surface>> all;
  all.push_back(make_plane({1, 2, 3}, {1, -2, 2}, 12));
  all.push_back(make_sphere({-4, 0, 2}, 20, true));
  all.push_back(make_cylinder({3, 3, -1}, {0, 1, 1}, 9, false, 25));
  all.push_back(make_ellipsoid({0, 5, 1}, Eigen::Matrix3d::Identity(), {10, 14, 22}, true));
  all.push_back(make_torus({2, -2, 0}, {1, 1, 0}, 25, 6, true));
  all.push_back(make_polynomial({1, 1, 1}, Eigen::Matrix3d::Identity(),
                                {{2, 0, 0.01}, {0, 2, 0.02}, {1, 2, 1e-4}}, true, 15));
  PatchData data;
  data.nu = data.nv = 7;
  for (int i = 0; i < data.nu + 4; ++i) data.knots_u.push_back(4.0 * (i - 3));
  data.knots_v = data.knots_u;
  for (int i = 0; i < data.nu; ++i)
    for (int j = 0; j < data.nv; ++j)
      data.control_points.emplace_back(4 * i, 4 * j, 0.1 * i * i - 0.05 * i * j);
  all.push_back(std::make_unique<Patch>(std::move(data)));
  return all;
}

TEST(Translated, SurfacesKeepTheirShapeNormalsAndEdges) {
  const Vector3d d(900, -2500, 300);
  for (const auto& surface : one_of_each()) {
    const std::unique_ptr<Surface> moved = surface->translated(d);
    const std::vector<Place> places = surface->samples(4), there = moved->samples(4);
    ASSERT_GT(places.size(), 10u);
    ASSERT_EQ(places.size(), there.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      const SurfacePoint a = surface->evaluate(places[k]), b = moved->evaluate(there[k]);
      EXPECT_LT((a.c + d - b.c).norm(), 1e-11);
      EXPECT_LT((a.n - b.n).norm(), 1e-11);
      EXPECT_LT((a.K - b.K).norm(), 1e-11);
      const double edge = surface->edge_distance(places[k]);
      if (std::isinf(edge))
        EXPECT_EQ(moved->edge_distance(there[k]), edge);
      else
        EXPECT_NEAR(moved->edge_distance(there[k]), edge, 1e-10);
      const Vector3d p = a.c + 0.5 * a.n;
      const Place q = moved->closest(p + d, moved->seed(p + d));
      EXPECT_LT((moved->evaluate(q).c - d - a.c).norm(), 1e-6);
    }
  }
}

TEST(Translated, ExtentsMoveAlongAndHoldTheKnownPart) {
  const Vector3d d(900, -2500, 300);
  for (const auto& surface : one_of_each()) {
    const Extent here = surface->extent(), there = surface->translated(d)->extent();
    EXPECT_LT((here.center + d - there.center).norm(), 1e-10);
    EXPECT_NEAR(here.radius, there.radius, 1e-10);
    double farthest = 0, nearest = 1e300;
    for (const Place& place : surface->samples(1)) {
      const double away = (surface->evaluate(place).c - here.center).norm();
      farthest = std::max(farthest, away);
      nearest = std::min(nearest, away);
    }
    EXPECT_GE(here.radius, nearest);
    EXPECT_LE(here.radius, farthest + 1e-9);
  }
}

TEST(Translated, WhatGoesOnForEverHasNoExtent) {
  EXPECT_TRUE(std::isinf(make_plane({0, 0, 0}, {0, 0, 1})->extent().radius));
  EXPECT_TRUE(std::isinf(make_cylinder({0, 0, 0}, {0, 0, 1}, 5, true)->extent().radius));
}

}  // namespace
}  // namespace condyle
