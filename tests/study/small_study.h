#pragma once

/// Studies built by hand: the reference strains and stiffnesses of a shipped knee vary, all kinds of
/// ligaments alike.

#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "condyle/scene_file/read_scene.h"
#include "condyle/study/study_plan.h"
#include "condyle/study/study_worker.h"

namespace condyle::test {

/// One number of every ligament whose law has it.
inline VariedNumber of_all_ligaments(const Scene& scene, ParameterKind what, double sd) {
  VariedNumber varied;
  varied.number.what = what;
  varied.number.prior_sd = sd;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    varied.number.of.push_back(static_cast<int>(i));
  return varied;
}

/// `scene`: below data/, "wismans-type/knee.toml". Points of a normal distribution, sd 0.02 of strains
/// and 0.2 of ln k.
inline ReadStudy small_study(const std::string& scene, long samples, bool stiffnesses = false) {
  ReadStudy study;
  study.study.file = "small.toml";
  study.study.specimens = {std::filesystem::path(CONDYLE_SOURCE_DIR) / "data" / scene};
  study.study.samples = samples;
  study.scenes.push_back(read_scene(study.study.specimens.front()));
  std::vector<VariedNumber>& varied = study.varied.emplace_back();
  varied.push_back(of_all_ligaments(study.scenes[0], ParameterKind::kReferenceStrain, 0.02));
  if (stiffnesses)
    varied.push_back(of_all_ligaments(study.scenes[0], ParameterKind::kStiffness, 0.2));
  return study;
}

/// Only some values of its sweep.
inline ReadStudy at_flexions(ReadStudy study, const std::vector<double>& degrees) {
  for (Scene& scene : study.scenes) {
    scene.sweep->values.clear();
    for (const double degree : degrees)
      scene.sweep->values.push_back(degree * std::numbers::pi / 180);
  }
  return study;
}

/// What samples leave: status and values as in StudyChunk.
struct Left {
  std::vector<std::uint8_t> status;
  std::vector<double> values;
};

inline Left evaluated(StudyWorker& worker,
                      const StudyPlan& plan,
                      const std::vector<double>& theta,
                      std::size_t knee = 0) {
  Left left{std::vector<std::uint8_t>(plan.values.size()), std::vector<double>(plan.numbers())};
  worker.evaluate(knee, theta, left.status.data(), left.values.data());
  return left;
}

}  // namespace condyle::test
