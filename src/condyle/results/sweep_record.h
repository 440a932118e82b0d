#pragma once

/// Sweeps as words of a journal's line, with all that is told of their poses, to the last bit; and
/// whether what a journal holds may be of a scene at all.

#include <string>

#include "condyle/equilibrium/known_poses.h"
#include "condyle/results/journal_words.h"
#include "condyle/scene/scene.h"

namespace condyle {

void put_sweep(const SweepResult& sweep, std::string& out);
/// `take.ok` tells whether it was whole.
[[nodiscard]] SweepResult take_sweep(WordTaker& take);

/// Are there as many contacts, ligaments and conditions as the scene has, and are those of events among
/// them?
[[nodiscard]] bool belongs_to(const Scene& scene, const SweepResult& sweep);
/// The same of what the line of a journal tells of a pose.
[[nodiscard]] bool belongs_to(const Scene& scene, const KnownPose& known);

}  // namespace condyle
