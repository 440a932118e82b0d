#pragma once

/// A study that nobody computed, of knees of Wismans' type: bands about curves over flexion, and indices
/// of a linear model, whose first order and total are the same but where told otherwise.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "condyle/results/study_file.h"

namespace condyle::test {
namespace made_up {

inline constexpr std::array<double, 5> kNormalQuantiles = {-1.645, -0.674, 0, 0.674, 1.645};

/// Of one quantity: a curve of that size whose spread grows with flexion.
inline StudyBand band(const std::vector<double>& angles, double size, double spread, bool force) {
  StudyBand made;
  for (const double angle : angles) {
    const double mean = size * std::sin(0.02 * angle + 0.3), sd = spread * (0.3 + angle / 120);
    made.mean.push_back(mean);
    made.nominal.push_back(mean * 0.95);
    made.sd.push_back(sd);
    for (std::size_t q = 0; q < kNormalQuantiles.size(); ++q) {
      const double value = mean + kNormalQuantiles[q] * sd;
      made.quantiles[q].push_back(force ? std::max(0.0, value) : value);
    }
    made.samples.push_back(1000);
  }
  return made;
}

/// Weights that depend on quantity, parameter and angle.
inline double weight(std::size_t output, std::size_t parameter, double angle) {
  const double phase = 1.7 * static_cast<double>(output) + 2.3 * static_cast<double>(parameter);
  return std::cos(phase + 0.02 * angle) / (1 + 0.5 * static_cast<double>(parameter % 7));
}

inline IndexEstimate estimate(double value) {
  return {value, value - 0.02 - 0.05 * value, value + 0.02 + 0.05 * value};
}

inline StudyEffects effects(const std::vector<double>& angles,
                            std::size_t output,
                            std::size_t parameters,
                            bool indices) {
  StudyEffects made;
  made.rank.assign(parameters, {});
  if (indices) made.first = made.total = std::vector<std::vector<IndexEstimate>>(parameters);
  for (const double angle : angles) {
    double all = 0;
    for (std::size_t j = 0; j < parameters; ++j) all += std::pow(weight(output, j, angle), 2);
    for (std::size_t j = 0; j < parameters; ++j) {
      const double w = weight(output, j, angle), part = w * w / all;
      made.rank[j].push_back(w / std::sqrt(all));
      if (!indices) continue;
      made.first[j].push_back(estimate(part));
      made.total[j].push_back(estimate(std::min(1.0, 1.1 * part)));
    }
  }
  return made;
}

inline StudySummary summary(const StudyView& study, double bigger, bool indices) {
  StudySummary made;
  for (std::size_t i = 0; i < study.outputs.size(); ++i) {
    const std::string& name = study.outputs[i].name;
    const bool force = name.ends_with(".force");
    const double size = name == "LCL.force" ? 0 : force ? 120 + 10.0 * static_cast<double>(i) : 6;
    made.bands.push_back(band(study.values, bigger * size, 0.15 * size, force));
    made.effects.push_back(effects(study.values, i, study.parameters.size(), indices));
  }
  return made;
}

inline StudyFailures failures(const StudyView& study) {
  StudyFailures made;
  made.poses = study.samples * static_cast<long>(study.values.size());
  for (const double angle : study.values) {
    made.by_pose.push_back(angle > 90 ? 8 * (static_cast<long>(angle) - 90) : 0);
    made.failed += made.by_pose.back();
    made.by_status.push_back({study.samples - made.by_pose.back(), 0, 0, 0, made.by_pose.back()});
  }
  made.incomplete = made.by_pose.back();
  const double share = static_cast<double>(made.failed) / static_cast<double>(made.poses);
  for (std::size_t j = 0; j < study.parameters.size(); ++j) {
    const double tilt = j == 2 ? 0.9 : 0.1 / static_cast<double>(j + 1);
    made.by_quartile.push_back(
        {share * (1 - tilt), share * (1 - tilt / 3), share * (1 + tilt / 3), share * (1 + tilt)});
  }
  return made;
}

}  // namespace made_up

/// `parameters` at most as many as ligaments have strains and stiffnesses; of several knees each has
/// bands of its own, where `by_knee`.
inline StudyView made_up_study(bool indices = true, int knees = 1, std::size_t parameters = 14) {
  StudyView study;
  study.title = "strains and stiffness";
  study.text = "specimens = \"knees\" # <all>\n";
  study.program = "condyle 0.1.0";
  study.created = "2026-01-02 03:04:05";
  std::ifstream scene(CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml");
  const std::string text{std::istreambuf_iterator<char>(scene), {}};
  for (int k = 0; k < knees; ++k) {
    study.knees.push_back("knee" + std::to_string(k + 1));
    study.scenes.push_back(text);
  }
  study.design = indices ? "saltelli" : "sobol";
  study.seed = 7;
  study.points = indices ? 64 * static_cast<long>(parameters + 2) : 1024;
  study.samples = study.points * knees;
  study.swept = {"flexion",           "Flexion", "flexion", "°",  {"deg", M_PI / 180},
                 {"deg", M_PI / 180}, 0,         -1,        true, "Flexion [°]",
                 180 / M_PI};
  for (int angle = 0; angle <= 120; angle += 5) study.values.push_back(angle);
  const std::vector<std::string> ligaments = {"aACL", "pACL", "aPCL", "pPCL", "aMCL", "oMCL",
                                              "dMCL", "LCL",  "mCAP", "lCAP", "OPL",  "APL"};
  for (std::size_t j = 0; j < parameters; ++j) {
    const bool strain = j < ligaments.size();
    const std::string& of = ligaments[j % ligaments.size()];
    study.parameters.push_back({of + (strain ? ".reference_strain" : ".stiffness"), "1", !strain,
                                strain ? "normal, sd 0.02" : "normal, sd 0.1",
                                strain ? 0.02 : 0.1});
  }
  for (const char* name : {"adduction", "internal_rotation"})
    study.outputs.push_back({name, "deg"});
  for (const char* name : {"lateral_shift", "anterior_drawer", "distraction"})
    study.outputs.push_back({name, "mm"});
  for (const char* name : {"medial", "lateral"})
    study.outputs.push_back({std::string(name) + ".force", "N"});
  for (const std::string& name : ligaments) study.outputs.push_back({name + ".force", "N"});
  study.all = made_up::summary(study, 1, indices);
  study.all.failures = made_up::failures(study);
  for (int k = 0; k < knees && knees > 1; ++k) {
    study.by_knee.push_back(made_up::summary(study, 0.8 + 0.4 * k / (knees - 1), indices));
    study.by_knee.back().failures = study.all.failures;
  }
  return study;
}

}  // namespace condyle::test
