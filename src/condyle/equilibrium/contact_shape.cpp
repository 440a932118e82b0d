#include "condyle/equilibrium/contact_shape.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/contact/contact_scales.h"
#include "condyle/contact/settle_places.h"
#include "condyle/equilibrium/motion_name.h"

namespace condyle {
namespace {

constexpr double kNegative = 1e-7;  // a relative curvature below minus this is no round-off [1/mm]
constexpr double kBeside = 0.02;    // how far beside a point the gap is looked at [L]
constexpr double kNoGap = 1e-9;     // a gap that counts as none [L]
constexpr double kTilted = 1e-9;    // sine between two normals that are not parallel

/// Do the surfaces still touch t beside a contact?
bool touch_beside(const ContactPair& pair,
                  const ContactLinearization& contact,
                  const ContactPlaces& places,
                  const RigidTransform& X_BA,
                  const Eigen::Vector3d& t,
                  double no_gap) {
  ContactPlaces beside{pair.on_B->moved(places.on_B, contact.B, t),
                       pair.on_A->moved(places.on_A, contact.A, X_BA.R.transpose() * t)};
  ContactLinearization at;
  return settle_places(pair, X_BA, {t.norm()}, beside, at) == Settled::kThere &&
         std::abs(at.gap()) < no_gap && (at.B.c - contact.B.c).norm() > 0.5 * t.norm();
}

std::string named(const std::string& contact) { return "contact " + quoted(contact); }

}  // namespace

TouchReport examine_touch(const ContactPair& pair,
                          const ContactLinearization& contact,
                          const ContactPlaces& places,
                          const RigidTransform& X_BA,
                          double L) {
  TouchReport report;
  const auto [least, greatest] = contact.relative_curvature;
  if (least < -kNegative) report.kind = Touch::kInterpenetrating;
  if (std::abs(least) > kFlatCurvature) return report;
  const Eigen::Vector3d e = direction_of_least_curvature(contact, X_BA.R);
  const auto flat_along = [&](const Eigen::Vector3d& t) {
    return touch_beside(pair, contact, places, X_BA, kBeside * L * t, kNoGap * L) &&
           touch_beside(pair, contact, places, X_BA, -kBeside * L * t, kNoGap * L);
  };
  if (!flat_along(e)) return report;
  if (greatest < kFlatCurvature) {
    if (flat_along(contact.B.n.cross(e))) report.kind = Touch::kConforming;
  } else if (find_line_ends(pair, places, X_BA, kSampleSpacing * L, report.ends)) {
    report.kind = Touch::kLine;
  } else {
    report.kind = Touch::kEndlessLine;
  }
  return report;
}

std::optional<Objection> objection(Touch kind, const std::string& contact) {
  switch (kind) {
    case Touch::kConforming:
      return Objection{
          PoseStatus::kSingular,
          named(contact) + ": the surfaces conform, rigid contact does not say where they touch"};
    case Touch::kEndlessLine:
      return Objection{PoseStatus::kSingular,
                       named(contact) +
                           ": the surfaces touch along a line without ends, rigid contact does not "
                           "say where it carries (a cylinder ends where it has a length)"};
    case Touch::kInterpenetrating:
      return Objection{PoseStatus::kOverlap,
                       named(contact) + ": the surfaces interpenetrate beside the point"};
    default:
      return std::nullopt;
  }
}

Objection tips_over(const std::string& contact) {
  return {PoseStatus::kLeftPatch,
          named(contact) +
              ": the line of contact carries nothing at one end, the body tips over "
              "the other"};
}

Objection held_parallel(const std::string& contact) {
  return {PoseStatus::kSingular,
          named(contact) +
              ": the surfaces touch along a line and are held parallel, rigid contact does not say "
              "where along it they carry"};
}

std::optional<Objection> deeper_than_borne(const ContactPair& pair,
                                           const ContactPotential& potential,
                                           ContactSearch& search,
                                           const RigidTransform& X_BA,
                                           double L,
                                           std::vector<GapMinimum>& minima) {
  if (!std::isfinite(potential.bears())) return std::nullopt;
  const double length = search.length(L);
  search.find(X_BA, -potential.bears() - kAllowedOverlap * length, minima, kMerge * length);
  if (minima.empty()) return std::nullopt;
  return Objection{PoseStatus::kOverlap,
                   fmt::format("{}: its surfaces overlap by {:.2f} mm, its layers bear {:.2f}",
                               named(pair.name), -minima.front().gap, potential.bears())};
}

std::optional<std::size_t> conforming_pair(const Model& model,
                                           std::vector<ContactSearch>& searches,
                                           const RigidTransform& X_BA) {
  constexpr double kFarthest = 0.05, kDeepest = 0.5;  // of L
  const double L = model.length;
  std::vector<GapMinimum> minima;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const ContactPair& pair = model.pairs[p];
    if (pair.mode == ContactMode::kOpen) continue;
    searches[p].find(X_BA, kFarthest * L, minima, kMerge * searches[p].length(L));
    if (minima.empty() || minima.front().gap < -kDeepest * L) continue;
    const GapMinimum& at = minima.front();
    const auto [least, greatest] = linearize_contact(pair, at.places, X_BA).relative_curvature;
    if (std::abs(least) < kFlatCurvature && std::abs(greatest) < kFlatCurvature) return p;
  }
  return std::nullopt;
}

std::optional<Objection> objection_at(const Model& model,
                                      std::vector<ContactSearch>& searches,
                                      const RigidTransform& X_BA) {
  const double L = model.length;
  std::vector<GapMinimum> minima;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const ContactPair& pair = model.pairs[p];
    if (pair.mode == ContactMode::kOpen) continue;
    searches[p].find(X_BA, 1e-6 * L, minima, kMerge * searches[p].length(L));
    for (const GapMinimum& at : minima) {
      const ContactLinearization contact = linearize_contact(pair, at.places, X_BA);
      if (contact.h.norm() < kTilted) {
        const TouchReport touch = examine_touch(pair, contact, at.places, X_BA, L);
        if (touch.kind == Touch::kConforming || touch.kind == Touch::kEndlessLine)
          return objection(touch.kind, pair.name);
      }
      std::array<GapMinimum, 2> ends;
      if (find_line_ends(pair, at.places, X_BA, kSampleSpacing * L, ends) && ends[1].gap > 1e-6 * L)
        return tips_over(pair.name);
    }
  }
  return std::nullopt;
}

}  // namespace condyle
