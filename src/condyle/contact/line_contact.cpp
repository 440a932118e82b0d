#include "condyle/contact/line_contact.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/contact/settle_places.h"
#include "condyle/surface/affordable_samples.h"

namespace condyle {
namespace {

constexpr double kLongest = 1e4;    // of a line, in sample spacings
constexpr double kReach = 4;        // across a line, in sample spacings
constexpr double kAligned = 0.05;   // sine between normals below which curvatures mean something
constexpr double kFound = 1e-10;    // how exactly an end is found [mm]
constexpr double kStraight = 1e-6;  // curvature of a straight line, in units of 1/spacing

/// One of the two tangential principal curvatures vanishes.
bool is_straight_at(const SurfacePoint& point, double spacing) {
  const Eigen::Vector3d x = point.n.unitOrthogonal(), y = point.n.cross(x);
  const double xx = x.dot(point.K * x), xy = x.dot(point.K * y), yy = y.dot(point.K * y);
  const double mean = (xx + yy) / 2, spread = std::hypot((xx - yy) / 2, xy);
  return std::min(std::abs(mean - spread), std::abs(mean + spread)) < kStraight / spacing;
}

bool is_ruled(const Surface& surface, double spacing) {
  std::vector<Place> places = affordable_samples(surface, 4 * spacing);
  if (places.empty())
    for (int k = 0; k < 3; ++k) places.push_back(surface.seed(spacing * Eigen::Vector3d(1, k, 2)));
  const auto straight = std::count_if(places.begin(), places.end(), [&](const Place& place) {
    return is_straight_at(surface.evaluate(place), spacing);
  });
  return 2 * static_cast<std::size_t>(straight) > places.size();
}

/// The pair of places that lies t [mm] along a line.
class Line {
 public:
  Line(const SurfacePair& surfaces,
       const ContactPlaces& start,
       const ContactLinearization& at,
       const Eigen::Vector3d& direction,
       const RigidTransform& X_BA)
      : surfaces_(surfaces), start_(start), B_(at.B), A_(at.A) {
    direction_B_ = direction;
    direction_A_ = X_BA.R.transpose() * (direction - direction.dot(at.m) * at.m).normalized();
  }
  [[nodiscard]] ContactPlaces at(double t) const {
    return {surfaces_.on_B.moved(start_.on_B, B_, t * direction_B_),
            surfaces_.on_A.moved(start_.on_A, A_, t * direction_A_)};
  }
  /// The parallel line through two other places.
  [[nodiscard]] Line from(const ContactPlaces& start) const {
    Line line = *this;
    line.start_ = start;
    line.B_ = surfaces_.on_B.evaluate(start.on_B);
    line.A_ = surfaces_.on_A.evaluate(start.on_A);
    return line;
  }
  /// Distance of both places from the edges of their surfaces.
  [[nodiscard]] double within(double t) const {
    return edge_distance(surfaces_, at(t)) - kWithinEdge;
  }

 private:
  SurfacePair surfaces_;
  ContactPlaces start_;
  SurfacePoint B_, A_;
  Eigen::Vector3d direction_B_, direction_A_;
};

/// Some t within both surfaces near 0; samples on an edge lie a little beyond it.
bool find_within(const Line& line, double spacing, double& t) {
  t = 0;
  if (line.within(t) > 0) return true;
  for (double step = 1e-8; step < 2 * spacing; step *= 4)
    for (const double sign : {1.0, -1.0})
      if (line.within(t = sign * step) > 0) return true;
  return false;
}

/// `start`, or where that is an end itself and the line goes on in this direction, some t farther in.
double off_the_end(const Line& line, double start, double sign, double spacing) {
  if (line.within(start) > kFound) return start;
  for (double step = 1e-8; step < spacing; step *= 4)
    if (line.within(start + sign * step) > kFound) return start + sign * step;
  return start;
}

/// The last t within both surfaces in one direction, by the Illinois rule.
bool find_end(const Line& line, double start, double sign, double spacing, double& end) {
  double way = spacing;
  double in = off_the_end(line, start, sign, spacing);
  start = in;
  while (line.within(start + sign * way) > 0) {
    in = start + sign * way;
    if ((way *= 2) > kLongest * spacing) return false;
  }
  double out = start + sign * way;
  double f_in = line.within(in), f_out = line.within(out);
  for (int side = 0, k = 0; k < 200 && f_in > kFound && std::abs(out - in) > kFound; ++k) {
    const double middle = std::isfinite(f_in) && std::isfinite(f_out)
                              ? (in * f_out - out * f_in) / (f_out - f_in)
                              : 0.5 * (in + out);
    const double f = line.within(middle);
    if (f >= 0) {
      in = middle;
      f_in = f;
      if (side == 1) f_out /= 2;
      side = 1;
    } else {
      out = middle;
      f_out = f;
      if (side == -1) f_in /= 2;
      side = -1;
    }
  }
  end = in;
  return true;
}

}  // namespace

bool have_straight_lines(const SurfacePair& surfaces, double spacing) {
  return is_ruled(surfaces.on_B, spacing) && is_ruled(surfaces.on_A, spacing);
}

bool is_line(const ContactLinearization& contact, const Eigen::Matrix3d& R_BA) {
  const auto [least, greatest] = contact.relative_curvature;
  if (!(greatest > kFlatCurvature) || contact.B.n.dot(contact.m) > -0.5) return false;
  const double flat = std::max(kFlatCurvature, kFlatAtEdge * greatest);
  if (std::abs(least) > flat) return false;
  const Eigen::Vector3d e = direction_of_least_curvature(contact, R_BA);
  return std::abs(e.dot(contact.B.K * e)) < flat;
}

namespace {

/// Two places settled across a line; wherever they lead within reach.
GapMinimum settled_across(const SurfacePair& surfaces,
                          ContactPlaces places,
                          const RigidTransform& X_BA,
                          double reach) {
  ContactLinearization at;
  settle_places(surfaces, X_BA, {reach}, places, at);
  GapMinimum end = minimum_at(surfaces, places, at);
  end.refined = at.h.norm() < kAligned;
  return end;
}

/// The end of a line near two places, settled across the line and back at the edge.
GapMinimum settled_end(const SurfacePair& surfaces,
                       const Line& line,
                       double t,
                       double outwards,
                       const RigidTransform& X_BA,
                       double reach) {
  GapMinimum end = settled_across(surfaces, line.at(t), X_BA, reach);
  for (int k = 0; k < 8; ++k) {
    const double beside = end.edge - kWithinEdge;
    if (std::abs(beside) < kFound) break;
    end = settled_across(surfaces, line.from(end.places).at(outwards * beside), X_BA, reach);
  }
  return end;
}

}  // namespace

bool find_line_ends(const SurfacePair& surfaces,
                    const ContactPlaces& places,
                    const RigidTransform& X_BA,
                    double spacing,
                    std::array<GapMinimum, 2>& ends) {
  const ContactLinearization at = linearize_contact(surfaces, places, X_BA);
  if (!is_line(at, X_BA.R)) return false;
  const Line line(surfaces, places, at, direction_of_least_curvature(at, X_BA.R), X_BA);
  double start = 0;
  if (!find_within(line, spacing, start)) return false;
  for (const int k : {0, 1}) {
    double t = 0;
    const double outwards = k == 0 ? -1 : 1;
    if (!find_end(line, start, outwards, spacing, t)) return false;
    ends[static_cast<std::size_t>(k)] =
        settled_end(surfaces, line, t, outwards, X_BA, kReach * spacing);
  }
  if (ends[1].gap < ends[0].gap) std::swap(ends[0], ends[1]);
  return true;
}

bool add_line_ends(const SurfacePair& surfaces,
                   const RigidTransform& X_BA,
                   const GapMinimum& minimum,
                   double spacing,
                   double cutoff,
                   std::vector<GapMinimum>& minima) {
  std::array<GapMinimum, 2> ends;
  if (!find_line_ends(surfaces, minimum.places, X_BA, spacing, ends)) return false;
  for (const GapMinimum& end : ends)
    if (end.gap < cutoff) minima.push_back(end);
  // Where the surfaces cross a little, the lowest point between the ends counts as well.
  constexpr double kLower = 1e-9;
  return !minimum.refined || minimum.gap > ends[0].gap - kLower;
}

}  // namespace condyle
