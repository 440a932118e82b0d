#pragma once

/// The checks of one pose that need no search: each notes what it compared.

#include <memory>
#include <vector>

#include "condyle/verify/ledger.h"
#include "condyle/verify/side.h"

namespace condyle::verification {

struct Subject {
  const Run& run;
  const std::vector<std::unique_ptr<SurfaceSide>>& sides;  ///< as Scene::surfaces
  SweptQuantity swept;
  [[nodiscard]] bool moving() const { return run.kind() == RunKind::kSimulation; }
};

/// The two surfaces of a contact, the fixed body's first.
struct PairOfSides {
  int fixed_surface = -1, moving_surface = -1;
  const SurfaceSide *fixed = nullptr, *moving = nullptr;
};
[[nodiscard]] PairOfSides pair_of(const Subject& subject, std::size_t contact);

/// The value that a condition has to have at a pose [rad] or [mm].
[[nodiscard]] double prescribed(const Subject& subject,
                                std::size_t condition,
                                const PoseResult& pose);
/// The factor on a load at a pose.
[[nodiscard]] double load_scale(const Subject& subject, std::size_t load, const PoseResult& pose);

/// What rounding of coordinates so far from their origins, in the frames of both bodies, comes to at most [mm].
[[nodiscard]] double round_off(const LigamentDescription& ligament, const RigidTransform& X_BA);

/// Once for a run. Says in `not_checked` of which ligaments they are not.
void check_slack_lengths(const Run& run, Ledger& ledger, std::vector<std::string>& not_checked);

/// False where the pose is no rigid motion: then nothing else can be said.
[[nodiscard]] bool check_motion(const Subject& subject, const PoseResult& pose, Ledger& ledger);
void check_ligaments(const Subject& subject, const PoseResult& pose, Ledger& ledger);
void check_conditions(const Subject& subject, const PoseResult& pose, Ledger& ledger);
void check_contacts(const Subject& subject, const PoseResult& pose, Ledger& ledger);
void check_balance(const Subject& subject, const PoseResult& pose, Ledger& ledger);

}  // namespace condyle::verification
