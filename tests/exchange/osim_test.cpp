/// Import of OpenSim-JAM models: the phantom knee written as JAM would write it, and what is wrong
/// with a model.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "condyle/equilibrium/sweep.h"
#include "condyle/exchange/osim_scene.h"
#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "exchange/imported_model.h"
#include "scene/small_scene.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

using namespace test;
namespace fs = std::filesystem;

TEST(OsimImport, FindsTheLigamentsOfTheScene) {
  const Scene scene = parse_scene(imported(kPhantomModel, kUnwrittenScene).text, kUnwrittenScene);
  const Scene phantom = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/knee.toml");
  ASSERT_EQ(scene.ligaments.size(), phantom.ligaments.size());
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDescription &ours = scene.ligaments[i], &theirs = phantom.ligaments[i];
    EXPECT_EQ(ours.name, theirs.name);
    const auto& a = std::get<ToeLinearLaw>(ours.law);
    const auto& b = std::get<ToeLinearLaw>(theirs.law);
    // aMCL runs on along the tibia in the model, LCL is given in a body welded to the tibia.
    EXPECT_NEAR(a.stiffness, b.stiffness, 1e-8) << ours.name;
    EXPECT_NEAR(a.transition_strain, b.transition_strain, 1e-12) << ours.name;
    EXPECT_NEAR(a.slack_length, b.slack_length, 1e-9) << ours.name;
    for (std::size_t end = 0; end < 2; ++end) {
      EXPECT_EQ(ours.ends[end].body, theirs.ends[end].body);
      EXPECT_LT((ours.ends[end].at - theirs.ends[end].at).norm(), 1e-9) << ours.name;
    }
  }
}

// JAM's contact is an elastic foundation, and so is that of the scene.
TEST(OsimImport, TakesTheLayersOfTheModel) {
  const Scene scene = parse_scene(imported(kPhantomModel, kUnwrittenScene).text, kUnwrittenScene);
  for (const SurfaceDescription& surface : scene.surfaces) {
    ASSERT_TRUE(surface.elastic);
    EXPECT_DOUBLE_EQ(surface.elastic->modulus, 10);
    EXPECT_DOUBLE_EQ(surface.elastic->poisson, 0.45);
    EXPECT_DOUBLE_EQ(surface.elastic->layer, 3);
  }
  for (const ContactDescription& contact : scene.contacts) {
    ASSERT_TRUE(contact.layer);
    EXPECT_EQ(contact.layer->pressure, PressureLaw::kLinear);
  }
}

TEST(OsimImport, SweepsLikeTheSceneItStandsFor) {
  Scene scene = parse_scene(imported(kPhantomModel, kUnwrittenScene).text, kUnwrittenScene);
  Scene phantom = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/knee.toml");
  scene.loads = phantom.loads;  // a JAM model has muscles instead
  phantom.sweep->values = scene.sweep->values = {0, M_PI / 6, M_PI / 3, M_PI / 2};
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    ASSERT_EQ(scene.surfaces[i].name, phantom.surfaces[i].name);
    scene.surfaces[i].patch.smoothing = phantom.surfaces[i].patch.smoothing;
    phantom.surfaces[i].elastic = scene.surfaces[i].elastic;
  }
  // The scene's contacts are rigid, the model's are layers.
  for (std::size_t k = 0; k < scene.contacts.size(); ++k)
    phantom.contacts[k].layer = scene.contacts[k].layer;
  const SweepResult ours = sweep(scene, fit_surfaces(scene));
  const SweepResult theirs = sweep(phantom, fit_surfaces(phantom));
  ASSERT_EQ(theirs.count_converged(), 4);
  ASSERT_EQ(ours.count_converged(), 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const PoseResult &a = ours.poses[i], &b = theirs.poses[i];
    EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), 1e-9);
    EXPECT_LT((a.X_BA.R - b.X_BA.R).norm(), 1e-10);
    for (std::size_t k = 0; k < a.ligaments.size(); ++k)
      EXPECT_NEAR(a.ligaments[k].force, b.ligaments[k].force, 1e-7);  // k/l₀ of 100 N/mm, 1e-9 mm
    for (std::size_t k = 0; k < a.contacts.size(); ++k)
      EXPECT_NEAR(a.contacts[k].force, b.contacts[k].force, 1e-6);
  }
}

TEST(OsimImport, SaysWhatItLeavesOut) {
  const OsimScene scene = imported(kPhantomModel, kUnwrittenScene);
  for (const char* note : {
           "contact pf_contact: not between femur and tibia",
           "4 strands with a wrap object that is on another bone, not active or of another kind, "
           "taken "
           "without: iMCL, pMCL, aDMCL, pDMCL",
           "1 strand with points along a bone, replaced by their free part: aMCL",
           "1 strand to other bones, over both bones twice, or without force: PT1",
           "damping of the ligaments",
           "1 Millard2012EquilibriumMuscle",
           "other bodies: pelvis, patella_r",
       }) {
    EXPECT_TRUE(has_note(scene, note)) << note;
    EXPECT_NE(scene.text.find(std::string("# - ") + note), std::string::npos) << note;
  }
}

// Of the scene nobody has seen a line.
TEST(OsimImport, NamesTheModelWhereANumberMakesNoScene) {
  try {
    (void)imported_text(with(text_of_model(), "<linear_stiffness>1500<", "<linear_stiffness>-5<"),
                        "osim_numbers");
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("model.osim: makes no scene: "), std::string::npos) << text;
    EXPECT_NE(text.find("\"aACL\": stiffness = -5, expected"), std::string::npos) << text;
    EXPECT_EQ(text.find("knee.toml"), std::string::npos) << text;
  }
}

/// Names of a model stand in comments of the scene: after a line's end they would be lines of it.
TEST(OsimImport, WritesNoLineThatANameBegins) {
  const OsimScene scene = imported_text(with(text_of_model(), "CustomJoint name=\"knee_r\"",
                                             "CustomJoint name=\"a&#10;[intruder]&#10;knee_r\""),
                                        "osim_names");
  EXPECT_NE(scene.text.find("[intruder]"), std::string::npos);
  EXPECT_EQ(scene.text.find("\n[intruder]"), std::string::npos) << scene.text;
}

/// Neither the file of an entity nor a billion of them.
TEST(OsimImport, KnowsNoEntities) {
  const std::string entities =
      "<!DOCTYPE a [<!ENTITY file SYSTEM \"file:///etc/passwd\"><!ENTITY b \"ha\"><!ENTITY c "
      "\"&b;&b;&b;&b;&b;&b;&b;&b;\">]>\n<OpenSimDocument";
  const std::string text = with(text_of_model(), "<OpenSimDocument", entities);
  const OsimScene scene =
      imported_text(with(text, "<Model name=\"phantom\"", "<Model name=\"&file;&c;\""), "osim_xml");
  EXPECT_EQ(parse_scene(scene.text, kUnwrittenScene).title, "&file;&c;, right knee");
}

// Four strands of the model name an object that it does not hold. Here it does: an ellipsoid on the tibia
// whose axes are turned about x, y and z, as turned so far, and a torus, by OpenSim's names of its radii.
TEST(OsimImport, TakesWrapObjectsOver) {
  std::string text = with_all(text_of_model(), "../../meshes", CONDYLE_SOURCE_DIR "/meshes");
  text = with(text, "<mass>1</mass></Body>\n<Body name=\"tibia_r\">",
              "<WrapObjectSet name=\"wrapobjectset\"><objects>"
              "<WrapEllipsoid name=\"Med_Lig_r\"><active>true</active>"
              "<xyz_body_rotation>0.1 -0.2 0.3</xyz_body_rotation>"
              "<translation>0.001 -0.0346 -0.0187</translation><quadrant>-y</quadrant>"
              "<dimensions>0.03 0.018 0.012</dimensions></WrapEllipsoid>"
              "<WrapTorus name=\"ring\"><inner_radius>0.004</inner_radius>"
              "<outer_radius>0.02</outer_radius></WrapTorus></objects></WrapObjectSet>"
              "<mass>1</mass></Body>\n<Body name=\"tibia_r\">");
  text = with(text, "<wrap_object>Med_Lig_r</wrap_object>", "<wrap_object>ring</wrap_object>");
  const fs::path folder = test::scratch_folder("osim_wraps");
  fs::create_directories(folder);
  const fs::path file = folder / "model.osim";
  std::ofstream(file) << text;
  const OsimScene scene_file = imported(file, folder / "knee.toml");
  fs::remove_all(folder);
  const Scene scene = parse_scene(scene_file.text, folder / "knee.toml");
  ASSERT_EQ(scene.wraps.size(), 2U);
  const WrapDescription &torus = scene.wraps[0], &ellipsoid = scene.wraps[1];
  EXPECT_DOUBLE_EQ(std::get<WrapTorus>(torus.shape).ring, 20);
  EXPECT_DOUBLE_EQ(std::get<WrapTorus>(torus.shape).tube, 4);
  EXPECT_EQ(ellipsoid.name, "Med_Lig_r");
  EXPECT_EQ(scene.bodies[static_cast<std::size_t>(ellipsoid.body)].name, "tibia");
  EXPECT_LT(
      (std::get<WrapEllipsoid>(ellipsoid.shape).semi_axes - Eigen::Vector3d(30, 18, 12)).norm(),
      1e-9);
  const Eigen::Matrix3d R =
      exp_rotation({0.1, 0, 0}) * exp_rotation({0, -0.2, 0}) * exp_rotation({0, 0, 0.3});
  EXPECT_LT((ellipsoid.placement.R - R).norm(), 1e-10);
  EXPECT_LT((ellipsoid.placement.p - Eigen::Vector3d(1, -34.6, -18.7)).norm(), 1e-9);
  int wrapped = 0;
  for (const LigamentDescription& ligament : scene.ligaments) {
    if (ligament.path.wraps.empty()) continue;
    ++wrapped;
    EXPECT_FALSE(ligament.path.anchors_inside);
    EXPECT_EQ(ligament.path.sides.size(), ligament.path.wraps[0] == 1 ? 1U : 0U);
    if (ligament.path.sides.empty()) continue;
    EXPECT_LT(R.col(1).dot(ligament.path.sides[0] - ellipsoid.placement.p), -18);
  }
  EXPECT_EQ(wrapped, 4);
}

class BrokenModel : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "deep" / "er");
    text_ = text_of_model();
  }
  void TearDown() override { fs::remove_all(folder_); }

  void expect_error(const std::string& text, const std::string& message) {
    const fs::path file = folder_ / "deep" / "er" / "model.osim";
    std::ofstream(file) << text;
    try {
      (void)imported(file, folder_ / "scene.toml");
      FAIL() << "expected: " << message;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), file.string() + message);
    }
  }

  fs::path folder_ = test::scratch_folder("osim");
  std::string text_;
};

TEST_F(BrokenModel, IsNamedWithWhatIsMissing) {
  expect_error("<OpenSimDocument Version=\"40000\">\n<Model>\n</Modl>",
               ":3: Start-end tags mismatch, expected an OpenSim model (XML)");
  expect_error("<other/>", ": holds no Model, expected an OpenSim model");
  expect_error(with(text_, "Version=\"40000\"", "Version=\"30000\""),
               ": OpenSimDocument Version = 30000, expected 30505 or later (OpenSim 4 saves such "
               "files)");
  expect_error(with(text_, "<length_units>m<", "<length_units>mm<"),
               ": length_units = mm, expected m");
  expect_error(with(text_, "<linear_stiffness>1500<", "<linear_stiffness>stiff<"),
               ": Blankevoort1991Ligament \"aACL\": linear_stiffness = stiff, expected numbers");
  expect_error(with(text_, "aACL-P1\"><socket_parent_frame>/bodyset/femur_distal_r<",
                    "aACL-P1\"><socket_parent_frame>/bodyset/femur_dist_r<"),
               ": Blankevoort1991Ligament \"aACL\": there is no frame /bodyset/femur_dist_r");
  expect_error(text_,
               ": Smith2018ContactMesh \"femur_cartilage\": mesh_file = "
               "../../meshes/femur.stl is neither beside the model nor in the folder "
               "Geometry there");
}

// Where a component stands is told by all that hold it: of thousands within each other that would take minutes.
TEST_F(BrokenModel, IsRefusedWhereItIsDeep) {
  std::string frames, ends;
  for (int k = 0; k < 20000; ++k) {
    frames += "<PhysicalOffsetFrame name=\"a\">";
    ends += "</PhysicalOffsetFrame>";
  }
  expect_error(
      "<OpenSimDocument Version=\"40000\"><Model>" + frames + ends + "</Model></OpenSimDocument>",
      ": components lie more than 100 deep within each other, expected an OpenSim model");
}

TEST_F(BrokenModel, NeedsAKneeWithLigamentsAndContacts) {
  std::string bare = text_;
  for (std::size_t at; (at = bare.find("<Blankevoort1991Ligament")) != std::string::npos;)
    bare.erase(at, bare.find("</Blankevoort1991Ligament>") + 26 - at);
  expect_error(bare, ": holds no Blankevoort1991Ligament, expected an OpenSim-JAM model of a knee");

  std::string no_joint = text_;
  for (const char* name : {"knee_r", "pf_r"}) {
    const std::size_t at = no_joint.find("<CustomJoint name=\"" + std::string(name));
    no_joint.erase(at, no_joint.find("</CustomJoint>", at) + 14 - at);
  }
  expect_error(no_joint,
               ": no joint is spanned by its ligaments, expected a knee joint between femur and "
               "tibia");

  std::string no_contact = text_;
  const std::size_t at = no_contact.find("<Smith2018ArticularContactForce name=\"tf");
  no_contact.erase(at, no_contact.find("</Smith2018ArticularContactForce>", at) + 33 - at);
  expect_error(no_contact,
               ": no Smith2018ArticularContactForce between the bones of knee_r, expected contact "
               "meshes of femur and tibia");
}

TEST(OsimImport, AsksWhichJointAndWhichSideIsMeant) {
  const auto message = [](const OsimModel& model, const OsimOptions& options) -> std::string {
    try {
      return find_knee(model, "m.osim", options).joint;
    } catch (const InputError& error) {
      return error.what();
    }
  };
  OsimModel model = read_osim(kPhantomModel);
  OsimOptions options;
  options.joint = "hip_r";
  EXPECT_EQ(message(model, options),
            "m.osim: --joint hip_r: no ligament spans a joint of this name, expected one of "
            "knee_r");
  for (OsimJoint& joint : model.joints)
    if (joint.name == "knee_r") joint.name = "knee";
  for (std::string& body : model.bodies)
    if (body == "femur_distal_r") body = "femur";
  for (OsimJoint& joint : model.joints)
    for (std::string* path : {&joint.parent, &joint.child})
      if (*path == "/bodyset/femur_distal_r") *path = "/bodyset/femur";
  for (std::vector<OsimMesh>* meshes : {&model.contact_meshes, &model.bone_meshes})
    for (OsimMesh& mesh : *meshes)
      if (mesh.path.find("distal") != mesh.path.npos || mesh.frame == "/bodyset/femur_distal_r")
        mesh.frame = "/bodyset/femur";
  for (OsimLigament& ligament : model.ligaments)
    for (OsimPathPoint& point : ligament.points)
      if (point.frame == "/bodyset/femur_distal_r") point.frame = "/bodyset/femur";
  EXPECT_EQ(message(model, {}),
            "m.osim: joint knee: its name does not end in _r or _l, expected --side");
  options = {};
  options.side = Side::kLeft;
  const OsimKnee left = find_knee(model, "m.osim", options);
  // z points to the right, which is inwards in a left knee.
  EXPECT_LT((left.femur.lateral + Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((left.femur.anterior - Eigen::Vector3d::UnitX()).norm(), 1e-15);
}

// The very model that the specimen's scene was made of, where somebody has put it there.
TEST(OsimImport, FindsTheLigamentsOfLenhart2015) {
  const fs::path folder = CONDYLE_SOURCE_DIR "/../shared/specimens/lenhart2015";
  if (!fs::exists(folder / "lenhart2015.osim"))
    GTEST_SKIP() << "there is no lenhart2015.osim in " << folder;
  const fs::path file = folder / "lenhart2015.osim";
  const OsimKnee knee = find_knee(read_osim(file), file.string());
  const Scene scene = read_scene(folder / "knee.toml");
  ASSERT_EQ(knee.ligaments.size(), scene.ligaments.size());
  for (std::size_t i = 0; i < knee.ligaments.size(); ++i) {
    EXPECT_EQ(knee.ligaments[i].name, scene.ligaments[i].name);
    EXPECT_LT((knee.ligaments[i].femur - scene.ligaments[i].ends[0].at).norm(), 1e-4);
    EXPECT_NEAR(knee.ligaments[i].slack_length, slack_length(scene.ligaments[i].law), 1e-4);
  }
}

}  // namespace
}  // namespace condyle
