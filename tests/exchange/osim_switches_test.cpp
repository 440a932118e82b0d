/// OpenSim models as scripts and older versions write them: what is switched off, where coordinates
/// stand, in which order a strand passes its wraps.

#include <gtest/gtest.h>

#include <string>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "exchange/imported_model.h"
#include "scene/small_scene.h"

namespace condyle {
namespace {

using namespace test;

const std::string kFirstLigament = "<Blankevoort1991Ligament name=\"aACL\">\n";
const std::string kApplies = "<appliesForce>true</appliesForce>";

std::size_t ligaments_of(const std::string& model) {
  const OsimScene scene = imported_text(model, "osim_switches");
  return parse_scene(scene.text, kUnwrittenScene, false).ligaments.size();
}

/// The model with another line in place of the first ligament's switch.
std::string with_switch(const std::string& line) {
  return with(text_of_model(), kFirstLigament + kApplies, kFirstLigament + line);
}

TEST(OsimSwitches, AreReadAsOpenSimReadsThem) {
  const std::size_t all = ligaments_of(text_of_model());
  for (const char* off : {"false", "False", " FALSE ", "0"})
    EXPECT_EQ(ligaments_of(with_switch(std::string("<appliesForce>") + off + "</appliesForce>")),
              all - 1)
        << off;
  for (const char* on : {"true", "True", "1", ""})
    EXPECT_EQ(ligaments_of(with_switch(std::string("<appliesForce>") + on + "</appliesForce>")),
              all)
        << on;
  EXPECT_EQ(ligaments_of(with_switch("<isDisabled>true</isDisabled>")), all - 1);
  EXPECT_EQ(ligaments_of(with_switch("<isDisabled>false</isDisabled>")), all);
  try {
    (void)ligaments_of(with_switch("<appliesForce>perhaps</appliesForce>"));
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("Blankevoort1991Ligament \"aACL\": appliesForce = perhaps, expected true or "
                  "false"),
        std::string::npos)
        << error.what();
  }
}

TEST(OsimSwitches, AContactThatIsOffIsNone) {
  const std::string begin = "<Smith2018ArticularContactForce name=\"tf_contact\">\n";
  const std::string off =
      with(text_of_model(), begin, begin + "<appliesForce>False</appliesForce>\n");
  try {
    (void)imported_text(off, "osim_switches");
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("no Smith2018ArticularContactForce between the bones of knee_r applies force "
                  "(tf_contact is off), expected one that does"),
        std::string::npos)
        << error.what();
  }
  // Beside one that is on it is left out, with a note.
  const std::size_t first = off.find(begin),
                    end = off.find("</Smith2018ArticularContactForce>", first);
  std::string second = off.substr(first, end + 33 - first);
  second =
      with(with(second, "tf_contact", "tf_spare"), "<appliesForce>False", "<appliesForce>True");
  std::string both = off;
  both.insert(first, second + "\n");
  const OsimScene scene = imported_text(both, "osim_switches");
  EXPECT_TRUE(has_note(scene, "contact tf_contact: applies no force"));
}

TEST(OsimSwitches, CoordinatesMayStandInASetOfTheirOwn) {
  const auto shift = [](const std::string& model) {
    const OsimScene scene = imported_text(model, "osim_switches");
    const Scene read = parse_scene(scene.text, kUnwrittenScene, false);
    return read.bodies[static_cast<std::size_t>(read.moving_body())].start_translation;
  };
  const std::string named = "<Coordinate name=\"knee_tx_r\"><default_value>";
  const std::string moved = with(text_of_model(), named + "0<", named + "0.005<");
  const Eigen::Vector3d still = shift(text_of_model());
  ASSERT_NEAR((shift(moved) - still).norm(), 5, 1e-9);  // [mm]
  const std::size_t joint = moved.find("<CustomJoint name=\"knee_r\"");
  std::string older = moved;
  const std::size_t close = older.find("</coordinates>\n", joint);
  older.replace(close, 14, "</objects></CoordinateSet>");
  older.replace(older.find("<coordinates><Coordinate ", joint), 13, "<CoordinateSet><objects>");
  EXPECT_LT((shift(older) - shift(moved)).norm(), 1e-12);
  const OsimScene lost = imported_text(
      with(text_of_model(), named + "0<", "<Coordinate name=\"other\"><default_value>0<"),
      "osim_switches");
  EXPECT_TRUE(
      has_note(lost,
               "a coordinate \"knee_tx_r\" without default of CustomJoint knee_r, taken as 0 "
               "in the start pose"));
}

/// Names of the wraps of the strand iMCL, which leads down the medial side from the femur to the tibia, in the order of the
/// scene: `objects` stand on the bone of `body`, `first` and `second` in the strand's list.
std::string wraps_of_strand(std::string text,
                            const std::string& body,
                            const std::string& objects,
                            const std::string& first,
                            const std::string& second) {
  const std::string head = "<Body name=\"" + body + "\">";
  text = with(text, head,
              head + "<WrapObjectSet name=\"wrapobjectset\"><objects>" + objects +
                  "</objects></WrapObjectSet>");
  text = with(text, "<wrap_object>Med_Lig_r</wrap_object></PathWrap>",
              "<wrap_object>" + first + "</wrap_object></PathWrap><PathWrap><wrap_object>" +
                  second + "</wrap_object></PathWrap>");
  const OsimScene scene = imported_text(text, "osim_switches");
  const Scene read = parse_scene(scene.text, kUnwrittenScene, false);
  std::string names;
  for (const LigamentDescription& ligament : read.ligaments)
    for (const int wrap : ligament.path.wraps)
      names += read.wraps[static_cast<std::size_t>(wrap)].name + " ";
  return names;
}

std::string ball(const std::string& name, const std::string& height) {
  return "<WrapSphere name=\"" + name + "\"><translation>0 " + height +
         " -0.03</translation><radius>0.005</radius></WrapSphere>";
}

/// About z, through a point that is far along its axis from where the strand passes.
std::string cylinder(const std::string& name, const std::string& height, const std::string& along) {
  return "<WrapCylinder name=\"" + name + "\"><translation>0 " + height + " " + along +
         "</translation><radius>0.005</radius></WrapCylinder>";
}

// Whatever the list says, and from whichever end the path is told: the strand passes the upper one first.
TEST(OsimSwitches, WrapsAreInTheOrderInWhichTheStrandPassesThem) {
  const std::string text = text_of_model();
  const std::size_t first = text.find("<PathPoint name=\"iMCL-P1\">"),
                    second = text.find("<PathPoint name=\"iMCL-P2\">"),
                    end = text.find("</PathPoint>", second) + 12;
  std::string from_tibia = text;
  from_tibia.replace(first, end - first,
                     text.substr(second, end - second) + text.substr(first, second - first));
  const std::string balls = ball("lower", "-0.035") + ball("upper", "-0.025"),
                    cylinders =
                        cylinder("lower", "-0.035", "0.5") + cylinder("upper", "-0.025", "-0.5"),
                    femoral = ball("lower", "0.002") + ball("upper", "0.006");
  for (const std::string& model : {text, from_tibia})
    for (const auto& [one, other] : {std::pair{"lower", "upper"}, {"upper", "lower"}}) {
      EXPECT_EQ(wraps_of_strand(model, "tibia_r", balls, one, other), "upper lower ");
      EXPECT_EQ(wraps_of_strand(model, "tibia_r", cylinders, one, other), "upper lower ");
      EXPECT_EQ(wraps_of_strand(model, "femur_distal_r", femoral, one, other), "upper lower ");
    }
}

TEST(OsimSwitches, AStrandThatIsNeverFreeHasANoteOfItsOwn) {
  const std::size_t at = text_of_model().find("<Blankevoort1991Ligament name=\"aMCL\"");
  std::string text = text_of_model();
  const std::size_t slack = text.find("<slack_length>", at) + 14;
  text.replace(slack, text.find('<', slack) - slack, "0.015");
  EXPECT_TRUE(
      has_note(imported_text(text, "osim_switches"),
               "1 strand with a slack length that is 0, or no longer than what lies along the "
               "bones: aMCL"));
}

}  // namespace
}  // namespace condyle
