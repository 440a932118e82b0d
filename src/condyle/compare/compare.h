#pragma once

/// One specimen by both models over one sweep, and the engine with one thing of the reference model
/// at a time: what part of a difference comes from the surfaces, what from the law of the springs,
/// what from contacts that never open. The engine's Newton on all three, with one contact in each
/// compartment, is the reference model again (one_contact_each.h): what is left then shows whether
/// the two agree.

#include <array>
#include <string>
#include <vector>

#include "condyle/compare/kept_sweeps.h"
#include "condyle/compare/quantities.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/on_progress.h"
#include "condyle/reference/build_wismans.h"

namespace condyle {

struct CompareOptions {
  int degree = kUsualDegree;            ///< of the polynomials
  double strain = kUsualMatchedStrain;  ///< at which springs have equal force
};

enum class Variant { kOurs, kReference, kSurfaces, kSprings, kClosed, kAllThree };
inline constexpr int kVariantCount = 6;
/// "ours", "reference", "surfaces", "springs", "closed", "all three".
[[nodiscard]] const char* name(Variant variant);

struct ComparedQuantity {
  std::string name, units;
  std::array<std::vector<double>, kVariantCount> values;  ///< of each pose
  [[nodiscard]] const std::vector<double>& of(Variant v) const {
    return values[static_cast<std::size_t>(v)];
  }
};

struct Comparison {
  CompareOptions options;
  SweepResult reference;
  std::vector<HeightFit> heights;  ///< as Scene::surfaces
  std::vector<ForceLaw> springs;   ///< of the reference model, as Scene::ligaments
  std::vector<ComparedQuantity> quantities;
  std::array<int, kVariantCount> converged = {};  ///< poses
  /// Medians over the sweep, each model alone, without stability, events or results [s].
  double seconds_ours = 0, seconds_reference = 0;
  double iterations_ours = 0, iterations_reference = 0;  ///< means per pose
};

/// Throws InputError for a scene without a sweep in steps, or one that the reference model cannot hold.
void check_compared_scene(const Scene& scene);

/// `ours` is the engine's sweep of the scene. Throws InputError for a scene that the reference
/// model cannot hold. `on_sweep` is told of each of the sweeps behind it, whose numbers for `keeping` are those
/// of their variants, kVariantCount of ours again; the caller may keep `ours` as that of its own.
[[nodiscard]] Comparison compare(const Scene& scene,
                                 const std::vector<FittedSurface>& surfaces,
                                 const SweepResult& ours,
                                 const CompareOptions& options = {},
                                 const OnProgress& on_sweep = {},
                                 const SweepKeeping& keeping = {});

/// The reference model's sweep over the values of the scene.
[[nodiscard]] SweepResult reference_sweep(const Scene& scene,
                                          const WismansModel& model,
                                          const SweepResult& ours);

/// Lines for people: fits, what converged, what pulls and opens, differences and where they come
/// from, iterations and time.
[[nodiscard]] std::vector<std::string> summary_lines(const Scene& scene,
                                                     const std::vector<FittedSurface>& surfaces,
                                                     const SweepResult& ours,
                                                     const Comparison& comparison);

}  // namespace condyle
