/// Tables of measurements: what is read, and what is refused in which words.

#include "condyle/calibration/measurement_table.h"
#include "condyle/math/degree.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "calibration/small_calibration.h"

namespace condyle::test {
namespace {

/// In a folder of each test's own.
std::filesystem::path table_folder() {
  const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = info->name();
  std::replace(name.begin(), name.end(), '/', '-');
  return fresh_folder("measurements " + name);
}

MeasurementTable table_of(const std::string& text) {
  Scene scene = scene_beside(table_folder(), text);
  scene.calibration->relative.clear();
  return read_measurements(scene);
}

/// What is said of a table, without the folder.
std::string told_of(const Scene& scene) {
  try {
    (void)read_measurements(scene);
  } catch (const InputError& error) {
    std::string said = error.what();
    const std::string folder = scene.file.parent_path().string() + "/";
    for (std::size_t at = said.find(folder); at != std::string::npos; at = said.find(folder))
      said.erase(at, folder.size());
    return said;
  }
  return "no error";
}

TEST(MeasurementTable, RowsAreReadInTheUnitsUsedInside) {
  const MeasurementTable table = table_of(kTable);
  EXPECT_EQ(table.specimen, "k1");
  ASSERT_EQ(table.rows.size(), 7u);
  const Measurement& drawer = table.rows[0];
  EXPECT_EQ(drawer.line, 2);
  EXPECT_EQ(drawer.test, "ap30");
  EXPECT_DOUBLE_EQ(drawer.flexion, 30 * kDegree);
  EXPECT_EQ(drawer.load, 0);
  EXPECT_EQ(drawer.level, 88);
  EXPECT_EQ(drawer.index, 4u);
  EXPECT_EQ(drawer.value, 4.9);
  EXPECT_EQ(drawer.sd, 0.5);
  EXPECT_EQ(drawer.use, MeasuredUse::kFit);
  EXPECT_DOUBLE_EQ(table.rows[1].value, -2.1 * kDegree);
  EXPECT_EQ(table.rows[3].level, 3000);  // N m
  EXPECT_EQ(table.rows[3].use, MeasuredUse::kTest);
  EXPECT_EQ(table.rows[4].kind, MeasuredKind::kReaction);
  EXPECT_EQ(table.rows[4].index, 1u);  // the held condition
  EXPECT_EQ(table.rows[4].level, 4);   // mm
  EXPECT_EQ(table.rows[5].kind, MeasuredKind::kLigamentForce);
  EXPECT_EQ(table.rows[6].load, -1);
}

TEST(MeasurementTable, ColumnsMayStandInAnyOrderAndTwoMayBeAbsent) {
  const MeasurementTable table =
      table_of("sd,value,coordinate,level,load,flexion,test\n0.5,1,medial.force,5,anterior,10,a\n");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.specimen, "");
  EXPECT_EQ(table.rows[0].kind, MeasuredKind::kContactForce);
  EXPECT_EQ(table.rows[0].use, MeasuredUse::kFit);
}

// What spreadsheets write: a byte order mark, CRLF, quotes, blanks, comments.
TEST(MeasurementTable, HowATextIsWrittenDoesNotMatter) {
  const std::string text =
      "\xEF\xBB\xBF# made by hand\r\n\r\ntest, flexion ,load,level,coordinate,value,sd\r\n"
      "\"a \"\"b\"\", c\" , +30,\tanterior,8.8e1,\"adduction\" ,1,.5\r\n   \r\n  # end\r\n";
  const MeasurementTable table = table_of(text);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].test, "a \"b\", c");
  EXPECT_EQ(table.rows[0].line, 4);
  EXPECT_EQ(table.rows[0].sd, 0.5 * kDegree);
}

// Tables that `import` makes say their units in a comment.
TEST(MeasurementTable, OtherUnitsThanTheScenesAreRefused) {
  const std::string said = "# units: mm, deg, N, N m; offsets: none added\n" + kTable;
  EXPECT_EQ(table_of(said).rows.size(), 7u);
  Scene scene = scene_beside(table_folder(), said);
  scene.length_to_mm = 10;
  EXPECT_EQ(told_of(scene),
            "knee.csv:1: its numbers are in mm, expected cm as [units] of knee.toml");
  scene.length_to_mm = scene.angle_to_rad = 1;
  EXPECT_EQ(told_of(scene),
            "knee.csv:1: its numbers are in deg, expected rad as [units] of knee.toml");
  EXPECT_EQ(table_of("# units: furlongs, N m,\n" + kTable).rows.size(), 7u);
}

// The scene of the tests reads moments in N m. Where no row has one, its unit is none of a table's business.
TEST(MeasurementTable, UnitsOfMomentsAreLookedAtWhereThereAreMoments) {
  const std::string said = "# units: mm, deg, N mm\n";
  EXPECT_EQ(told_of(scene_beside(table_folder(), said + kTable)),
            "knee.csv:1: its numbers are in N mm, expected N m as [calibrate] moment of knee.toml");
  const std::string forces =
      kTable.substr(0, kTable.find("k1,ie30")) + kTable.substr(kTable.find("k1,robot"));
  EXPECT_EQ(table_of(said + forces).rows.size(), 6u);
}

TEST(MeasurementTable, OnlyTheSpecimenThatIsMeantIsRead) {
  Scene scene = scene_beside(table_folder(), kTable + "k2,x,0,lateral,1,other knee,1,1,fit\n");
  EXPECT_EQ(told_of(scene),
            "knee.csv: rows of \"k1\" or \"k2\", expected [calibrate] specimen to say which");
  scene.calibration->specimen = "k1";
  EXPECT_EQ(read_measurements(scene).rows.size(), 7u);
  scene.calibration->specimen = "k11";
  EXPECT_EQ(told_of(scene),
            "knee.csv: no row of specimen \"k11\", expected \"k1\" or \"k2\"; did you mean "
            "\"k1\"?");
}

// A condition that no test sets holds its coordinate in all of them.
TEST(MeasurementTable, WhatTheSceneHoldsIsMeasuredInNoTest) {
  const std::filesystem::path folder = table_folder();
  std::ofstream(folder / "knee.csv") << kTable;
  const Scene scene = parse_scene(
      kCalibratedScene +
          "\n[[condition]]\nname = \"no twist\"\nkind = \"internal_rotation\"\nvalue = 0\n",
      folder / "knee.toml");
  EXPECT_EQ(
      told_of(scene),
      "knee.csv:3: coordinate = internal_rotation, expected another coordinate: condition "
      "\"no twist\", which is of no [[calibrate.load]], holds it in every test (or use = skip)");
}

TEST(MeasurementTable, SkippedRowsMaySayAnything) {
  EXPECT_EQ(table_of(kTable + "k1,ap30,30,anterior,88,anterior_drawer,n/a,,skip\n").rows.size(),
            7u);
}

TEST(MeasurementTable, RelativeCurvesAreToldFromTheirUnloadedRowWhichIsThenLeftOut) {
  const std::string rows =
      "test,flexion,load,level,coordinate,value,sd\n"
      "a,30,none,0,anterior_drawer,2,0.5\na,30,anterior,88,anterior_drawer,7,0.5\n"
      "a,30,anterior,-88,anterior_drawer,-1,0.5\na,30,anterior,88,distraction,3,0.5\n"
      "a,60,anterior,88,anterior_drawer,4,0.5\nb,30,none,0,anterior_drawer,1,0.5\n";
  Scene scene = scene_beside(table_folder(), rows);
  scene.calibration->relative = {"a"};
  const MeasurementTable table = read_measurements(scene);
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[0].value, 5);
  EXPECT_EQ(table.rows[1].value, -3);
  EXPECT_EQ(table.rows[2].value, 3);  // another coordinate, without an unloaded row
  EXPECT_EQ(table.rows[3].value, 4);  // another flexion
  EXPECT_EQ(table.rows[4].value, 1);  // another curve
  // Both readings have errors.
  EXPECT_DOUBLE_EQ(table.rows[0].sd, std::hypot(0.5, 0.5));
  EXPECT_EQ(table.rows[2].sd, 0.5);
  EXPECT_FALSE(table.rows[2].zero_flexion.has_value());
}

// A row that is held out may not reach what is fitted through the zero of its curve.
TEST(MeasurementTable, WhatIsFittedIsToldFromUnloadedRowsThatAreFitted) {
  const auto drawer_of = [](const std::string& use_of_zero, const std::string& use_of_row) {
    Scene scene =
        scene_beside(table_folder(),
                     "test,flexion,load,level,coordinate,value,sd,use\n"
                     "a,30,none,0,anterior_drawer,2,0.3," +
                         use_of_zero + "\n" + "a,30,anterior,88,anterior_drawer,7,0.4," +
                         use_of_row + "\n" + "b,30,anterior,88,anterior_drawer,7,0.4,fit\n");
    scene.calibration->relative = {"a"};
    const MeasurementTable table = read_measurements(scene);
    EXPECT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.warnings.size(), use_of_zero == "test" && use_of_row == "fit" ? 1u : 0u);
    return table.rows.at(0).value;
  };
  EXPECT_EQ(drawer_of("fit", "fit"), 5);
  EXPECT_EQ(drawer_of("test", "fit"), 7);
  EXPECT_EQ(drawer_of("fit", "test"), 5);
  EXPECT_EQ(drawer_of("test", "test"), 5);
}

// A robot does not hold a flexion to the last digit: what is taken off stands at the nearest one.
TEST(MeasurementTable, TheUnloadedRowOfARelativeCurveMayStandBesideItsFlexion) {
  Scene scene = scene_beside(table_folder(),
                             "test,flexion,load,level,coordinate,value,sd\n"
                             "a,30.5,none,0,anterior_drawer,2,0.3\n"
                             "a,29,none,0,anterior_drawer,1,0.3\n"
                             "a,30,anterior,88,anterior_drawer,7,0.4\n"
                             "a,33,anterior,88,anterior_drawer,8,0.4\n");
  scene.calibration->relative = {"a"};
  const MeasurementTable table = read_measurements(scene);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].value, 5);
  EXPECT_DOUBLE_EQ(table.rows[0].sd, 0.5);
  EXPECT_DOUBLE_EQ(table.rows[0].zero_flexion.value(), 30.5 * kDegree);
  EXPECT_EQ(table.rows[1].value, 8);  // more than two degrees away
  ASSERT_EQ(table.warnings.size(), 1u);
  EXPECT_NE(table.warnings[0].find("knee.csv:5: a, 33 deg, "), std::string::npos)
      << table.warnings[0];
  EXPECT_NE(table.warnings[0].find("has no unloaded row within 2 degrees"), std::string::npos);
}

TEST(MeasurementTable, OfTwoUnloadedRowsAsNearTheOrderInTheFileHasNoSay) {
  for (const double flexion : {30.0, 45.0, 60.0}) {
    std::string rows[2] = {fmt::format("a,{},none,0,anterior_drawer,2,0.3\n", flexion - 1.5),
                           fmt::format("a,{},none,0,anterior_drawer,1,0.3\n", flexion + 1.5)};
    for (int order = 0; order < 2; ++order) {
      Scene scene = scene_beside(
          table_folder(), "test,flexion,load,level,coordinate,value,sd\n" + rows[0] + rows[1] +
                              fmt::format("a,{},anterior,88,anterior_drawer,7,0.4\n", flexion));
      scene.calibration->relative = {"a"};
      EXPECT_EQ(read_measurements(scene).rows.at(0).value, 5) << flexion << ", " << order;
      std::swap(rows[0], rows[1]);
    }
  }
}

TEST(MeasurementTable, ALaxityIsOfACoordinate) {
  const MeasurementTable table = table_of(
      "test,flexion,load,level,coordinate,value,sd\na,30,anterior,88,anterior_drawer.laxity,7,0.5\n"
      "a,30,anterior,88,anterior_drawer,4,0.5\n");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_TRUE(table.rows[0].laxity);
  EXPECT_EQ(table.rows[0].index, 4u);
  EXPECT_FALSE(table.rows[1].laxity);
}

TEST(MeasurementTable, ACurveThatIsToldFromItsUnloadedPoseIsOfTheTable) {
  Scene scene = scene_beside(table_folder(), kTable);
  scene.calibration->relative = {"ap3"};
  EXPECT_EQ(told_of(scene),
            "knee.toml: [calibrate] relative = \"ap3\" names no curve of knee.csv, expected "
            "\"ap30\", \"ie30\", \"robot\" or \"passive\"; did you mean \"ap30\"?");
}

TEST(MeasurementTable, RowsAreCalledByTheirUnits) {
  const std::filesystem::path folder = table_folder();
  const Scene scene = scene_beside(folder, kTable);
  const MeasurementTable table = read_measurements(scene);
  const std::string file = (folder / "knee.csv").string();
  EXPECT_EQ(name_of(table.rows[0], table, scene), file + ":2: ap30, 30 deg, anterior 88");
  EXPECT_EQ(name_of(table.rows[3], table, scene), file + ":5: ie30, 30 deg, internal 3");
  EXPECT_EQ(name_of(table.rows[6], table, scene), file + ":8: passive, 45 deg");
  EXPECT_EQ(quantity_of(table.rows[1], scene), "internal rotation");
  EXPECT_EQ(quantity_of(table.rows[4], scene), "reaction");
  EXPECT_EQ(quantity_of(table.rows[5], scene), "force of aACL");
  EXPECT_EQ(unit_of(table.rows[1], scene).name, "deg");
  EXPECT_DOUBLE_EQ(unit_of(table.rows[1], scene).factor, kDegree);
  EXPECT_EQ(unit_of(table.rows[4], scene).name, "N");
}

TEST(MeasurementTable, WhatIsNoTableIsRefused) {
  const std::filesystem::path folder = table_folder();
  Scene scene = scene_beside(folder, "");
  const std::string expected = ", expected a table of measurements (CSV)";
  EXPECT_EQ(told_of(scene), "knee.csv: holds no line" + expected);
  std::ofstream(folder / "knee.csv") << std::string("t\0e", 3);
  EXPECT_EQ(told_of(scene), "knee.csv: is no text in UTF-8" + expected);
  scene.calibration->measurements = folder / "no.csv";
  EXPECT_EQ(told_of(scene), "no.csv: no such file" + expected);
  std::filesystem::create_directory(folder / "folder");
  scene.calibration->measurements = folder / "folder";
  EXPECT_EQ(told_of(scene), "folder: is a folder" + expected);
  scene.calibration->measurements = "/dev/null";
  EXPECT_EQ(told_of(scene), "/dev/null: is no plain file" + expected);
  scene.calibration.reset();
  EXPECT_EQ(told_of(scene),
            "knee.toml: no table [calibrate], expected one that names measurements");
}

struct BadTable {
  std::string name, text, message;
  friend std::ostream& operator<<(std::ostream& stream, const BadTable& bad) {
    return stream << bad.name;
  }
};

class BadMeasurements : public testing::TestWithParam<BadTable> {};

TEST_P(BadMeasurements, AreNamedWithTheirLine) {
  EXPECT_EQ(told_of(scene_beside(table_folder(), GetParam().text)),
            "knee.csv:" + GetParam().message);
}

std::string with_row(const std::string& row) { return kTable + row + "\n"; }
std::string with_header(const std::string& header) {
  return header + kTable.substr(kTable.find('\n'));
}

const BadTable kBadTables[] = {
    {"TooFewFields", with_row("k1,ap30,30,anterior,88"),
     "9: 5 fields, expected 9 as in the header on line 1"},
    {"OpenQuote", with_row("k1,\"ap30,30"),
     "9: a quote in column 2 is not closed, expected \"...\""},
    {"Semicolons", "test;flexion;load\n",
     "1: columns parted by semicolons or tabs, expected commas "
     "(and points in numbers)"},
    {"UnknownColumn", with_header("specimen,test,flexion,load,level,coordinate,value,std,use"),
     "1: unknown column \"std\", expected one of \"specimen\", \"test\", \"flexion\", \"load\", "
     "\"level\", \"coordinate\", \"value\", \"sd\" or \"use\"; did you mean \"sd\"?"},
    {"ColumnTwice", with_header("specimen,test,flexion,load,level,coordinate,value,sd,sd"),
     "1: column \"sd\" stands twice, expected once"},
    {"NoColumn", "test,flexion,load,level,coordinate,value\n",
     "1: no column \"sd\", expected \"specimen\", \"test\", \"flexion\", \"load\", \"level\", "
     "\"coordinate\", \"value\", \"sd\" or \"use\" (specimen and use may be absent)"},
    {"UnknownLoad", with_row("k1,ap30,30,anteror,88,adduction,1,1,fit"),
     "9: load = anteror, expected a [[calibrate.load]]: \"none\", \"anterior\", \"internal\" or "
     "\"robot\"; did you mean \"anterior\"?"},
    {"UnknownCoordinate", with_row("k1,ap30,30,anterior,88,aduction,1,1,fit"),
     "9: coordinate = aduction, expected a joint coordinate, one with .laxity, reaction, "
     "LIGAMENT.force or "
     "CONTACT.force; did you mean \"adduction\"?"},
    {"UnknownLigament", with_row("k1,ap30,30,anterior,88,pALC.force,1,1,fit"),
     "9: coordinate = pALC.force, expected a joint coordinate, one with .laxity, reaction, "
     "LIGAMENT.force or "
     "CONTACT.force; did you mean \"pACL.force\"?"},
    {"NoDeviation", with_row("k1,ap30,30,anterior,88,adduction,1,0,fit"),
     "9: sd = 0, expected a standard deviation > 0"},
    {"NegativeDeviation", with_row("k1,ap30,30,anterior,88,adduction,1,-1,fit"),
     "9: sd = -1, expected a standard deviation > 0"},
    {"DeviationOfNothing", with_row("k1,ap30,30,anterior,88,adduction,1,1e-300,fit"),
     "9: sd = 1e-300, expected a standard deviation of at least 5.73e-08 deg, as exact as poses "
     "are"},
    {"EmptyDeviation", with_row("k1,ap30,30,anterior,88,adduction,1,,fit"),
     "9: sd is empty, expected a standard deviation > 0, a finite number"},
    {"NoNumber", with_row("k1,ap30,30,anterior,88,adduction,nan,1,fit"),
     "9: value = nan, expected what was measured, a finite number"},
    {"Infinite", with_row("k1,ap30,30,anterior,inf,adduction,1,1,fit"),
     "9: level = inf, expected the level of anterior, a finite number"},
    {"NumberWithUnit", with_row("k1,ap30,30 deg,anterior,8,adduction,1,1,fit"),
     "9: flexion = 30 deg, expected an angle, a finite number"},
    {"Twice", with_row("k1,ap30,30.0,anterior,88,anterior_drawer,5,1,test"),
     "9: coordinate = anterior_drawer, expected a row that stands once: line 2 measures the same"},
    {"LevelWithoutLoad", with_row("k1,p,45,none,3,adduction,1,1,fit"),
     "9: level = 3, expected 0, as there is no load (load = none)"},
    {"LoadWithoutLevel", with_row("k1,p,45,internal,,adduction,1,1,fit"),
     "9: level is empty, expected the level of internal, a finite number"},
    {"NoLoad", with_row("k1,p,45,,0,adduction,1,1,fit"),
     "9: load is empty, expected a [[calibrate.load]]: \"none\", \"anterior\", \"internal\" or "
     "\"robot\""},
    {"NoCurve", with_row("k1,,45,none,0,adduction,1,1,fit"),
     "9: test is empty, expected the name of a curve"},
    {"MomentInWrongUnit", with_row("k1,ie,30,internal,3000,adduction,1,1,fit"),
     "9: level = 3000, expected the level of internal in N m, at most 1000 of a knee (suspect the "
     "units)"},
    {"AngleInWrongUnit", with_row("k1,ie,30,internal,3,adduction,250,1,fit"),
     "9: value = 250, expected what was measured in deg, at most 180 of a knee (suspect the "
     "units)"},
    {"LengthInWrongUnit", with_row("k1,ie,30,internal,3,distraction,5000,1,fit"),
     "9: value = 5000, expected what was measured in mm, at most 200 of a knee (suspect the "
     "units)"},
    {"FlexionIsPrescribed", with_row("k1,ap30,30,anterior,88,flexion,30,1,fit"),
     "9: coordinate = flexion, expected another coordinate: flexion is prescribed in every test"},
    {"HeldIsPrescribed", with_row("k1,robot,0,robot,4,anterior_drawer,4,1,fit"),
     "9: coordinate = anterior_drawer, expected another coordinate, or reaction: load robot "
     "prescribes it"},
    {"ReactionOfAForce", with_row("k1,ap30,30,anterior,88,reaction,4,1,fit"),
     "9: coordinate = reaction, expected a coordinate: a reaction is of loads that are conditions, "
     "which hold one"},
    {"UnknownUse", with_row("k1,ap30,30,anterior,88,adduction,1,1,fitt"),
     "9: use = fitt, expected \"fit\", \"test\" or \"skip\"; did you mean \"fit\"?"},
    {"LaxityWithoutLevel", with_row("k1,ap30,30,none,0,adduction.laxity,1,1,fit"),
     "9: level = 0, expected a level > 0: a laxity is told at it and at the opposite one"},
    {"LaxityAtTheOppositeLevel", with_row("k1,ap30,30,anterior,-88,adduction.laxity,1,1,fit"),
     "9: level = -88, expected a level > 0: a laxity is told at it and at the opposite one"},
    {"UnloadedTwice",
     with_row("k1,ap30,30,none,0,adduction,1,1,fit\nk1,ap30,30,anterior,0,adduction,1,1,fit"),
     "10: coordinate = adduction, expected a row that stands once: line 9 measures the same"},
    {"NothingToFit",
     "test,flexion,load,level,coordinate,value,sd,use\nap30,30,none,0,adduction,0,1,test\n",
     " no row to fit, expected one with use = fit"},
};

INSTANTIATE_TEST_SUITE_P(Each, BadMeasurements, testing::ValuesIn(kBadTables), [](const auto& it) {
  return it.param.name;
});

}  // namespace
}  // namespace condyle::test
