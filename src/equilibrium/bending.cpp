#include "equilibrium/bending.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "surface/point_tree.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNeighbours = 1.6;  // radius of the first shell, in spacings

/// The greatest principal value off the normal.
double largest_principal(const Eigen::Matrix3d& K) {
  const double trace = K.trace();
  return 0.5 * (trace + std::sqrt(std::max(0.0, 2 * K.squaredNorm() - trace * trace)));
}

/// By how much two curvature tensors differ in the tangent plane with the normal n.
double tangent_change(const Eigen::Matrix3d& K,
                      const Eigen::Matrix3d& from,
                      const Eigen::Vector3d& n) {
  const Eigen::Matrix3d D = K - from;
  const Eigen::Vector3d Dn = D * n;
  const double along = n.dot(Dn);
  return std::sqrt(std::max(0.0, D.squaredNorm() - 2 * Dn.squaredNorm() + along * along));
}

/// Of a plane, sphere or cylinder as far as `radius` from any of its points. A cup of radius R
/// rises to h = d²/2R at the distance d from its point, so 2 h/t² = 1/R (1 - d²/4R²).
Rise even_rise(double radius, const Eigen::Matrix3d& K) {
  const double trace = K.trace(), greatest = largest_principal(K);
  if (trace <= 0) return {0, greatest};
  const double x = 0.5 * radius * greatest;
  if (x > 0.9) return {kInfinity, kInfinity};
  const double rise = greatest / (1 - x * x);
  return {rise - greatest, rise};
}

}  // namespace

std::vector<std::array<int, 8>> nearest_neighbours(const std::vector<Eigen::Vector3d>& points,
                                                   double radius) {
  std::vector<std::array<int, 8>> neighbours(points.size());
  for (auto& list : neighbours) list.fill(-1);
  if (points.empty()) return neighbours;
  const PointCloud cloud{points};
  const PointTree tree(3, cloud);
  std::array<unsigned int, 9> index;
  std::array<double, 9> square;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t found = tree.knnSearch(points[i].data(), 9, index.data(), square.data());
    int k = 0;
    for (std::size_t j = 0; j < found && k < 8; ++j)
      if (index[j] != static_cast<unsigned int>(i) && square[j] < radius * radius)
        neighbours[i][k++] = static_cast<int>(index[j]);
  }
  return neighbours;
}

/// With its points, so that it stays where a search moves.
struct Bending::Tree {
  explicit Tree(std::vector<Eigen::Vector3d> of)
      : points(std::move(of)), cloud{points}, search(3, cloud) {}
  std::vector<Eigen::Vector3d> points;
  PointCloud cloud;
  PointTree search;
};

Rise BendingMeter::at(const Eigen::Vector3d& point,
                      const Eigen::Vector3d& normal,
                      double least) const {
  const Eigen::Vector3d d = point - c_;
  const double height = n_.dot(d);
  const Eigen::Vector3d t = d - height * n_;
  const double inverse = 1 / std::max(t.squaredNorm(), least * least);
  return {n_.dot(normal) < 0.5 ? kInfinity : (2 * height - t.dot(K_ * t)) * inverse,
          2 * height * inverse};
}

Bending::Radii Bending::shells(double spacing, double greatest) {
  const double least = kNeighbours * spacing;
  const double ratio = std::pow(std::max(greatest / least, 1.0), 1.0 / (kLevels - 1));
  Radii radii;
  for (int level = 0; level < kLevels; ++level) radii[level] = least * std::pow(ratio, level);
  return radii;
}

Bending::Bending(const Surface& surface, double spacing, const Radii& radii)
    : radii_(radii), even_(surface.bends_evenly()) {
  std::vector<Eigen::Vector3d> points;
  const std::vector<Place> places = surface.samples(spacing);
  for (const Place& place : places) {
    samples_.push_back(surface.evaluate(place));
    points.push_back(samples_.back().c);
    normals_.push_back(samples_.back().n);
  }
  neighbours_ = nearest_neighbours(points, 3 * spacing);
  if (!points.empty()) tree_ = std::make_shared<const Tree>(std::move(points));
  shells_.resize(samples_.size());
  for (Shells& shells : shells_) shells.within[0] = -1;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    cells_.push_back(cell_of(surface, places[i], i));
    greatest_convexity_ =
        std::max(greatest_convexity_, largest_principal(-samples_[i].K) + cells_.back().curvature);
  }
}

/// Half the way to the farthest of eight neighbours is the cell's radius; its rim tells the rest.
Bending::Cell Bending::cell_of(const Surface& surface, const Place& place, std::size_t i) const {
  constexpr int kRim = 8;
  constexpr double kBetween = 1.3;  // what lies between the points of the rim
  const SurfacePoint& at = samples_[i];
  Cell cell;
  for (const int other : neighbours_[i])
    if (other >= 0)
      cell.radius =
          std::max(cell.radius, 0.5 * (samples_[static_cast<std::size_t>(other)].c - at.c).norm());
  if (even_) return cell;
  const Eigen::Vector3d e0 = at.n.unitOrthogonal(), e1 = at.n.cross(e0);
  for (int k = 0; k < kRim; ++k) {
    const double angle = 2 * M_PI * k / kRim;
    const SurfacePoint rim = surface.evaluate(
        surface.moved(place, at, cell.radius * (std::cos(angle) * e0 + std::sin(angle) * e1)));
    const Eigen::Vector3d d = rim.c - at.c, t = d - at.n.dot(d) * at.n;
    cell.rise = std::max(cell.rise, kBetween * (2 * at.n.dot(d) - t.dot(at.K * t)));
    cell.curvature = std::max(cell.curvature, kBetween * tangent_change(rim.K, at.K, at.n));
  }
  return cell;
}

const std::vector<Eigen::Vector3d>& Bending::points() const { return tree_->points; }

/// Of all of a cell as seen from another's sample.
Rise Bending::rise_of(std::size_t j, std::size_t i) const {
  const SurfacePoint& at = samples_[i];
  const SurfacePoint& to = samples_[j];
  const Cell& cell = cells_[j];
  const double change = tangent_change(to.K, at.K, at.n);
  const Eigen::Vector3d d = to.c - at.c;
  const double height = at.n.dot(d);
  const Eigen::Vector3d t = d - height * at.n;
  const double square = t.squaredNorm(), radius = cell.radius;
  if (at.n.dot(to.n) < 0.5) return {kInfinity, 2 * height / std::max(square, radius * radius)};
  if (square < 4 * radius * radius) {
    const double rise = change + cell.curvature;
    return {rise, largest_principal(at.K) + rise};
  }
  const double quadric = t.dot(at.K * t), over = 2 * height - quadric;
  const double part = radius * radius / square;
  const double rise = (over + cell.rise) / square + (change + 3 * std::abs(over) / square) * part;
  const double turn = 2 * at.K.norm() * part;  // of the direction within the cell
  return {rise, quadric / square + rise + turn};
}

void Bending::measure(std::size_t sample) {
  const Eigen::Vector3d& c = samples_[sample].c;
  const double own = cells_[sample].radius;
  Shells& shells = shells_[sample];
  shells.of.fill({-kInfinity, -kInfinity});
  const std::vector<Eigen::Vector3d>& points = this->points();
  for (std::size_t j = 0; j < points.size(); ++j) {
    const double d = (points[j] - c).norm(), reach = cells_[j].radius + own;
    if (d - reach > radii_.back()) continue;
    const Rise rise = rise_of(j, sample);
    for (int level = 0; level < kLevels; ++level) {
      if (level > 0 && radii_[level - 1] > d + reach) break;
      if (radii_[level] < d - reach) continue;
      Rise& greatest = shells.of[level];
      greatest.over_quadric = std::max(greatest.over_quadric, rise.over_quadric);
      greatest.over_plane = std::max(greatest.over_plane, rise.over_plane);
    }
  }
  double so_far = 0;
  for (int level = 0; level < kLevels; ++level) {
    Rise& rise = shells.of[level];
    // The point that is meant lies up to a cell beside the sample.
    const double nearer = level == 0 ? 1 : 1 + own / radii_[level - 1];
    if (rise.over_quadric > 0) rise.over_quadric *= nearer * nearer;
    so_far = std::max(so_far, rise.over_quadric);
    shells.within[level] = so_far;
  }
}

/// What the quadric of a point in the cell adds to that of its sample: its curvature differs, and
/// so do height and slope on the way there, by less than half as much again.
double Bending::shift(std::size_t sample, const Eigen::Matrix3d& K) const {
  return 1.5 * tangent_change(K, samples_[sample].K, samples_[sample].n);
}

int Bending::nearest(const Eigen::Vector3d& point, int start) const {
  if (samples_.empty()) return -1;
  const std::vector<Eigen::Vector3d>& points = this->points();
  int best = std::max(start, 0);
  double square = (points[best] - point).squaredNorm();
  for (bool moved = true; moved;) {
    moved = false;
    for (const int other : neighbours_[best]) {
      if (other < 0) break;
      const double d = (points[other] - point).squaredNorm();
      if (d >= square) continue;
      best = other;
      square = d;
      moved = true;
      break;
    }
  }
  const double lost = 2 * radii_[0] / kNeighbours;
  if (square < lost * lost) return best;
  unsigned int index = 0;
  tree_->search.knnSearch(point.data(), 1, &index, &square);
  return square < lost * lost ? static_cast<int>(index) : -1;
}

double Bending::within(double radius, int sample, const Eigen::Matrix3d& K) {
  if (even_) return even_rise(radius, K).over_quadric;
  if (sample < 0) return kInfinity;
  const auto index = static_cast<std::size_t>(sample);
  if (shells_[index].within[0] < 0) measure(index);
  int level = 0;
  while (level < kLevels && radii_[level] < radius) ++level;
  return level == kLevels ? kInfinity : shells_[index].within[level] + shift(index, K);
}

Rise Bending::in_shell(int level, int sample, const Eigen::Matrix3d& K) {
  if (even_) return even_rise(radii_[level], K);
  if (sample < 0) return {kInfinity, kInfinity};
  const auto index = static_cast<std::size_t>(sample);
  if (shells_[index].within[0] < 0) measure(index);
  const Rise& rise = shells_[index].of[level];
  const double more = shift(index, K);
  return {rise.over_quadric + more, rise.over_plane + more};
}

}  // namespace condyle
