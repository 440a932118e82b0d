#include "condyle/results/study_file.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "condyle/input_error.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/run_file.h"
#include "condyle/results/study_columns.h"
#include "condyle/results/study_tables.h"
#include "condyle/results/study_words.h"
#include "results/made_up_study.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

class StudyFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  StudySummary write(const StudyPlan& plan, const std::vector<std::uint64_t>& order) const {
    StudyJournals journals(result_, plan, {}, false);
    for (const std::uint64_t c : order)
      journals.append(static_cast<int>(c % 2), made_up_chunk(plan, c));
    const SweepResult nominal = made_up_nominal(plan);
    StudySummary summary = write_study(
        result_, plan, journals, std::vector<const SweepResult*>(plan.knees.size(), &nominal));
    journals.remove();
    return summary;
  }
  /// Without the time at which it was written.
  [[nodiscard]] std::string bytes_but_time() const {
    std::ifstream stream(result_, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    const std::string created = read_study_file(result_).created;
    const std::size_t at = bytes.find(created);
    EXPECT_NE(at, std::string::npos);
    return bytes.replace(at, created.size(), "");
  }

  fs::path folder_ = test::scratch_folder("study_file");
  fs::path result_ = folder_ / "study.h5";
};

TEST_F(StudyFile, HoldsTheSamplesInTheirOrder) {
  const StudyPlan plan = made_up_study();
  (void)write(plan, {2, 0, 1});
  const Hdf5Reader reader(result_);
  const Hdf5Group root = reader.root();
  const std::vector<double> force = root.open("outputs").read("aACL.force", {150, 3});
  const std::vector<int> status = root.open("outputs").read_integers("status", {150, 3});
  const std::vector<double> theta = root.open("samples").read("theta", {150, 2});
  std::vector<double> expected;
  for (std::uint64_t k = 0; k < 150; ++k) {
    const StudyChunk chunk = made_up_chunk(plan, k / kChunkSamples);
    plan.theta(k, expected);
    EXPECT_EQ(theta[2 * k], expected[0]);
    EXPECT_EQ(theta[2 * k + 1], expected[1]);
    for (std::size_t p = 0; p < 3; ++p) {
      const std::size_t at = (k % kChunkSamples) * 3 + p;
      EXPECT_EQ(status[3 * k + p], chunk.status[at]);
      if (chunk.status[at] == 0) {
        EXPECT_EQ(force[3 * k + p], chunk.values[2 * at + 1]);
      } else {
        EXPECT_TRUE(std::isnan(force[3 * k + p]));
      }
    }
  }
  EXPECT_EQ(root.open("outputs").read_attribute("aACL.force", "units"), "N");
}

TEST_F(StudyFile, IsReadBackAsItWasReduced) {
  const StudyPlan plan = made_up_study();
  const StudySummary summary = write(plan, {0, 1, 2});
  ASSERT_TRUE(is_study_file(result_));
  const StudyView view = read_study_file(result_);
  EXPECT_EQ(view.title, "made up");
  EXPECT_EQ(view.design, "monte-carlo");
  EXPECT_EQ(view.seed, 7U);
  EXPECT_EQ(view.samples, 150);
  EXPECT_EQ(view.swept.name, "bend");
  ASSERT_EQ(view.parameters.size(), 2U);
  EXPECT_EQ(view.parameters[0].spread, "normal, sd 0.02");
  EXPECT_EQ(view.parameters[1].spread, "log-uniform, 0.818731 to 1.2214");
  EXPECT_NEAR(view.parameters[0].typical, 0.02, 0.005);  // 150 draws
  ASSERT_EQ(view.outputs.size(), 2U);
  EXPECT_EQ(view.outputs[1].name, "aACL.force");
  for (std::size_t o = 0; o < 2; ++o) {
    EXPECT_EQ(view.all.bands[o].mean, summary.bands[o].mean);
    EXPECT_EQ(view.all.bands[o].quantiles, summary.bands[o].quantiles);
    EXPECT_EQ(view.all.bands[o].samples, summary.bands[o].samples);
    EXPECT_EQ(view.all.effects[o].rank, summary.effects[o].rank);
  }
  EXPECT_EQ(view.all.bands[1].nominal, (std::vector<double>{0, 7, 14}));  // made_up_pose
  EXPECT_EQ(view.all.failures.failed, 9);                                 // (k + p) % 50 == 49
  EXPECT_EQ(view.all.failures.by_status[0][5], 3);
  EXPECT_EQ(view.all.failures.by_quartile, summary.failures.by_quartile);
  EXPECT_TRUE(view.by_knee.empty());
}

TEST_F(StudyFile, HasTheSameBytesWhoeverComputedIt) {
  const StudyPlan plan = made_up_study();
  (void)write(plan, {0, 1, 2});
  const std::string first = bytes_but_time();
  (void)write(plan, {2, 1, 0});
  EXPECT_TRUE(bytes_but_time() == first);
}

TEST_F(StudyFile, KeepsHalfTheBytesInSinglePrecision) {
  StudyPlan plan = made_up_study(6400);
  std::vector<std::uint64_t> chunks(100);
  for (std::size_t c = 0; c < chunks.size(); ++c) chunks[c] = c;
  (void)write(plan, chunks);
  const auto full = fs::file_size(result_);
  plan.study.single_precision = true;
  (void)write(plan, chunks);
  EXPECT_EQ(full - fs::file_size(result_), 6400U * 3 * 2 * 4);
  const std::vector<double> force =
      Hdf5Reader(result_).root().open("outputs").read("aACL.force", {6400, 3});
  EXPECT_EQ(force[0], static_cast<double>(static_cast<float>(std::sin(100.0))));
}

TEST_F(StudyFile, TellsOfEachKneeByItself) {
  const StudyPlan plan = made_up_study(40, 2);
  (void)write(plan, {0, 1});
  const StudyView view = read_study_file(result_);
  EXPECT_EQ(view.knees, (std::vector<std::string>{"knee1", "knee2"}));
  EXPECT_EQ(view.samples, 80);
  EXPECT_EQ(view.points, 40);
  ASSERT_EQ(view.by_knee.size(), 2U);
  const auto samples = [&](std::size_t k) { return view.by_knee[k].bands[0].samples[0]; };
  EXPECT_EQ(samples(0) + samples(1), view.all.bands[0].samples[0]);
  EXPECT_EQ(samples(1), 39);  // of 40 the one with k = 49 failed
  const std::vector<int> knee =
      Hdf5Reader(result_).root().open("samples").read_integers("knee", {80});
  EXPECT_EQ(knee[39], 0);
  EXPECT_EQ(knee[40], 1);
}

TEST_F(StudyFile, IsWholeOrNotThere) {
  const StudyPlan plan = made_up_study();
  EXPECT_THROW((void)write(plan, {0, 2}), InputError);
  EXPECT_FALSE(fs::exists(result_));
  (void)write(plan, {0, 1, 2});
  const std::string before = bytes_but_time();
  EXPECT_THROW((void)write(plan, {1}), InputError);
  EXPECT_TRUE(bytes_but_time() == before);
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

TEST_F(StudyFile, WritesOverNothingThatIsNotItsOwn) {
  const fs::path beside = result_.string() + ".part", precious = folder_ / "precious";
  std::ofstream(precious) << "mine";
  fs::create_symlink(precious, beside);
  (void)write(made_up_study(), {0, 1, 2});
  EXPECT_TRUE(fs::is_symlink(beside));
  std::string said;
  std::ifstream(precious) >> said;
  EXPECT_EQ(said, "mine");
  EXPECT_FALSE(fs::is_symlink(result_));
  EXPECT_TRUE(is_study_file(result_));
}

/// A number of a dataset of its root written anew.
void set_number(const fs::path& file, const char* dataset, double number) {
  const Hdf5Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const Hdf5Handle numbers(H5Dopen2(opened.id(), dataset, H5P_DEFAULT), H5Dclose);
  ASSERT_GE(H5Dwrite(numbers.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &number), 0);
}

TEST_F(StudyFile, CountsPosesBeyondAllIntegers) {
  (void)write(made_up_study(), {0, 1, 2});
  set_number(result_, "failures/poses", 2.5e9);
  EXPECT_EQ(read_study_file(result_).all.failures.poses, 2500000000);
  set_number(result_, "failures/poses", 2.5);
  EXPECT_THROW((void)read_study_file(result_), InputError);
}

TEST_F(StudyFile, AsksForRoomBeforeItStarts) {
  StudyPlan plan = made_up_study();
  EXPECT_NO_THROW(expect_room(result_, plan));
  const std::uint64_t whole = study_bytes(plan);
  plan.study.single_precision = true;
  EXPECT_LT(study_bytes(plan), whole);
  plan.points = std::uint64_t{1} << 50;
  try {
    expect_room(result_, plan);
    FAIL() << "no disk is that large";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(" GB, the disk has "), std::string::npos)
        << error.what();
  }
}

TEST_F(StudyFile, RefusesFilesThatAreNoStudy) {
  EXPECT_FALSE(is_study_file(result_));
  EXPECT_THROW((void)read_study_file(result_), InputError);
  std::ofstream(result_) << "no HDF5\n";
  EXPECT_FALSE(is_study_file(result_));
  EXPECT_THROW((void)read_study_file(result_), InputError);
}

TEST_F(StudyFile, TablesHaveARowForEachNumber) {
  const StudyPlan plan = made_up_study();
  (void)write(plan, {0, 1, 2});
  const StudyView view = read_study_file(result_);
  const std::string bands = bands_csv(view), indices = indices_csv(view);
  EXPECT_EQ(std::count(bands.begin(), bands.end(), '\n'), 1 + 2 * 3);
  EXPECT_EQ(std::count(indices.begin(), indices.end(), '\n'), 1 + 2 * 3 * 2);
  EXPECT_EQ(bands.find("knee,output,unit,bend deg,samples,nominal,mean,sd,p5,p25,p50,p75,p95\n"),
            0U);
  EXPECT_NE(bands.find("\nall,aACL.force,N,0,147,0,"), std::string::npos) << bands;
  StudyView other = view;
  other.swept.name = "bend, \"x\"";
  const std::string head = "knee,output,unit,\"bend, \"\"x\"\" deg\",samples";
  EXPECT_EQ(bands_csv(other).find(head), 0U) << bands_csv(other);
  EXPECT_EQ(indices_csv(other).find("knee,output,\"bend, \"\"x\"\" deg\",parameter"), 0U);
  const std::vector<std::string> lines = study_lines(view);
  EXPECT_EQ(lines[1], "450 poses, 9 failed (2 %) in 9 samples: 9 no equilibrium");
}

TEST_F(StudyFile, IsLookedIntoWhileItIsOpenAndOutputsAreReadWhenAsked) {
  (void)write(made_up_study(), {0, 1, 2});
  const auto study = open_study(result_);
  fs::remove(result_);
  const ColumnTree* outputs = study->tree_at("bands").group("outputs");
  ASSERT_NE(outputs, nullptr);
  EXPECT_EQ(outputs->columns.size(), 0);
  EXPECT_EQ(outputs->names.size(), study->view().outputs.size() + 1);  // and the status
  EXPECT_NE(study->tree_at("bands").group("bands")->group("aACL.force"), nullptr);
  (void)study->tree_at("outputs/aACL.force");
  (void)study->tree_at("outputs/none such");
  ASSERT_EQ(outputs->columns.size(), 1);
  const DataColumn& force = *outputs->column("aACL.force");
  EXPECT_EQ(force.shape, (std::vector<std::size_t>{150, 3}));
  EXPECT_EQ(force.units, "N");
  const auto* values = &std::get<std::vector<double>>(force.values);
  (void)study->tree_at("outputs");
  EXPECT_EQ(outputs->columns.size(), outputs->names.size());
  EXPECT_EQ(values, &std::get<std::vector<double>>(outputs->column("aACL.force")->values));
}

TEST_F(StudyFile, IsRefusedWhereItIsDamagedBeforeAnythingOfItIsShown) {
  (void)write(made_up_study(), {0, 1, 2});
  fs::resize_file(result_, fs::file_size(result_) / 2);
  EXPECT_THROW((void)open_study(result_), InputError);
  EXPECT_THROW((void)open_study(folder_ / "missing.h5"), InputError);
}

// HDF5 writes beyond its memory for the heap of this one, crashes on it, or would look for its end for as long as it may.
TEST_F(StudyFile, WhatCannotBeReadIsNotTakenForSomethingElse) {
  const fs::path damaged = fs::path(CONDYLE_SOURCE_DIR) / "tests/fuzz/run/broken_heap.h5";
  const auto is_study = [&] {
    try {
      return is_study_file(damaged);
    } catch (const DamagedFile&) {
      return false;
    }
  };
  EXPECT_FALSE(is_study());
  EXPECT_THROW((void)read_study_file(damaged), InputError);
  EXPECT_THROW((void)read_run(damaged), InputError);
  EXPECT_FALSE(holds_study(damaged, made_up_study()));
  EXPECT_FALSE(is_study_file(folder_ / "missing.h5"));
  EXPECT_FALSE(is_study_file(fs::path(CONDYLE_SOURCE_DIR) / "README.md"));
}

}  // namespace
}  // namespace condyle
