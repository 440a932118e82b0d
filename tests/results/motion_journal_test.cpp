#include "condyle/results/motion_journal.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "scene/small_scene.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

MotionStretch made_up_stretch(double seed) {
  MotionFrame frame;
  frame.state.t = seed / 3;
  frame.state.bodies = {
      {{Eigen::Matrix3d::Identity() * seed, {1, 2, seed}}, {4, 5, 6}, {7, 8, -0.0}}};
  MovingContact contact;
  contact.places.on_B.numbers = {0.1, 0.2, seed};
  contact.places.on_A.numbers.setConstant(std::numeric_limits<double>::quiet_NaN());
  contact.closed = true;
  contact.followed = false;
  frame.state.contacts = {contact};
  frame.contact_force = {9};
  frame.contact_gap = {std::numeric_limits<double>::infinity()};
  frame.contact_point = {{1, 1, 1}};
  frame.lines = {{1, 2, 3, 4, 5}, {}};
  frame.paths = {std::numeric_limits<double>::quiet_NaN(), 1};
  frame.condition_multiplier = {0.7};
  frame.energy = {1, 2, 3, 4, 5, 6};
  frame.dissipated = 1e-300;
  frame.driver_work = -seed;
  MotionStretch stretch;
  stretch.frames = {frame, frame};
  stretch.events = {{0.25, 0, true, 3.5}};
  stretch.steps = 5001;
  stretch.evaluations = 9000;
  stretch.seconds = 0.04;
  return stretch;
}

class MotionJournalFile : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    LineFile file(path_);
    MotionJournal journal(file, kMotionJournal, parts_, 0);
    for (const double seed : {1.0, 2.0}) journal.append(made_up_stretch(seed));
    EXPECT_EQ(journal.failure(), "");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  [[nodiscard]] MotionContents read() const { return read_motion_journal(path_, parts_); }

  fs::path folder_ = test::scratch_folder("motion_journal"), path_ = folder_ / "dyn.h5.journal";
  JournalParts parts_ = {{"scene", 1, "another"}, {"mass", 2, "another"}};
};

TEST_F(MotionJournalFile, GivesBackTheLastBit) {
  const MotionContents journal = read();
  EXPECT_EQ(journal.whole_bytes, fs::file_size(path_));
  ASSERT_EQ(journal.stretches.size(), 2U);
  EXPECT_EQ(journal.frames(), 4U);
  const MotionStretch &back = journal.stretches[1], there = made_up_stretch(2);
  EXPECT_EQ(back.steps, 5001);
  EXPECT_EQ(back.evaluations, 9000);
  EXPECT_EQ(back.seconds, 0.04);
  EXPECT_EQ(back.events[0].speed, 3.5);
  EXPECT_TRUE(back.events[0].closing);
  const MotionFrame &frame = back.frames[1], &from = there.frames[1];
  EXPECT_EQ(frame.state.t, from.state.t);
  EXPECT_EQ(frame.state.bodies[0].X.R, from.state.bodies[0].X.R);
  EXPECT_TRUE(std::signbit(frame.state.bodies[0].omega.z()));
  EXPECT_EQ(frame.state.contacts[0].places.on_B, from.state.contacts[0].places.on_B);
  EXPECT_TRUE(frame.state.contacts[0].places.on_A.numbers.array().isNaN().all());
  EXPECT_TRUE(frame.state.contacts[0].closed);
  EXPECT_FALSE(frame.state.contacts[0].followed);
  EXPECT_EQ(frame.contact_gap, from.contact_gap);
  EXPECT_EQ(frame.lines[0].dissipation, 5);
  EXPECT_EQ(frame.paths[1], 1);
  EXPECT_EQ(frame.condition_multiplier, from.condition_multiplier);
  EXPECT_EQ(frame.balance(), from.balance());
  // And all else: the same again is the same text.
  const std::string whole = bytes_of_file(path_);
  {
    fs::remove(path_);
    LineFile file(path_);
    MotionJournal again(file, kMotionJournal, parts_, 0);
    for (const MotionStretch& stretch : journal.stretches) again.append(stretch);
  }
  EXPECT_EQ(bytes_of_file(path_), whole);
}

TEST_F(MotionJournalFile, BeginsAnewWhereALatticeBecameFiner) {
  {
    LineFile file(path_);
    MotionJournal journal(file, kMotionJournal, parts_, read().whole_bytes);
    journal.append(LatticeRefinement{1, {Eigen::Matrix3d::Identity(), {0.1, 0.2, 0.3}}});
    journal.append(made_up_stretch(3));
  }
  const MotionContents journal = read();
  ASSERT_EQ(journal.refinements.size(), 1U);
  EXPECT_EQ(journal.refinements[0].potential, 1U);
  EXPECT_EQ(journal.refinements[0].at.p, Eigen::Vector3d(0.1, 0.2, 0.3));
  ASSERT_EQ(journal.stretches.size(), 1U);
  EXPECT_EQ(journal.stretches[0].frames[0].driver_work, -3);
}

// Never an error, and every whole line is there.
TEST_F(MotionJournalFile, IsReadUpToWhereItWasCut) {
  const std::string whole = bytes_of_file(path_);
  for (std::size_t bytes = 0; bytes <= whole.size(); bytes += 5) {
    write(whole.substr(0, bytes));
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<long>(bytes), '\n');
    EXPECT_EQ(static_cast<long>(read().stretches.size()), std::max(0L, lines - 1)) << bytes;
  }
}

TEST_F(MotionJournalFile, DoesNotBelieveALineThatWasDamaged) {
  const std::string whole = bytes_of_file(path_);
  for (std::size_t at = whole.rfind("stretch "); at + 1 < whole.size(); at += 7) {
    std::string damaged = whole;
    damaged[at] = damaged[at] == '1' ? '2' : '1';
    write(damaged);
    EXPECT_EQ(read().stretches.size(), 1U) << at;
  }
}

TEST_F(MotionJournalFile, ThatIsSomethingElseIsNamed) {
  write("notes of mine\n");
  try {
    (void)read();
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        path_.string() + ": is no journal of a motion, expected this name to be free for one");
  }
}

// The mass that a mesh and a density make is one of the parts.
TEST(MotionParts, KnowTheMassOfTheMovingBody) {
  const auto mass_of = [](const std::string& mass) {
    const Scene scene = parse_scene(with(kSmallScene, "start.rotation = [0, 0, 0]\n",
                                         "start.rotation = [0, 0, 0]\nmass = " + mass +
                                             "\ncenter = [0, -100, 0]\ninertia = [[20000, 0, 0], "
                                             "[0, 5000, 0], [0, 0, 20000]]\n"),
                                    "knee.toml");
    return motion_parts(scene, {})[2].hash;
  };
  EXPECT_EQ(mass_of("4"), mass_of("4.0"));
  EXPECT_NE(mass_of("4"), mass_of("5"));
}

}  // namespace
}  // namespace condyle
