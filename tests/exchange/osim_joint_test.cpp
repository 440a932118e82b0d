/// Joints of OpenSim models: the functions of their coordinates, and chains of bodies.

#include <gtest/gtest.h>

#include <string>

#include "condyle/scene_file/read_scene.h"
#include "exchange/imported_model.h"
#include "scene/small_scene.h"

namespace condyle {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// The model with a function of its own along the joint's y.
OsimScene imported_with_function(const std::string& function) {
  return imported_text(with(text_of_model(),
                            "<coordinates>knee_ty_r</coordinates><axis>0 1 0</axis><LinearFunction "
                            "name=\"function\"><coefficients> 1 0</coefficients></LinearFunction>",
                            "<coordinates>knee_ty_r</coordinates><axis>0 1 0</axis>" + function),
                       "osim_function");
}

TEST(OsimJoint, ReadsTheFunctionsOfTheJoint) {
  const fs::path nowhere = fs::path(testing::TempDir()) / "osim_function" / "knee.toml";
  const auto start = [&](const OsimScene& scene) {
    const Scene read = parse_scene(scene.text, nowhere, false);
    return read.bodies[static_cast<std::size_t>(read.moving_body())].start_translation.y();
  };
  const double without = start(imported_with_function("<Constant><value>0</value></Constant>"));
  const auto moved = [&](const std::string& function) {
    return start(imported_with_function(function)) - without;
  };
  const double constant = moved("<Constant><value>0.004</value></Constant>");
  EXPECT_NEAR(std::abs(constant), 4, 1e-9);  // [mm]
  const std::string values = "<x> -1 0 1</x><y> 0.009 0.004 0.01</y>";
  for (const std::string& function : {
           std::string("<PolynomialFunction><coefficients> 3 0.004</coefficients>"
                       "</PolynomialFunction>"),
           "<GCVSpline>" + values + "</GCVSpline>",
           "<SimmSpline>" + values + "</SimmSpline>",
           std::string("<MultiplierFunction><scale>2</scale><function><Constant>"
                       "<value>0.002</value></Constant></function></MultiplierFunction>"),
       })
    EXPECT_NEAR(moved(function), constant, 1e-9) << function;
  const OsimScene unread = imported_with_function("<Sine><amplitude>1</amplitude></Sine>");
  EXPECT_TRUE(has_note(unread, "a Sine of CustomJoint knee_r, taken as 0 in the start pose"));
  for (const char* points : {"<x> 0 0</x><y> 1 2</y>", "<x> 0 1</x><y> 1</y>"})
    EXPECT_TRUE(
        has_note(imported_with_function("<SimmSpline>" + std::string(points) + "</SimmSpline>"),
                 "a SimmSpline of CustomJoint knee_r, taken as 0 in the start pose"))
        << points;
}

/// However deep, and however many bodies are welded to one another.
TEST(OsimJoint, TakesNestedFunctionsAndLongChains) {
  std::string nested = "<Constant><value>0</value></Constant>";
  const std::string open = "<MultiplierFunction><function>",
                    shut = "</function></MultiplierFunction>";
  std::string before, after;
  for (int i = 0; i < 100000; ++i) before += open, after += shut;
  EXPECT_NO_THROW((void)imported_with_function(before + nested + after));
  std::string bodies, joints;
  for (int i = 1000; i-- > 0;) {
    const std::string name = "link" + std::to_string(i);
    bodies += "<Body name=\"" + name + "\"><mass>1</mass></Body>";
    joints += "<WeldJoint name=\"weld" + std::to_string(i) + "\"><socket_parent_frame>/bodyset/" +
              (i == 0 ? "tibia_proximal_r" : "link" + std::to_string(i - 1)) +
              "</socket_parent_frame><socket_child_frame>/bodyset/" + name +
              "</socket_child_frame></WeldJoint>";
  }
  std::string text = with(text_of_model(), "<Body name=\"femur_distal_r\">",
                          bodies + "<Body name=\"femur_distal_r\">");
  text = with(text, "<CustomJoint name=\"knee_r\">", joints + "<CustomJoint name=\"knee_r\">");
  const OsimScene scene = imported_text(text, "osim_chain");
  for (const std::string& note : scene.notes)
    EXPECT_EQ(note.find("link"), std::string::npos) << note;  // none is another body
}

}  // namespace
}  // namespace condyle
