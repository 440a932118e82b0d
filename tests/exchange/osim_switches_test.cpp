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

// Two balls on the tibia, one above the other: the strand passes the upper one first, whatever the list says.
TEST(OsimSwitches, WrapsAreInTheOrderInWhichTheStrandPassesThem) {
  const auto ball = [](const std::string& name, const std::string& height) {
    return "<WrapSphere name=\"" + name + "\"><translation>0 " + height +
           " -0.03</translation><radius>0.005</radius></WrapSphere>";
  };
  const auto wraps = [&](const std::string& first, const std::string& second) {
    std::string text =
        with(text_of_model(), "<mass>1</mass></Body>\n<Body name=\"tibia_r\">",
             "<WrapObjectSet name=\"wrapobjectset\"><objects>" + ball("lower", "-0.035") +
                 ball("upper", "-0.025") +
                 "</objects></WrapObjectSet><mass>1</mass></Body>\n<Body name=\"tibia_r\">");
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
  };
  EXPECT_EQ(wraps("lower", "upper"), "upper lower ");
  EXPECT_EQ(wraps("upper", "lower"), "upper lower ");
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
