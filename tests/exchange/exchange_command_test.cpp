/// condyle export and import as a user runs them, and what other programs read of it.

#include "app/run_program.h"
#include "calibration/small_calibration.h"
#include "condyle/exchange/ply_file.h"
#include "condyle/mesh_files/load_mesh.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

using test::CommandLine;
using test::contents;
using test::expect_bad_input;
using test::Outcome;

const std::string kPhantom = CONDYLE_SOURCE_DIR "/data/phantom/knee.toml";
const std::string kHere = CONDYLE_SOURCE_DIR "/tests/exchange";

class Exchange : public CommandLine {
 protected:
  void sweep_phantom() {
    const Outcome sweep = run("sweep '" + kPhantom + "' -o run.h5 --step 60");
    ASSERT_EQ(sweep.code, 0) << sweep.err;
  }
  /// A program that is no part of condyle; its exit code and what it says.
  [[nodiscard]] Outcome shell(const std::string& command) const {
    const int status = std::system(
        ("cd '" + folder_.string() + "' && " + command + " > stdout.txt 2> stderr.txt").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder_ / "stdout.txt"),
            contents(folder_ / "stderr.txt")};
  }
};

TEST_F(Exchange, WritesTheFormatThatTheEndingNames) {
  write_run(folder_ / "run.h5", made_up_run());
  for (const char* file : {"a.glb", "a.mot", "a.sto", "a.csv"}) {
    const Outcome outcome = run(std::string("export run.h5 -o ") + file);
    EXPECT_EQ(outcome.code, 2) << outcome.err;  // one pose failed, and is named
    EXPECT_EQ(outcome.err.rfind("condyle: left out ", 0), 0U) << outcome.err;
    EXPECT_EQ(outcome.out, std::string("wrote ") + file + "\n");
    EXPECT_GT(fs::file_size(folder_ / file), 100U);
  }
}

TEST_F(Exchange, TakesNoOtherPoseForOneThatFailed) {
  write_run(folder_ / "run.h5", made_up_run());  // at 0, 0.1 and 0.2 rad; the second failed
  const Outcome outcome = run("export run.h5 -o a.csv --at 0,5.7");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "condyle: left out 5.72958 deg: singular\n");
  EXPECT_EQ(contents(folder_ / "a.csv").find("\n2,"), std::string::npos);
  expect_bad_input(run("export run.h5 -o b.csv --at 5.7"),
                   "run.h5: no pose at the values of --at has converged");
  EXPECT_FALSE(fs::exists(folder_ / "b.csv"));
}

// The run holds the paths of what it was computed from.
TEST_F(Exchange, DoesNotWriteOverWhatItsRunWasComputedFrom) {
  const std::string bone = "bone.stl", mesh = CONDYLE_SOURCE_DIR "/meshes/tibia.stl";
  fs::copy_file(mesh, folder_ / bone);
  write("knee.toml",
        with(test::kScene, "name = \"tibia\"\n", "name = \"tibia\"\nmesh = \"bone.stl\"\n"));
  ASSERT_EQ(run("sweep knee.toml -o run.h5 --quiet").code, 0);
  const std::string expected = ": the run was computed from it, expected another file to write";
  expect_bad_input(run("export run.h5 -o bone.stl --at 0"), "bone.stl" + expected);
  fs::create_directory_symlink(folder_, folder_ / "here");
  expect_bad_input(run("export run.h5 -o here/bone.stl --at 0"), "here/bone.stl" + expected);
  EXPECT_EQ(contents(folder_ / bone), contents(mesh));
  // Of a run that was computed in another folder the paths lead nowhere.
  fs::create_directory(folder_ / "other");
  ASSERT_EQ(run("sweep ../knee.toml -o ../run.h5 --quiet", "cd other; ").code, 0);
  expect_bad_input(run("export run.h5 -o bone.stl --at 0"), "bone.stl" + expected);
  fs::copy_file(folder_ / "knee.toml", folder_ / "knee");
  expect_bad_input(run("report run.h5 -o knee"), "knee" + expected);
  EXPECT_EQ(contents(folder_ / bone), contents(mesh));
  write("knee.toml", with(contents(folder_ / "knee.toml"), "bone.stl", "out/run.stl"));
  fs::create_directory(folder_ / "out");
  fs::copy_file(mesh, folder_ / "out" / "run.stl");
  ASSERT_EQ(run("sweep knee.toml -o run.h5 --quiet").code, 0);
  EXPECT_EQ(run("export run.h5 -o out --format csv").code, 0);
  expect_bad_input(run("export run.h5 -o out/run.stl --at 20"), "out/run.stl" + expected);
  EXPECT_EQ(contents(folder_ / "out" / "run.stl"), contents(mesh));
}

// The run names the measurements that its scene names, by a path that starts elsewhere, and holds no checksum of them.
TEST_F(Exchange, DoesNotWriteOverMeasurements) {
  write("knee.toml", with(test::kCalibratedScene, "to = 120", "to = 20"));
  write("knee.csv", test::kTable);
  fs::create_directory(folder_ / "other");
  ASSERT_GE(run("sweep ../knee.toml -o ../run.h5 --quiet", "cd other; ").code, 0);
  expect_bad_input(
      run("export run.h5 -o knee.csv"),
      "knee.csv: begins otherwise than a table of a run (\"pose,swept,swept_unit,\"), it may "
      "hold measurements, expected another file to write");
  EXPECT_EQ(contents(folder_ / "knee.csv"), test::kTable);
  EXPECT_EQ(run("export run.h5 -o poses.csv").out, "wrote poses.csv\n");
  EXPECT_EQ(run("export run.h5 -o poses.csv").out, "wrote poses.csv\n") << "once more";
  write("empty.csv", "");
  EXPECT_EQ(run("export run.h5 -o empty.csv").out, "wrote empty.csv\n")
      << "nothing is lost with it";
}

TEST_F(Exchange, NamesWhatItCannotWrite) {
  write_run(folder_ / "run.h5", made_up_run());
  expect_bad_input(run("export run.h5 -o a.fbx"),
                   "a.fbx: unknown format, expected a name that ends in .glb, .mot, .sto, .csv, "
                   ".stl, or a folder");
  expect_bad_input(run("export run.h5 -o out --format gltf"),
                   "--format gltf: expected glb, vtk, opensim, csv, stl");
  expect_bad_input(run("export run.h5 -o a.csv --format csv,stl"),
                   "--format csv,stl: a.csv is a single file, expected a folder");
  expect_bad_input(run("export run.h5 -o a.pvd"),
                   "a.pvd: a series of many files, expected a folder, with --format vtk");
  expect_bad_input(run("export no.h5 -o a.glb"), "no.h5: no such file, expected a run (HDF5)");
  expect_bad_input(run("export run.h5 -o no/a.glb"),
                   "no/a.glb: there is no folder no, expected one that exists");
  expect_bad_input(run("export run.h5 -o no/such"),
                   "no/such: there is no folder no, expected one that exists");
  condyle::Run failed = made_up_run();
  failed.sweep.poses = {failed.sweep.poses[1]};
  write_run(folder_ / "run.h5", failed);
  expect_bad_input(run("export run.h5 -o a.glb"),
                   "run.h5: holds no pose that converged, expected the result of condyle sweep or "
                   "simulate");
  EXPECT_EQ(results(), std::vector<std::string>{"run.h5"});
}

TEST_F(Exchange, NamesWhatItCannotImport) {
  expect_bad_input(run("import no.osim -o scene.toml"),
                   "no.osim: no such file, expected an OpenSim model (.osim)");
  expect_bad_input(run("import '" CONDYLE_SOURCE_DIR "/tests/data/phantom_jam.osim' -o a.toml "
                       "--side both"),
                   "--side both: expected right or left");
  EXPECT_TRUE(results().empty());
}

// A scene takes the place of nothing that its model needs, and of no file of another kind.
TEST_F(Exchange, ImportsOverNoMeshOfTheModel) {
  fs::copy(CONDYLE_SOURCE_DIR "/meshes", folder_ / "meshes");
  fs::copy(folder_ / "meshes", folder_ / "model");
  fs::copy(CONDYLE_SOURCE_DIR "/tests/data/phantom_jam.osim", folder_ / "model" / "knee.osim");
  const auto size = fs::file_size(folder_ / "meshes" / "femur.stl");
  for (const char* name : {"meshes/femur.stl", "model/femur.stl", "scene.h5", "scene.csv"})
    EXPECT_EQ(run("import model/knee.osim -o " + std::string(name)).code, 1) << name;
  EXPECT_EQ(fs::file_size(folder_ / "meshes" / "femur.stl"), size);
  EXPECT_EQ(fs::file_size(folder_ / "model" / "femur.stl"), size);
  EXPECT_FALSE(fs::exists(folder_ / "scene.h5") || fs::exists(folder_ / "scene.csv"));

  // A mesh that the model moves would be written as scene_NAME.ply: here the bone has that name.
  const std::string taken = "scene_femur_cartilage.ply";
  std::ofstream(folder_ / "model" / taken)
      << ply(load_mesh(CONDYLE_SOURCE_DIR "/meshes/femur.stl", 1));
  const std::string before = test::contents(folder_ / "model" / taken);
  std::string model = test::contents(folder_ / "model" / "knee.osim");
  const std::string scale = "<scale_factors>0.001 0.001 0.001</scale_factors>",
                    mesh = "<mesh_file>";
  model = with(model, scale + mesh + "../../meshes/femur.stl", scale + mesh + taken);
  const std::string place =
      "\"femur_cartilage\">\n<socket_frame>/bodyset/femur_distal_r</socket_frame>\n<location>0 0";
  model = with(model, place + " 0", place + ".002 0");
  for (std::size_t at; (at = model.find("../../meshes")) != std::string::npos;)
    model.replace(at, 12, CONDYLE_SOURCE_DIR "/meshes");
  write("model/moved.osim", model);
  const Outcome over = run("import model/moved.osim -o model/scene.toml");
  EXPECT_EQ(over.code, 1);
  EXPECT_NE(over.err.find(taken + ": is read by this command"), std::string::npos) << over.err;
  EXPECT_EQ(test::contents(folder_ / "model" / taken), before);
  EXPECT_FALSE(fs::exists(folder_ / "model" / "scene.toml"));
  EXPECT_EQ(run("import model/moved.osim -o model/other.toml").code, 0);
}

// The commands of docs/exchange.md.
TEST_F(Exchange, ImportsAModelThatChecksAndSweeps) {
  fs::create_directories(folder_ / "a" / "b");
  fs::copy(CONDYLE_SOURCE_DIR "/meshes", folder_ / "meshes");
  fs::copy(CONDYLE_SOURCE_DIR "/tests/data/phantom_jam.osim", folder_ / "a" / "b" / "knee.osim");
  const Outcome import = run("import a/b/knee.osim -o scene.toml");
  EXPECT_EQ(import.code, 0) << import.err;
  EXPECT_NE(import.out.find("joint knee_r, femur femur_distal_r, tibia tibia_proximal_r, 13 "
                            "ligaments"),
            std::string::npos)
      << import.out;
  EXPECT_NE(import.out.find("  other bodies: pelvis, patella_r\n"), std::string::npos);
  const Outcome check = run("check scene.toml");
  EXPECT_EQ(check.code, 0) << check.err;
  const Outcome sweep = run("sweep scene.toml -o run.h5 --to 10");
  EXPECT_EQ(sweep.code, 0) << sweep.err;
}

TEST_F(Exchange, WritesGltfThatKhronosFindsValid) {
  sweep_phantom();
  ASSERT_EQ(run("export run.h5 -o run.glb").code, 0);
  const Outcome outcome = shell(
      "'" + kHere + "/gltf_validator/validate.sh' '" CONDYLE_BINARY_DIR "/gltf_validator' run.glb");
  if (outcome.code == 77) GTEST_SKIP() << "node or npm is missing, or npm reaches no packages";
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(Exchange, WritesFilesThatVtkReads) {
  sweep_phantom();
  ASSERT_EQ(run("export run.h5 -o run.stl --at 50").code, 0);
  ASSERT_EQ(run("export run.h5 -o out --format vtk,csv --at 0,60,120").code, 0);
  const Outcome outcome = shell("/usr/bin/python3 '" + kHere + "/read_vtk.py' out run");
  if (outcome.code == 77 || outcome.code == 127) GTEST_SKIP() << "python3-vtk9 is missing";
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(Exchange, IsReadByTheLinesOfTheDocs) {
  sweep_phantom();
  const Outcome outcome = shell("/usr/bin/python3 '" + kHere + "/read_run.py' run.h5 '" +
                                CONDYLE_SOURCE_DIR "/docs/exchange.md'");
  if (outcome.code == 77 || outcome.code == 127) GTEST_SKIP() << "python3-h5py is missing";
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("[  0.  60. 120.] (11000, 3) ", 0), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find("MATLAB /sweep/contacts/medial/force (3,)"), std::string::npos);
}

}  // namespace
}  // namespace condyle
