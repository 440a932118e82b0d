/// Strongly conforming surfaces, as of a total knee: condyles of 24 mm on inserts of 24.001 to 30
/// mm, exact and as patches fitted to meshes.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "condyle/equilibrium/edge_in_words.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/exact_surfaces.h"
#include "support/known_part.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr double kCondyle = 24, kAside = 23;  // radius, half the distance of the compartments [mm]

constexpr const char* kHead = R"(title = "Total knee"
[units]
length = "mm"
angle = "deg"
force = "N"
[[body]]
name = "femur"
fixed = true
[[body]]
name = "tibia"
[joint]
side = "right"
femur = { body = "femur", origin = [0,0,0], lateral = [0,0,1], anterior = [1,0,0], proximal = [0,1,0] }
tibia = { body = "tibia", origin = [0,0,0], lateral = [0,0,1], anterior = [1,0,0], proximal = [0,1,0] }
)";

/// Ligaments, the load on the insert, and flexion by ten degrees.
std::string rest(double to) {
  std::string text;
  const auto strand = [&](const char* name, const char* femur, const char* tibia, double k,
                          double strain) {
    text += fmt::format(
        "[[ligament]]\nname = \"{}\"\nends = [{{ body = \"femur\", at = {} }}, {{ body = "
        "\"tibia\", "
        "at = {} }}]\nlaw = \"toe-linear\"\nstiffness = {}\nreference_strain = {}\n",
        name, femur, tibia, k, strain);
  };
  strand("PCL", "[-5, -5, -5]", "[-20, -35, 0]", 3000, 0);
  strand("aMCL", "[3, 3, -40]", "[8, -60, -30]", 2500, 0.03);
  strand("pMCL", "[-3, 3, -40]", "[-2, -60, -30]", 2500, 0.03);
  strand("LCL", "[-1, 5, 40]", "[-15, -45, 36]", 2000, 0.04);
  strand("mCAP", "[-15, 15, -23]", "[-20, -35, -20]", 2000, 0.04);
  strand("lCAP", "[-15, 15, 23]", "[-20, -35, 20]", 2000, 0.04);
  return text + fmt::format(
                    "[[condition]]\nname = \"flexion\"\nkind = \"flexion\"\nvalue = 0\n"
                    "[[load]]\nname = \"weight\"\nbody = \"tibia\"\nkind = \"force\"\n"
                    "vector = [0, 300, 0]\nat = [3, -30, 2]\nfollows = \"body\"\n"
                    "[sweep]\nvary = \"flexion\"\nfrom = 0\nto = {}\nstep = 10\n",
                    to);
}

void expect_all(const SweepResult& result) {
  for (const PoseResult& pose : result.poses) {
    EXPECT_TRUE(pose.converged()) << pose.value / kDegree << ": " << pose.reason;
    if (!pose.converged()) continue;
    for (const ContactResult& contact : pose.contacts) EXPECT_GT(contact.force, 0);
  }
}

// 24.0001 leaves a relative curvature of 2e-7 per mm: still a point, and where the centres of ball
// and cup say.
TEST(Implants, BallsInCupsOfNearlyTheirRadiusAreCarried) {
  for (const double cup : {24.0001, 24.001, 25.0, 27.0, 30.0}) {
    std::string text = kHead;
    for (const char* side : {"medial", "lateral"}) {
      const double z = side[0] == 'm' ? -kAside : kAside;
      text += fmt::format(
          "[[surface]]\nname = \"{0} condyle\"\nbody = \"femur\"\nkind = \"sphere\"\n"
          "center = [0, 0, {1}]\nradius = {2}\n"
          "[[surface]]\nname = \"{0} insert\"\nbody = \"tibia\"\nkind = \"sphere\"\n"
          "solid = \"outside\"\ncenter = [0, {3}, {1}]\nradius = {4}\n"
          "[[contact]]\nname = \"{0}\"\nsurfaces = [\"{0} condyle\", \"{0} insert\"]\n",
          side, z, kCondyle, cup - kCondyle, cup);
    }
    const Scene scene = parse_scene(text + rest(120), "implant.toml");
    const SweepResult result = sweep(scene, fit_surfaces(scene));
    ASSERT_EQ(result.poses.size(), 13U);
    expect_all(result);
    for (const PoseResult& pose : result.poses) {
      // 1/24 - 1/25 is 4 % of 1/24, 1/24 - 1/27 is 11 %.
      const bool said = pose.remark.find("\"medial\" nearly conforms") != std::string::npos;
      EXPECT_EQ(said, cup < 26) << cup << ": " << pose.remark;
      for (std::size_t k = 0; k < 2; ++k) {
        const double z = k == 0 ? -kAside : kAside;
        const Vector3d between = pose.X_BA * Vector3d(0, cup - kCondyle, z) - Vector3d(0, 0, z);
        EXPECT_NEAR(between.norm(), cup - kCondyle, 1e-9) << cup;
        const Vector3d place = Vector3d(0, 0, z) - kCondyle / (cup - kCondyle) * between;
        ASSERT_EQ(pose.contacts[k].points.size(), 1U) << cup;
        // The direction from centre to centre is known to 1e-12 mm of their distance.
        EXPECT_LT((pose.contacts[k].points[0].point_ground - place).norm(),
                  1e-9 * kCondyle / (cup - kCondyle));
      }
    }
  }
}

/// Part of a torus about the z-axis through (0, y, z), as an open sheet: radius `sagittal` outside,
/// `coronal` across; turned by `from` to `to` from the lowest point forwards [deg], and by `half`
/// to either side. `out`: its normal points away from the axis.
struct Sheet {
  double sagittal, coronal, y, z, from, to, half;
  bool out;
};

std::string off_file(const std::vector<Sheet>& sheets) {
  constexpr int nu = 80, nv = 36;
  std::string vertices, faces;
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    const Sheet& sheet = sheets[s];
    const auto at = [&](int i, int j) { return static_cast<int>(s) * nu * nv + i * nv + j; };
    for (int i = 0; i < nu; ++i)
      for (int j = 0; j < nv; ++j) {
        const double phi = (sheet.from + (sheet.to - sheet.from) * i / (nu - 1)) * kDegree;
        const double theta = sheet.half * (2.0 * j / (nv - 1) - 1) * kDegree;
        const double rho = sheet.sagittal - sheet.coronal * (1 - std::cos(theta));
        vertices += fmt::format("{} {} {}\n", rho * std::sin(phi), sheet.y - rho * std::cos(phi),
                                sheet.z + sheet.coronal * std::sin(theta));
        if (i == 0 || j == 0) continue;
        const std::array<int, 4> q = {at(i - 1, j - 1), at(i, j - 1), at(i, j), at(i - 1, j)};
        for (const auto& [a, b, c] : {std::array{q[0], q[1], q[2]}, {q[0], q[2], q[3]}})
          faces += sheet.out ? fmt::format("3 {} {} {}\n", a, b, c)
                             : fmt::format("3 {} {} {}\n", a, c, b);
      }
  }
  const std::size_t n = sheets.size();
  return fmt::format("OFF\n{} {} 0\n", n * nu * nv, 2 * n * (nu - 1) * (nv - 1)) + vertices + faces;
}

/// A total knee as meshes in a folder, and its scene; the coronal radius of the insert is 2 mm
/// greater.
Scene fitted_knee(const fs::path& folder, double insert, const char* fit, double to) {
  std::vector<Sheet> femur, tibia;
  std::string text = kHead;
  for (const char* side : {"medial", "lateral"}) {
    const double z = side[0] == 'm' ? -kAside : kAside;
    femur.push_back({kCondyle, 20, 0, z, -150, 60, 60, true});
    tibia.push_back({insert, 22, insert - kCondyle, z, -50, 50, 39, false});
    text += fmt::format(
        "[[surface]]\nname = \"{0} condyle\"\nbody = \"femur\"\nkind = \"patch\"\n"
        "compartment = \"{0}\"\nmesh = \"femur.off\"\n{1}"
        "[[surface]]\nname = \"{0} insert\"\nbody = \"tibia\"\nkind = \"patch\"\n"
        "compartment = \"{0}\"\nmesh = \"insert.off\"\n{1}"
        "[[contact]]\nname = \"{0}\"\nsurfaces = [\"{0} condyle\", \"{0} insert\"]\n",
        side, fit);
  }
  std::ofstream(folder / "femur.off") << off_file(femur);
  std::ofstream(folder / "insert.off") << off_file(tibia);
  return parse_scene(text + rest(to), folder / "implant.toml");
}

// The sagittal radius of the insert is 1 to 6 mm greater. The meshes have no texture that would
// have to be smoothed away.
TEST(Implants, FittedCondylesOnDishedInsertsAreCarried) {
  const fs::path folder = test::fresh_folder("implants");
  for (const double insert : {25.0, 27.0, 30.0}) {
    const Scene scene = fitted_knee(folder, insert, "fit = { smoothing = 1 }\n", 100);
    const SweepResult result = sweep(scene, fit_surfaces(scene));
    ASSERT_EQ(result.poses.size(), 11U);
    expect_all(result);
    // At rest in its dish the tibia stays where it was, to what the fits differ from the tori.
    EXPECT_LT(std::abs(result.poses[0].joint.distraction), 0.1);
  }
  fs::remove_all(folder);
}

// With smoothing chosen for position the patches are 0.01 to 0.03 mm off, and the upper end of the
// condyle meets the insert from 95 degrees on, while the contact is still 8 mm from it. A point at
// an edge has no normal in common with the other surface: no rigid contact, and said so.
TEST(Implants, ACondyleThatEndsInTheInsertSaysWhichEndAndHowDeep) {
  const fs::path folder = test::fresh_folder("implants");
  const Scene scene = fitted_knee(folder, 25, "fit = { smoothing = \"position\" }\n", 120);
  const SweepResult result = sweep(scene, fit_surfaces(scene));
  ASSERT_EQ(result.poses.size(), 13U);
  for (const PoseResult& pose : result.poses) {
    const double degrees = pose.value / kDegree;
    SCOPED_TRACE(degrees);
    if (degrees < 91) {
      EXPECT_TRUE(pose.converged()) << pose.reason;
      continue;
    }
    EXPECT_FALSE(pose.converged());
    for (const char* words : {" runs over an edge: ", " condyle\" ends 0.0",
                              " mm deep in the other surface at its posterior end, "})
      EXPECT_NE(pose.reason.find(words), std::string::npos) << pose.reason;
    if (degrees < 101) {
      EXPECT_EQ(name(pose.status), std::string("left patch"));
      for (const ContactResult& contact : pose.contacts) {
        EXPECT_GT(contact.force, 0);
        EXPECT_GT(contact.points.at(0).edge_distance, 5);
      }
    }
  }
  fs::remove_all(folder);
}

// Ends of a condyle are named along its surface: 150 degrees behind its lowest point it leads
// forwards again. Neither side nor the directions of the files matter.
TEST(Implants, EndsOfACondyleAreNamedAlongItsSurface) {
  const std::shared_ptr<const Surface> ball = make_sphere({0, 0, 0}, kCondyle, true);
  for (const double side : {1.0, -1.0})
    for (const double turned : {0.0, 1.0, 2.5})
      for (const double end : {-110.0, -80.0, -20.0, 20.0, 80.0, 110.0, 150.0}) {
        SCOPED_TRACE(testing::Message() << side << " " << turned << " " << end);
        RigidTransform X;
        X.R = Eigen::AngleAxisd(turned, Vector3d(1, 2, 3).normalized());
        // From the lowest point backwards; columns of the frame: lateral or medial, forwards, up.
        const auto angle = [X](const Vector3d& c) {
          const Vector3d p = X.R.transpose() * c;
          return std::atan2(-p.y(), -p.z());
        };
        const auto known = [angle, end](const Vector3d& c) {
          return kCondyle * (std::abs(end) * kDegree - std::copysign(1.0, end) * angle(c));
        };
        Model model;
        model.length = 30;
        model.joint = JointFrames{X, {}, true, side};
        ContactPair pair;
        pair.name = "medial";
        pair.on_B = std::make_shared<test::KnownPart>(ball, known);
        pair.on_A = make_plane({0, 0, 0}, {0, 0, 1});
        model.pairs = {pair};
        const double a = end * kDegree;
        const Vector3d at = X.R * Vector3d(0, -kCondyle * std::sin(a), -kCondyle * std::cos(a));
        const std::string words =
            edge_in_words(model, {0, {pair.on_B->seed(at), pair.on_A->seed({0, 0, 0})}, 0});
        const char* expected = end > 0 ? " at its posterior end, " : " at its anterior end, ";
        EXPECT_NE(words.find(expected), std::string::npos) << words;
      }
}

// The notch's edge in front leads more backwards than sidewards; all of the condyle's back lies
// behind it.
TEST(Implants, AnEdgeInFrontThatLeadsBackwardsIsASideAndNoEnd) {
  const std::shared_ptr<const Surface> ball = make_sphere({0, 0, 0}, kCondyle, true);
  for (const double side : {1.0, -1.0}) {
    const double a = 40 * kDegree;
    const Vector3d at = kCondyle * Vector3d(0, std::sin(a), -std::cos(a));
    const Vector3d backwards(0, -std::cos(a), -std::sin(a));
    const Vector3d out = (0.4 * side * Vector3d::UnitX() + backwards).normalized();
    const auto known = [at, out, side](const Vector3d& c) {
      return std::max(-out.dot(c - at), -side * c.x() - 3);
    };
    Model model;
    model.length = 30;
    model.joint = JointFrames{{}, {}, true, side};
    ContactPair pair;
    pair.name = "medial";
    pair.on_B = std::make_shared<test::KnownPart>(ball, known);
    pair.on_A = make_plane({0, 0, 0}, {0, 0, 1});
    model.pairs = {pair};
    const ClosedContact rim{0, {pair.on_B->seed(at), pair.on_A->seed({0, 0, 0})}, 0};
    const std::string words = rim_in_words(model, rim, 0.5);
    EXPECT_NE(words.find(" ends 0.5 mm deep in the other surface at its lateral side, "),
              std::string::npos)
        << words;
  }
}

}  // namespace
}  // namespace condyle
