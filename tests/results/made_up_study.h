#pragma once

/// A study that nobody computed: numbers that are functions of where they stand.

#include <cmath>
#include <limits>
#include <string>

#include "condyle/study/study_chunk.h"
#include "results/made_up_run.h"

namespace condyle {

/// Two parameters, three poses, two outputs; 150 points are three chunks.
inline StudyPlan made_up_study(std::uint64_t points = 150, std::size_t knees = 1) {
  StudyPlan plan;
  plan.study.title = "made up";
  plan.study.text = "a study";
  plan.study.file = "study.toml";
  plan.study.seed = 7;
  for (std::size_t k = 0; k < knees; ++k) {
    StudyKnee& knee = plan.knees.emplace_back();
    knee.name = "knee" + std::to_string(k + 1);
    knee.scene = parse_scene(kSmallScene, knee.name + ".toml");
  }
  plan.parameters = {{"aACL.reference_strain", "1", false, {Spread::Kind::kNormal, 0.02}},
                     {"aACL.stiffness", "1", true, {Spread::Kind::kUniform, 1, {-0.2, 0.2}}}};
  plan.outputs = {{"anterior_drawer", {"mm", 1}, {OutputKind::kJointCoordinate, 4}},
                  {"aACL.force", {"N", 1}, {OutputKind::kLigamentForce, 0}}};
  for (StudyKnee& knee : plan.knees) knee.outputs = plan.outputs;
  plan.values = {0, 0.1, 0.2};
  plan.points = points;
  DesignOptions options;
  options.dimensions = 2;
  options.points = points;
  options.seed = plan.study.seed;
  plan.design = std::make_shared<const SampleDesign>(options);
  return plan;
}

/// Some poses fail.
inline StudyChunk made_up_chunk(const StudyPlan& plan, std::uint64_t index) {
  StudyChunk chunk;
  chunk.index = index;
  chunk.samples = std::min(kChunkSamples, plan.samples() - index * kChunkSamples);
  for (std::uint64_t i = 0; i < chunk.samples; ++i) {
    const std::uint64_t k = index * kChunkSamples + i;
    for (std::size_t p = 0; p < plan.values.size(); ++p) {
      const bool failed = (k + p) % 50 == 49;
      chunk.status.push_back(failed ? 5 : 0);
      for (std::size_t o = 0; o < plan.outputs.size(); ++o)
        chunk.values.push_back(failed ? std::numeric_limits<double>::quiet_NaN()
                                      : std::sin(static_cast<double>(k + 10 * p + 100 * o)));
    }
  }
  return chunk;
}

/// Whether they are the same but for what is lost in single precision.
inline void expect_same_chunk(const StudyChunk& a, const StudyChunk& b, double tolerance = 0) {
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.status, b.status);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (std::isnan(b.values[i])) {
      EXPECT_TRUE(std::isnan(a.values[i]));
    } else {
      EXPECT_NEAR(a.values[i], b.values[i], tolerance);
    }
  }
}

/// Poses of a knee's own sweep.
inline SweepResult made_up_nominal(const StudyPlan& plan) {
  SweepResult sweep;
  for (std::size_t p = 0; p < plan.values.size(); ++p)
    sweep.poses.push_back(made_up_pose(static_cast<double>(p)));
  return sweep;
}

}  // namespace condyle
