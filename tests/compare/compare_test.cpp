/// Both models on one specimen: what is compared, where differences come from, and the file.

#include "condyle/compare/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "condyle/compare/one_contact_each.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/reference/fit_heights.h"
#include "condyle/reference/polynomial_surface.h"
#include "condyle/results/run_file.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

constexpr const char* kKnee = CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml";
constexpr const char* kPhantom = CONDYLE_SOURCE_DIR "/data/phantom/knee.toml";

struct Compared {
  Scene scene;
  std::vector<FittedSurface> surfaces;
  SweepResult ours;
  Comparison comparison;
};

Compared compare_scene(Scene scene, const CompareOptions& options = {}) {
  Compared all;
  all.scene = std::move(scene);
  all.surfaces = fit_surfaces(all.scene);
  all.ours = sweep(all.scene, all.surfaces);
  all.comparison = compare(all.scene, all.surfaces, all.ours, options);
  return all;
}

const ComparedQuantity& quantity(const Comparison& comparison, const std::string& name) {
  const auto found = std::find_if(comparison.quantities.begin(), comparison.quantities.end(),
                                  [&](const ComparedQuantity& q) { return q.name == name; });
  EXPECT_NE(found, comparison.quantities.end()) << name;
  return *found;
}

/// The engine's Newton on the reference's surfaces, springs and contacts against the reference.
void expect_all_three_agree(const Comparison& comparison) {
  for (const ComparedQuantity& q : comparison.quantities) {
    const Difference rest = difference(q.of(Variant::kAllThree), q.of(Variant::kReference));
    EXPECT_EQ(rest.count > 0, comparison.reference.count_converged() > 0) << q.name;
    const double largest =
        difference(q.of(Variant::kReference), std::vector<double>(q.values[0].size(), 0.0)).max;
    EXPECT_LT(rest.max, 1e-9 * std::max(1.0, largest)) << q.name;
  }
}

// The same numbers of a pose from either solver: lengths, strains, and how far an edge is.
TEST(Compare, OneContactEachTellsStrainsAndEdgesAsTheReferenceDoes) {
  const Scene scene = with_quadratic_springs(read_scene(kKnee));
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const std::vector<HeightFit> heights = fit_heights(scene, surfaces);
  const SweepResult reference =
      reference_sweep(scene, build_wismans_model(scene, heights), sweep(scene, surfaces));
  const SweepResult ours =
      sweep_one_contact_each(scene, with_polynomials(surfaces, heights), reference);
  ASSERT_GT(ours.count_converged(), 0);
  double greatest = 0;
  for (std::size_t i = 0; i < ours.poses.size(); ++i) {
    const PoseResult &a = ours.poses[i], &b = reference.poses[i];
    if (!a.converged() || !b.converged()) continue;
    for (std::size_t k = 0; k < a.ligaments.size(); ++k) {
      EXPECT_NEAR(a.ligaments[k].strain, b.ligaments[k].strain, 1e-9) << k;
      greatest = std::max(greatest, a.ligaments[k].strain);
    }
    for (const ContactResult& contact : a.contacts) {
      ASSERT_EQ(contact.points.size(), 1U);
      // Force times place over force: rounding.
      EXPECT_LT((contact.resultant_ground - contact.points[0].point_ground).norm(), 1e-12);
    }
  }
  EXPECT_GT(greatest, 0.01);
}

TEST(Compare, DifferencesAreMeasuredWhereBothHaveAValue) {
  const double none = std::nan("");
  const Difference d = difference({1, 2, none, 4}, {1, 5, 7, none});
  EXPECT_EQ(d.count, 2);
  EXPECT_DOUBLE_EQ(d.max, 3);
  EXPECT_EQ(d.at, 1U);
  EXPECT_DOUBLE_EQ(d.rms, std::sqrt(9.0 / 2));
  EXPECT_EQ(difference({none}, {1}).count, 0);
}

TEST(Compare, SpheresOnPlanesDifferByTheLawOfTheSpringsAboveAll) {
  const Compared all = compare_scene(read_scene(kKnee));
  EXPECT_EQ(all.ours.count_converged(), 19);
  EXPECT_EQ(all.comparison.reference.count_converged(), 19);
  expect_all_three_agree(all.comparison);
  const ComparedQuantity& rotation = quantity(all.comparison, "internal rotation");
  const auto part = [&](Variant v) {
    return difference(rotation.of(Variant::kOurs), rotation.of(v)).rms;
  };
  EXPECT_GT(part(Variant::kSprings), 3 * part(Variant::kSurfaces));
  EXPECT_LT(part(Variant::kClosed), 1e-9);  // no contact of this knee opens up to 90 degrees
  EXPECT_GT(all.comparison.seconds_ours, 0);
  EXPECT_GT(all.comparison.seconds_reference, 0);
}

TEST(Compare, DifferencesThatNobodyComputedAreDashes) {
  Compared all = compare_scene(read_scene(kKnee));
  const auto line_of = [&all](const std::string& name) {
    for (const std::string& line : summary_lines(all.scene, all.surfaces, all.ours, all.comparison))
      if (line.starts_with(name + ' ')) return line;
    return std::string();
  };
  const auto forget = [&all](std::size_t quantity, Variant v) {
    std::vector<double>& values =
        all.comparison.quantities[quantity].values[static_cast<std::size_t>(v)];
    values.assign(values.size(), std::nan(""));
  };
  const std::string first = all.comparison.quantities[0].name;
  EXPECT_EQ(line_of(first).find(" - "), std::string::npos) << line_of(first);
  forget(0, Variant::kSurfaces);
  EXPECT_NE(line_of(first).find("|         -"), std::string::npos) << line_of(first);
  forget(0, Variant::kAllThree);
  EXPECT_TRUE(line_of(first).ends_with("          -")) << line_of(first);
  forget(0, Variant::kReference);
  EXPECT_TRUE(line_of(first).ends_with("no pose of both")) << line_of(first);
}

// The reference and the steps towards it are rigid; ours differs from rigid ones held closed by its
// layers, and half as much with layers four times as stiff.
TEST(Compare, LayersDifferFromRigidContactsByTheirDepth) {
  const auto difference_of = [](double modulus) {
    Scene scene = read_scene(kKnee);
    scene.sweep->values.resize(7);
    for (SurfaceDescription& surface : scene.surfaces)
      surface.elastic = ElasticSurface{modulus, 0.45, 3};
    for (ContactDescription& contact : scene.contacts) contact.layer = LayerOptions{};
    const Compared all = compare_scene(std::move(scene));
    EXPECT_EQ(all.ours.count_converged(), 7);
    expect_all_three_agree(all.comparison);
    const ComparedQuantity& up = quantity(all.comparison, "distraction");
    return difference(up.of(Variant::kOurs), up.of(Variant::kClosed)).rms;
  };
  const double soft = difference_of(100), stiff = difference_of(400);
  EXPECT_GT(soft, 0.01);
  EXPECT_NEAR(stiff / soft, 0.5, 0.1);
}

TEST(Compare, ThePhantomDiffersByItsSurfacesAboveAll) {
  const Compared all = compare_scene(read_scene(kPhantom), {.degree = 6});
  EXPECT_EQ(all.ours.count_converged(), 25);
  EXPECT_GT(all.comparison.reference.count_converged(), 20);
  expect_all_three_agree(all.comparison);
  const ComparedQuantity& rotation = quantity(all.comparison, "internal rotation");
  const auto part = [&](Variant v) {
    return difference(rotation.of(Variant::kOurs), rotation.of(v)).rms;
  };
  EXPECT_GT(part(Variant::kSurfaces), 3 * part(Variant::kSprings));
  // Polynomials of degree 6 follow the meshes to about 0.2 mm, and the motion to a degree.
  for (const HeightFit& fit : all.comparison.heights) EXPECT_LT(fit.rms, 0.3);
  EXPECT_LT(difference(rotation.of(Variant::kOurs), rotation.of(Variant::kReference)).max, 2);
}

TEST(Compare, GoesThroughAFileUnchanged) {
  Compared all = compare_scene(read_scene(kKnee));
  const std::filesystem::path file = test::fresh_folder("condyle_compare") / "cmp.h5";
  condyle::Run run{all.scene, all.ours, {}, {}};
  run.study = std::make_shared<const Comparison>(all.comparison);
  write_run(file, run);
  const condyle::Run back = read_run(file);
  ASSERT_TRUE(back.comparison() != nullptr);
  const Comparison &a = all.comparison, &b = *back.comparison();
  EXPECT_EQ(b.options.degree, 4);
  EXPECT_EQ(b.options.strain, 0.06);
  ASSERT_EQ(b.reference.poses.size(), a.reference.poses.size());
  EXPECT_EQ(b.reference.poses[7].X_BA.p, a.reference.poses[7].X_BA.p);
  EXPECT_EQ(b.reference.poses[7].contacts[1].force, a.reference.poses[7].contacts[1].force);
  ASSERT_EQ(b.quantities.size(), a.quantities.size());
  for (const ComparedQuantity& q : a.quantities) {
    const ComparedQuantity& same = quantity(b, q.name);
    EXPECT_EQ(same.units, q.units);
    EXPECT_EQ(same.values, q.values);
  }
  const HeightFit &fit = a.heights[0], &fit_back = b.heights[0];
  EXPECT_EQ(fit_back.rms, fit.rms);
  EXPECT_EQ(fit_back.surface.axes, fit.surface.axes);
  EXPECT_EQ(evaluate(fit_back.surface, {3, -2}).c, evaluate(fit.surface, {3, -2}).c);
  EXPECT_EQ(fit_back.surface.outline.size(), fit.surface.outline.size());
  EXPECT_EQ(std::get<QuadraticLaw>(b.springs[3]).stiffness,
            std::get<QuadraticLaw>(a.springs[3]).stiffness);
  EXPECT_EQ(b.converged, a.converged);
  EXPECT_EQ(b.seconds_reference, a.seconds_reference);
}

std::string message_of(const Scene& scene) {
  try {
    check_wismans_scene(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Compare, SaysWhatTheReferenceModelCannotHold) {
  const Scene scene = read_scene(kKnee);
  const std::string file = kKnee;
  EXPECT_EQ(message_of(scene), "no error");
  Scene other = scene;
  other.contacts.pop_back();
  EXPECT_EQ(message_of(other), file +
                                   ": 1 [[contact]] that may close, expected 2: Wismans' model "
                                   "has one in each compartment");
  other = scene;
  other.conditions.clear();
  EXPECT_EQ(message_of(other), file +
                                   ": 0 [[condition]], expected one of kind \"flexion\": "
                                   "Wismans' model prescribes nothing else");
  other = scene;
  other.joint.reset();
  EXPECT_EQ(message_of(other), file +
                                   ": [joint] is missing, expected the frames of femur and "
                                   "tibia: Wismans' model prescribes the flexion");
}

/// Real knees, where they are at hand.
class CompareSpecimens : public testing::TestWithParam<const char*> {};

TEST_P(CompareSpecimens, EngineAndReferenceAgreeOnTheSameSurfaces) {
  const std::filesystem::path file =
      std::filesystem::path(CONDYLE_SOURCE_DIR) / "../shared/specimens" / GetParam() / "knee.toml";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const Compared all = compare_scene(read_scene(file));
  EXPECT_GT(all.comparison.reference.count_converged(), 0);
  expect_all_three_agree(all.comparison);
}
INSTANTIATE_TEST_SUITE_P(Knees,
                         CompareSpecimens,
                         testing::Values("lenhart2015", "clouthier2019_ssm"),
                         [](const auto& knee) { return std::string(knee.param); });

}  // namespace
}  // namespace condyle
