#pragma once

/// What is known of the hard cases in closed form: the largest error of a sweep, lengths divided by
/// the size of the thing, forces by the load.

#include "condyle/equilibrium/pose_result.h"

namespace condyle::hard {

double ball_in_cup(const SweepResult& sweep, double R, double r);
double guided_ball(const SweepResult& sweep);
double held_ball(const SweepResult& sweep);
double roller(const SweepResult& sweep);
double rolling_stone(const SweepResult& sweep);
double ball_over_ridges(const SweepResult& sweep);
double dumbbell(const SweepResult& sweep);
double sledge(const SweepResult& sweep);
double hooked_ball(const SweepResult& sweep);
double ball_on_dome(const SweepResult& sweep);
double ball_in_pits(const SweepResult& sweep);
double slack_bone(const SweepResult& sweep);
double hanging_weight(const SweepResult& sweep);
double short_spring(const SweepResult& sweep);
double block_between_walls(const SweepResult& sweep);
double snapping_truss(const SweepResult& sweep);
double path_of_truss(const SweepResult& sweep);
double column(const SweepResult& sweep);
double bob(const SweepResult& sweep);
double swinging_bob(const SweepResult& sweep);
double wheel(const SweepResult& sweep);

}  // namespace condyle::hard
