#include "condyle/contact/contact_search.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "condyle/contact/contact.h"
#include "condyle/contact/contact_scales.h"
#include "condyle/contact/gap_paraboloid.h"
#include "condyle/contact/line_contact.h"
#include "condyle/contact/rim_minimum.h"
#include "condyle/contact/settle_places.h"
#include "condyle/surface/affordable_samples.h"
#include "condyle/surface/has_edge.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// All in sample spacings:
constexpr double kFacingSpacing = 1.5;  // of the surface that the samples of the other one face
constexpr double kRimReach = 1.5;       // from a sample to an edge that it stands for, and along it
constexpr double kNeighbour = 1.6;      // a sample nearer than this may be the lower one
constexpr double kSame = 0.3;       // a minimum predicted nearer to one that is known is that one
constexpr double kRefineReach = 4;  // from a sample to the minimum that it leads to
constexpr double kModel = 0.01;     // what the paraboloid of the gap may be wrong by in its reach

// Points of surfaces that are looked at, about, by the time that it takes:
constexpr long kPrediction = 3;   // where the paraboloid of the gap at a sample leads to
constexpr long kRefinement = 40;  // to a minimum of the gap
constexpr long kRim = 100;        // for the lowest point of an edge

/// No wider than what the smaller surface takes to be seen: lever arms of a model may be much longer than
/// its surfaces.
double spacing_for(const ContactPair& pair, double wanted) {
  constexpr double kCoarsest = 0.1;  // of its radius
  const double radius = std::min(pair.on_B->extent().radius, pair.on_A->extent().radius);
  return radius > 0 ? std::min(wanted, kCoarsest * radius) : wanted;
}

/// Lowest first; of minima nearer to each other than `merge` [mm] the lowest stays.
void keep_isolated(std::vector<GapMinimum>& minima, double merge) {
  std::sort(minima.begin(), minima.end(),
            [](const GapMinimum& a, const GapMinimum& b) { return a.gap < b.gap; });
  std::size_t kept = 0;
  for (const GapMinimum& minimum : minima) {
    bool isolated = true;
    for (std::size_t k = 0; k < kept && isolated; ++k)
      isolated = (minima[k].point_B - minimum.point_B).norm() > merge;
    if (isolated) minima[kept++] = minimum;
  }
  minima.resize(kept);
}

}  // namespace

/// Both surfaces with the spacing that can be afforded.
struct ContactCover::Samples {
  double spacing;
  std::vector<Place> on_B, on_A;

  Samples(const ContactPair& pair, double wanted)
      : spacing(std::max(affordable_spacing(*pair.on_B, spacing_for(pair, wanted)),
                         affordable_spacing(*pair.on_A, spacing_for(pair, wanted)))),
        on_B(pair.on_B->samples(spacing)),
        on_A(pair.on_A->samples(spacing)) {}
  [[nodiscard]] bool fewer_on_A() const {
    return !on_A.empty() && (on_B.empty() || on_A.size() <= on_B.size());
  }
};

ContactCover::ContactCover(const ContactPair& pair, double wanted)
    : ContactCover(pair, Samples(pair, wanted)) {}

ContactCover::ContactCover(const ContactPair& pair, Samples samples)
    : surface_B(pair.on_B),
      surface_A(pair.on_A),
      spacing(samples.spacing),
      sampled_on_A(samples.fewer_on_A()),
      on_B(sampled_on_A ? SurfaceCover(*pair.on_B, kFacingSpacing * spacing)
                        : SurfaceCover(*pair.on_B, spacing, std::move(samples.on_B))),
      on_A(sampled_on_A ? SurfaceCover(*pair.on_A, spacing, std::move(samples.on_A))
                        : SurfaceCover(*pair.on_A, kFacingSpacing * spacing)),
      lines(have_straight_lines(pair, spacing)) {}

ContactSearch::ContactSearch(std::shared_ptr<const ContactCover> cover)
    : cover_(std::move(cover)),
      spacing_(cover_->spacing),
      sampled_on_A_(cover_->sampled_on_A),
      deepest_(has_edge(other().surface()) ? deepest() : kInfinity),
      shells_(Bending::shells(spacing_, sampled().extent())),
      bending_B_(cover_->on_B, shells_),
      bending_A_(cover_->on_A, shells_),
      nearest_B_(cover_->on_B),
      nearest_A_(cover_->on_A) {
  const auto n = static_cast<std::size_t>(sampled().size());
  closest_.resize(n);
  seen_.resize(n);
  cluster_closest_.resize(sampled().clusters().size());
  split_.resize(sampled().clusters().size());
  near_.reserve(n);
  lowest_.reserve(n);
  for (std::vector<int>* doubtful : {&doubtful_, &doubtful_there_}) doubtful->reserve(n);
  for (std::vector<int>* doubtful : {&doubtful_other_, &doubtful_other_there_})
    doubtful->reserve(static_cast<std::size_t>(other().size()));
  near_contacts_.reserve(kMaxConstraints);
  found_.reserve(n + kMaxConstraints);
  discs_.reserve(kMaxConstraints);
}

void ContactSearch::reset() {
  std::fill(closest_.begin(), closest_.end(), Closest());
  std::fill(seen_.begin(), seen_.end(), Seen());
  std::fill(cluster_closest_.begin(), cluster_closest_.end(), Closest());
  std::fill(split_.begin(), split_.end(), char{0});
  std::fill(near_contacts_.begin(), near_contacts_.end(), NearContact());
  division_ = Division();
  doubts_ = 0;
  now_ = 0;
  forget_what_was_asked();
}

void ContactSearch::go_back(const ContactSearch& other) {
  assert(cover_ == other.cover_);
  closest_ = other.closest_;
  seen_ = other.seen_;
  cluster_closest_ = other.cluster_closest_;
  split_ = other.split_;
  near_contacts_ = other.near_contacts_;
  division_ = other.division_;
  doubts_ = other.doubts_;
  now_ = other.now_;
  forget_what_was_asked();
}

/// What is counted of the searches that follow does not depend on those before.
void ContactSearch::forget_what_was_asked() {
  bending_B_.reset();
  bending_A_.reset();
  nearest_B_.reset();
  nearest_A_.reset();
  nearest_reach_ = nearest_merge_ = -1;
}

/// By how much a neighbour may be above a sample; infinite for one that was passed over or is too far
/// away.
double ContactSearch::height_over(int sample, int neighbour) const {
  const Seen &own = seen(sample), &there = seen(neighbour);
  if (there.stamp != now_) return kInfinity;
  const double way = (sampled().sample(neighbour).c - sampled().sample(sample).c).squaredNorm();
  if (way >= kNeighbour * kNeighbour * spacing_ * spacing_) return kInfinity;
  const double above = there.gap + there.error - (own.gap - own.error);
  // NOLINTNEXTLINE(bugprone-narrowing-conversions) double to double: clang-tidy 14 takes infinity for none
  return above == 0 && neighbour > sample ? kInfinity : above;
}

/// No neighbour is lower for certain. One that faces nothing known stands for nothing, however low it
/// is.
bool ContactSearch::is_lowest_of_neighbours(int sample) const {
  for (const int neighbour : sampled().neighbours(sample)) {
    if (neighbour < 0) break;
    if (seen(neighbour).faces && height_over(sample, neighbour) <= 0) return false;
  }
  return true;
}

/// The same for a measured sample; neighbours that may be lower are measured.
bool ContactSearch::is_lowest(int sample, const RigidTransform& X_from_to) {
  if (!is_lowest_of_neighbours(sample)) return false;
  for (const int neighbour : sampled().neighbours(sample)) {
    if (neighbour < 0) break;
    if (seen(neighbour).measured || height_over(sample, neighbour) > 2 * seen(neighbour).error)
      continue;
    measure(neighbour, X_from_to);
    if (seen(neighbour).faces && height_over(sample, neighbour) <= 0) return false;
  }
  return true;
}

/// The deepest of the samples that lie deeper than all minima that were found; -1 where there is none.
int ContactSearch::deepest_unexplained(double cutoff, const std::vector<GapMinimum>& minima) const {
  double lowest = std::min(cutoff, 0.0);
  for (const GapMinimum& minimum : minima) lowest = std::min(lowest, minimum.gap);
  lowest -= kModel * spacing_;
  int missed = -1;
  for (const int sample : near_) {
    const Seen& now = seen(sample);
    if (!now.measured || !now.faces || !(now.gap < lowest)) continue;
    lowest = now.gap;
    missed = sample;
  }
  return missed;
}

/// The gap of a point of the sampled surface to the closest one of the other, by the normal there: those of both are
/// not opposite.
GapMinimum ContactSearch::gap_at(ContactPlaces places, const RigidTransform& X_BA) const {
  const SurfacePair surfaces = this->surfaces();
  if (sampled_on_A_)
    places.on_B = surfaces.on_B.closest(X_BA * surfaces.on_A.evaluate(places.on_A).c, places.on_B);
  else
    places.on_A =
        surfaces.on_A.closest(X_BA.inverse() * surfaces.on_B.evaluate(places.on_B).c, places.on_A);
  const ContactLinearization at = linearize_contact(surfaces, places, X_BA);
  GapMinimum there = minimum_at(surfaces, places, at);
  if (!sampled_on_A_) there.gap = -at.m.dot(at.g);
  return there;
}

/// Newton to the minimum near a sample. Where that does not settle, or leads beyond the known part while the sample
/// itself is within, the sample stands for it.
std::optional<GapMinimum> ContactSearch::refine(int sample,
                                                const RigidTransform& X_BA,
                                                double cutoff,
                                                bool lowest) {
  const SurfacePair surfaces = this->surfaces();
  const Place &own = sampled().place(sample), &there = closest(sample).place;
  const ContactPlaces start = sampled_on_A_ ? ContactPlaces{there, own} : ContactPlaces{own, there};
  const Settling how{kRefineReach * spacing_, true, cutoff};
  ContactPlaces places = start;
  ContactLinearization at;
  const Settled outcome = settle_places(surfaces, X_BA, how, places, at);
  const Seen& now = seen(sample);
  const bool below = now.measured && now.gap < cutoff && !cover_->lines;
  if (outcome == Settled::kAbove && !below) return std::nullopt;
  if (outcome == Settled::kThere && !(below && at.gap() > now.gap + kModel * spacing_)) {
    GapMinimum minimum = minimum_at(surfaces, places, at);
    minimum.refined = true;
    if (minimum.edge > -kBeyondEdge * spacing_) return minimum;
    return gap_at(start, X_BA);
  }
  const GapMinimum standing = gap_at(start, X_BA);
  const double touching = std::min(cutoff, 0.0);
  // Of a sample that does not touch itself, the cell may. Lines lie lower on the way to their ends, which are looked for
  // by themselves.
  if (!lowest || cover_->lines || standing.gap < touching || now.lower >= touching) return standing;
  return downhill_from(start, X_BA, how).value_or(standing);
}

/// The minimum that steps downhill come to, or the lowest place on the way; nothing beyond an edge, which is a rim's.
std::optional<GapMinimum> ContactSearch::downhill_from(const ContactPlaces& start,
                                                       const RigidTransform& X_BA,
                                                       const Settling& how) {
  const SurfacePair surfaces = this->surfaces();
  ContactPlaces places = start;
  ContactLinearization at;
  const Settled outcome =
      settle_downhill(surfaces, X_BA, how, sampled_on_A_, places, at, looked_at_);
  if (edge_distance(surfaces, places) < std::min(0.0, edge_distance(surfaces, start)))
    return std::nullopt;
  if (outcome != Settled::kThere) return gap_at(places, X_BA);
  GapMinimum minimum = minimum_at(surfaces, places, at);
  minimum.refined = true;
  return minimum;
}

void ContactSearch::add_minimum(int sample,
                                const RigidTransform& X_BA,
                                double cutoff,
                                bool lowest,
                                std::vector<GapMinimum>& minima) {
  looked_at_ += kRefinement;
  // The ends of a line may lie lower than any minimum.
  const std::optional<GapMinimum> minimum =
      // NOLINTNEXTLINE(bugprone-narrowing-conversions) as above
      refine(sample, X_BA, cover_->lines ? kInfinity : cutoff, lowest);
  if (!minimum) return;
  // A sample stands for a minimum of its own only where it is the lowest and faces what is known.
  if (!minimum->refined && !(lowest && seen(sample).faces)) return;
  found_.push_back(sampled_on_A_ ? minimum->point_B : X_BA.inverse() * minimum->point_B);
  if (cover_->lines && add_line_ends(surfaces(), X_BA, *minimum, spacing_, cutoff, minima)) return;
  if (minimum->gap < cutoff) minima.push_back(*minimum);
}

/// Where the edge of a known part lies lower than `cutoff`, between samples that do not. It is no
/// minimum of the gap: unrefined.
void ContactSearch::add_rims(const RigidTransform& X_BA,
                             double cutoff,
                             std::vector<GapMinimum>& minima) {
  const double reach = kRimReach * spacing_;
  const Surface &own = sampled().surface(), &facing = other().surface();
  for (const int sample : near_) {
    if (seen(sample).lower > cutoff) continue;
    const bool of_own = own.edge_distance(sampled().place(sample)) < reach;
    const bool of_facing = facing.edge_distance(closest(sample).place) < reach;
    if (of_own) add_rim(sample, sampled_on_A_, X_BA, cutoff, minima);
    if (of_facing) add_rim(sample, !sampled_on_A_, X_BA, cutoff, minima);
  }
}

/// The edge near a sample, of the one surface or of the other.
void ContactSearch::add_rim(int sample,
                            bool of_A,
                            const RigidTransform& X_BA,
                            double cutoff,
                            std::vector<GapMinimum>& minima) {
  const double reach = kRimReach * spacing_;
  const Place &own = sampled().place(sample), &there = closest(sample).place;
  const Place &on_A = sampled_on_A_ ? own : there, &on_B = sampled_on_A_ ? there : own;
  const SurfacePair pair = surfaces();
  looked_at_ += kRim;
  const std::optional<RimMinimum> rim =
      of_A ? rim_minimum(pair.on_A, on_A, pair.on_B, on_B, X_BA, reach, cutoff)
           : rim_minimum(pair.on_B, on_B, pair.on_A, on_A, X_BA.inverse(), reach, cutoff);
  if (!rim || !(rim->gap < cutoff)) return;
  GapMinimum minimum;
  minimum.places.on_A = of_A ? rim->on_rim : rim->facing;
  minimum.places.on_B = of_A ? rim->facing : rim->on_rim;
  const SurfacePoint B = pair.on_B.evaluate_frame(minimum.places.on_B);
  minimum.point_B = B.c;
  minimum.n = B.n;
  minimum.gap = rim->gap;
  minima.push_back(minimum);
}

/// A measured sample whose closest point lies less than a cell beyond the edge may stand for a
/// minimum within.
bool ContactSearch::nearly_faces_known_part(int sample) const {
  return other().surface().edge_distance(closest(sample).place) >= -spacing_;
}

/// In a shallow valley a second minimum may have no sample that is lowest of its neighbours. Does
/// the paraboloid at this one lead below the cutoff at a place that is not known yet?
bool ContactSearch::leads_elsewhere(int sample, const RigidTransform& X_BA, double cutoff) const {
  if (!closest(sample).close) return false;
  const RigidTransform X = from_to(X_BA);
  const SurfacePoint& at = sampled().sample(sample);
  const auto minimum = predict_minimum(X * at.c, X.R * at.n, X.R * at.K * X.R.transpose(),
                                       closest(sample).at, seen(sample).gap, 1.5 * spacing_);
  if (!minimum || minimum->gap > cutoff + kModel * spacing_) return false;
  const double near = kSame * spacing_;
  return std::none_of(found_.begin(), found_.end(), [&](const Eigen::Vector3d& known) {
    return (known - minimum->point).squaredNorm() < near * near;
  });
}

RigidTransform ContactSearch::from_to(const RigidTransform& X_BA) const {
  return sampled_on_A_ ? X_BA : X_BA.inverse();
}

/// The samples that are lower than all their neighbours, measured.
void ContactSearch::gather_lowest(const RigidTransform& X_from_to) {
  lowest_.clear();
  for (const int sample : near_)
    if (is_lowest_of_neighbours(sample)) lowest_.push_back(sample);
  for (const int sample : lowest_) measure(sample, X_from_to);
}

/// The samples whose cells may reach the cutoff, but for the neighbourhood of known contacts: first
/// in ways that cost little, where they will do.
void ContactSearch::look(const RigidTransform& X_from_to,
                         double cutoff,
                         const std::vector<KnownContact>& known) {
  set_known(known);
  for (std::size_t k = 0; k < known_; ++k)
    if (touches_only(known[k], near_contacts_[k])) return;
  if (cutoff <= 0 && known_ > 0 && look_beside(X_from_to, cutoff)) return;
  set_discs(known);
  visit(0, X_from_to, cutoff);
}

void ContactSearch::find(const RigidTransform& X_BA,
                         double cutoff,
                         std::vector<GapMinimum>& minima,
                         double merge,
                         const std::vector<KnownContact>& known) {
  minima.clear();
  near_.clear();
  ++now_;
  if (!has_samples()) return;
  const RigidTransform X = from_to(X_BA);
  look(X, cutoff, known);
  found_.clear();
  for (const KnownContact& contact : known)
    found_.push_back(sampled_on_A_ ? contact.on_B : contact.on_A);
  gather_lowest(X);
  for (const int sample : lowest_)
    if (nearly_faces_known_part(sample) && is_lowest(sample, X))
      add_minimum(sample, X_BA, cutoff, /*lowest=*/true, minima);
  for (const int sample : near_) {
    if (seen(sample).lower > 0) continue;
    measure(sample, X);
    looked_at_ += kPrediction;
    if (nearly_faces_known_part(sample) && leads_elsewhere(sample, X_BA, cutoff))
      add_minimum(sample, X_BA, cutoff, /*lowest=*/false, minima);
  }
  if (const int missed = deepest_unexplained(cutoff, minima); missed >= 0)
    add_minimum(missed, X_BA, cutoff, /*lowest=*/true, minima);
  if (cutoff <= 0) add_rims(X_BA, cutoff, minima);
  keep_isolated(minima, merge);
}

void ContactSearch::find_nearest(const RigidTransform& X_BA,
                                 double reach,
                                 std::vector<GapMinimum>& minima,
                                 double merge) {
  const bool asked_before = nearest_reach_ == reach && nearest_merge_ == merge &&
                            nearest_X_.p == X_BA.p && nearest_X_.R == X_BA.R;
  if (!asked_before) {
    find_within(X_BA, reach, nearest_, merge);
    nearest_X_ = X_BA;
    nearest_reach_ = reach;
    nearest_merge_ = merge;
  }
  minima = nearest_;
}

void ContactSearch::find_within(const RigidTransform& X_BA,
                                double reach,
                                std::vector<GapMinimum>& minima,
                                double merge) {
  for (double cutoff = spacing_;; cutoff *= 4) {
    find(X_BA, std::min(cutoff, reach), minima, merge);
    if (!minima.empty() || cutoff >= reach) return;
  }
}

long points_looked_at(const std::vector<ContactSearch>& searches) {
  long points = 0;
  for (const ContactSearch& search : searches) points += search.looked_at();
  return points;
}

}  // namespace condyle
