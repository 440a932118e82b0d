/// The 24 strands of OpenSim-JAM's passive flexion (Lenhart 2015 knee) that wrap on an ellipsoid of the
/// tibia or a cylinder of the femur, at ten flexion angles: against that program's lengths and forces,
/// whose strings are plane sections cut into chords, and against the exact shortest strings.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/elements/line_element.h"
#include "condyle/math/rotation.h"
#include "condyle/wrapping/wrapped_path.h"
#include "support/jam_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::number;
using test::read_table;
using Row = std::map<std::string, std::string>;

const std::filesystem::path kWraps = CONDYLE_SOURCE_DIR "/../shared/published/wrapping";

struct Strand {
  LineElement element;
  std::shared_ptr<const WrappedPath> path;
};

/// Body-fixed angles about x, y, z.
PathWrap wrap_of(const Row& row) {
  const auto turned = [&](const char* axis, const Vector3d& about) {
    return exp_rotation(number(row, std::string("body_fixed_") + axis + "_rad") * about);
  };
  PathWrap wrap;
  wrap.name = row.at("wrap_object");
  wrap.on_moving = row.at("body") == "tibia_proximal_r";
  wrap.placement.R = turned("x", Vector3d::UnitX()) * turned("y", Vector3d::UnitY()) *
                     turned("z", Vector3d::UnitZ());
  wrap.placement.p = 1000 * Vector3d(number(row, "tx_m"), number(row, "ty_m"), number(row, "tz_m"));
  const double a = 1000 * number(row, "a_or_radius_m");
  if (row.at("type") == "WrapCylinder") {
    wrap.shape = WrapCylinder{a};
  } else {
    wrap.shape = WrapEllipsoid{{a, 1000 * number(row, "b_or_length_m"), 1000 * number(row, "c_m")}};
  }
  return wrap;
}

std::map<std::string, Strand> wrapped_strands() {
  std::map<std::string, Row> wraps;
  for (const Row& row : read_table(kWraps / "lenhart2015_wraps.csv", ','))
    wraps[row.at("strand")] = row;
  std::map<std::string, Strand> strands;
  for (const Row& row : read_table(test::kJamFolder / "lenhart2015_ligaments.csv", ',')) {
    if (row.at("frame1") != "femur_distal_r" || row.at("frameN") != "tibia_proximal_r") continue;
    const auto wrap = wraps.find(row.at("name"));
    if (wrap == wraps.end()) continue;
    const Vector3d femur(number(row, "x1_m"), number(row, "y1_m"), number(row, "z1_m"));
    const Vector3d tibia(number(row, "xN_m"), number(row, "yN_m"), number(row, "zN_m"));
    const auto path = make_wrapped_path({wrap_of(wrap->second)}, 1000 * femur, 1000 * tibia,
                                        InsideRule::kStraight);
    const ToeLinearLaw law{number(row, "linear_stiffness_N_per_strain"), 0.06,
                           1000 * number(row, "slack_length_m")};
    strands[row.at("name")] = {{1000 * femur, 1000 * tibia, law, path}, path};
  }
  return strands;
}

class JamWraps : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test::kJamFolder) || !std::filesystem::exists(kWraps))
      GTEST_SKIP() << "no specimen at " << test::kJamFolder << " or " << kWraps;
    strands_ = wrapped_strands();
    rows_ = read_table(kWraps / "jam_vs_exact_10poses.csv", ',');
    poses_ = test::flexions_and_poses();
  }
  [[nodiscard]] RigidTransform pose(const Row& row) const {
    return poses_.at(static_cast<std::size_t>(number(row, "frame"))).second;
  }
  std::map<std::string, Strand> strands_;
  test::Table rows_;
  std::vector<std::pair<double, RigidTransform>> poses_;
};

TEST_F(JamWraps, LengthsAreTheExactOnesAndNearThoseOfJam) {
  ASSERT_EQ(strands_.size(), 24u);
  ASSERT_EQ(rows_.size(), 240u);
  int wrapped = 0;
  for (const Row& row : rows_) {
    SCOPED_TRACE(row.at("strand") + " at " + row.at("nominal_deg"));
    const Strand& strand = strands_.at(row.at("strand"));
    const RigidTransform X = pose(row);
    auto kept = unknown_path();
    const LineElementState state = line_element_state(strand.element, X, kept.data());
    // Half a unit of the last printed digit, 1e-10 m, and 1e-9 m of the requirement.
    EXPECT_NEAR(state.length, 1000 * number(row, "exact_length_m"), 1e-6);
    EXPECT_NEAR(state.length, 1000 * number(row, "jam_length_m"), 5e-3);
    EXPECT_NEAR(state.force, number(row, "jam_force_N"), 0.05);
    const auto touch = strand.path->touches(ends_of(strand.element, X), X, kept.data()).at(0);
    EXPECT_EQ(touch.touching, row.at("status") == "wrapped");
    EXPECT_NEAR(touch.arc, 1000 * number(row, "arc_on_surface_m"), 1e-6);
    if (!touch.touching) continue;
    ++wrapped;
    const Vector3d P(number(row, "touch_P_x_body_m"), number(row, "touch_P_y_body_m"),
                     number(row, "touch_P_z_body_m"));
    EXPECT_LT((touch.P - 1000 * P).norm(), 2e-6);
    const Vector3d e(number(row, "unit_tangent_at_femur_x_in_wrap_body"),
                     number(row, "unit_tangent_at_femur_y"),
                     number(row, "unit_tangent_at_femur_z"));
    EXPECT_LT((touch.t_P - e).norm(), 1e-8);
  }
  EXPECT_GT(wrapped, 100);
}

// From the first pose on, the path of each strand is that of the frame before, its statuses revised.
TEST_F(JamWraps, CarriedThroughTheFlexionAndBackTheyAreThose) {
  for (const auto& named : strands_) {
    const std::string& name = named.first;
    const Strand& strand = named.second;  // not bound: Clang 14 captures no structured bindings
    auto kept = unknown_path();
    std::vector<double> lengths;
    const auto at = [&](std::size_t frame) {
      const RigidTransform& X = poses_[frame].second;
      double L = line_element_state(strand.element, X, kept.data()).length;
      if (strand.path->revise(ends_of(strand.element, X), X, kept.data()))
        L = line_element_state(strand.element, X, kept.data()).length;
      return L;
    };
    for (std::size_t frame = 50; frame < poses_.size(); ++frame) lengths.push_back(at(frame));
    for (const Row& row : rows_)
      if (row.at("strand") == name) {
        const auto frame = static_cast<std::size_t>(number(row, "frame"));
        EXPECT_NEAR(lengths.at(frame - 50), 1000 * number(row, "exact_length_m"), 1e-6) << name;
      }
    for (std::size_t frame = poses_.size(); frame-- > 50;)
      EXPECT_NEAR(at(frame), lengths[frame - 50], 1e-9) << name << " at frame " << frame;
  }
}

}  // namespace
}  // namespace condyle
