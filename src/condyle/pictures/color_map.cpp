#include "condyle/pictures/color_map.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace condyle {
namespace {

constexpr std::array<Rgb, 10> kViridis = {{{68, 1, 84},
                                           {72, 40, 120},
                                           {62, 73, 137},
                                           {49, 104, 142},
                                           {38, 130, 142},
                                           {31, 158, 137},
                                           {53, 183, 121},
                                           {110, 206, 88},
                                           {181, 222, 43},
                                           {253, 231, 37}}};
constexpr std::array<Rgb, 10> kPlasma = {{{13, 8, 135},
                                          {70, 3, 159},
                                          {114, 1, 168},
                                          {156, 23, 158},
                                          {189, 55, 134},
                                          {216, 87, 107},
                                          {237, 121, 83},
                                          {251, 159, 58},
                                          {253, 202, 38},
                                          {240, 249, 33}}};

constexpr std::array<Rgb, 9> kYlGnBu = {{{8, 29, 88},
                                         {37, 52, 148},
                                         {34, 94, 168},
                                         {29, 145, 192},
                                         {65, 182, 196},
                                         {127, 205, 187},
                                         {199, 233, 180},
                                         {237, 248, 177},
                                         {255, 255, 217}}};

constexpr std::array<Rgb, 9> kPuRd = {{{247, 244, 249},
                                       {231, 225, 239},
                                       {212, 185, 218},
                                       {201, 148, 199},
                                       {223, 101, 176},
                                       {231, 41, 138},
                                       {206, 18, 86},
                                       {152, 0, 67},
                                       {103, 0, 31}}};

constexpr std::array<Rgb, 11> kRdBu = {{{5, 48, 97},
                                        {33, 102, 172},
                                        {67, 147, 195},
                                        {146, 197, 222},
                                        {209, 229, 240},
                                        {247, 247, 247},
                                        {253, 219, 199},
                                        {244, 165, 130},
                                        {214, 96, 77},
                                        {178, 24, 43},
                                        {103, 0, 31}}};

Rgb interpolate(std::span<const Rgb> anchors, double t) {
  const double x = t * static_cast<double>(anchors.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), anchors.size() - 2);
  const double w = x - static_cast<double>(i);
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] =
        static_cast<std::uint8_t>(std::lround((1 - w) * anchors[i][c] + w * anchors[i + 1][c]));
  }
  return color;
}

}  // namespace

Rgb map_color(ColorMap map, double t) {
  const double s = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.0;
  switch (map) {
    case ColorMap::kStrain:
      return interpolate(kPlasma, 0.8 * s);
    case ColorMap::kFlexion:
      return interpolate(kViridis, 0.95 * s);
    case ColorMap::kGap:
      return interpolate(kYlGnBu, s);
    case ColorMap::kPressure:
      return interpolate(kPuRd, 0.2 + 0.8 * s);
    case ColorMap::kDiverging:
      return interpolate(kRdBu, s);
  }
  return {};
}

}  // namespace condyle
