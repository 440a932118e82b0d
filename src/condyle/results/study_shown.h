#pragma once

/// What of a study is shown to people: which poses and quantities, in which order, by which names. Shared
/// by plots and pages.

#include <cstddef>
#include <string>
#include <vector>

#include "condyle/results/study_file.h"

namespace condyle {

enum class StudyGroup { kJoint, kContact, kLigament };

struct ShownOutput {
  std::size_t index = 0;  ///< of StudyView::outputs
  StudyGroup group = StudyGroup::kJoint;
  bool force = false;
  std::string name;      ///< "anterior drawer", "medial contact", "aACL"
  std::string quantity;  ///< with unit: "Translation [mm]"
  std::string unit;      ///< after a number: "°", " mm", " N"; nothing where it is 1
};
/// All that are kept, in their order. Which of them are ligaments the first scene tells.
[[nodiscard]] std::vector<ShownOutput> shown_outputs(const StudyView& study);

/// Whether a force ever comes to more than 0.5 N in one of twenty samples; other quantities: whether
/// there is a number.
[[nodiscard]] bool carries(const StudyBand& band, const ShownOutput& output);

/// The joint and contacts, and the `ligaments` that spread most, in their order.
[[nodiscard]] std::vector<ShownOutput> main_outputs(const StudyView& study, std::size_t ligaments);

/// The poses nearest to 0, 30, 60 and 90 deg where it is flexion that is swept over two of them, else up
/// to four evenly over the sweep.
[[nodiscard]] std::vector<std::size_t> shown_poses(const StudyView& study);
/// "30°"
[[nodiscard]] std::string shown_pose(const StudyView& study, std::size_t pose);
/// Abscissae of charts, as SweptQuantity::axis has them.
[[nodiscard]] std::vector<double> shown_values(const StudyView& study);

/// "aACL strain"
[[nodiscard]] std::vector<std::string> shown_parameters(const StudyView& study);

/// Over the whole sweep, poses weighted by the variance at each: by parameters, what part of it each
/// explains by itself, and with all that it does together with others, of poses at which the index is known. Of studies without Sobol's
/// indices both are the square of the rank correlation.
struct SweepEffects {
  std::vector<double> first, total;
};
[[nodiscard]] SweepEffects sweep_effects(const StudyView& study, std::size_t output);

/// Whether there are Sobol's indices.
[[nodiscard]] bool has_indices(const StudyView& study);

/// Indices of parameters, the greatest in `by` first.
[[nodiscard]] std::vector<std::size_t> greatest_first(const std::vector<double>& by);

}  // namespace condyle
