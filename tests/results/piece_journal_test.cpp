#include "condyle/results/piece_journal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "condyle/input_error.h"
#include "condyle/results/journal_words.h"
#include "condyle/results/sweep_record.h"
#include "results/made_up_run.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// All that a pose may tell, with numbers that are hard to write.
PoseResult whole_pose(int i) {
  PoseResult pose = made_up_pose(i);
  pose.remark = "a \"second\" position exists" + std::string(static_cast<std::size_t>(i), '!');
  pose.lowest_stiffness = -0.0;
  pose.residual = std::numeric_limits<double>::denorm_min();
  pose.event_seconds = 1.0 / 3;
  ContactPointResult& point = pose.contacts[0].points[1];
  point.hertz = HertzEstimate{{2, 1}, {0, 0.6, 0.8}, 5, kNaN};
  point.edge_distance = std::numeric_limits<double>::infinity();
  pose.contacts[0].shape = ContactShape::kLine;
  pose.contacts[0].resultant_ground = {kNaN, 1e300, -1e-300};
  pose.contacts[0].layer = LayerResult{.area = 0.1, .points = 7, .force = {1, 2, 3}};
  pose.contacts[0].pressures = {{true, {1, 2}, {3, 4, 5}, 6, 7, 8}, {}};
  pose.paths = {{{{1, 2, 3}, {4, 5, 6}}, {}}};
  pose.joint_stiffness.emplace();
  pose.joint_stiffness->stiffness.setConstant(0.1);
  pose.joint_stiffness->compliance.setConstant(kNaN);
  return pose;
}

SweepResult made_up_sweep() {
  SweepResult sweep;
  for (int i = 0; i < 3; ++i) sweep.poses.push_back(whole_pose(i));
  sweep.poses[1] = PoseResult();
  sweep.poses[1].value = 0.1;
  sweep.poses[1].status = PoseStatus::kSingular;
  sweep.poses[1].reason = "nothing resists";
  sweep.events = {{0.05, EventKind::kOpening, 0}, {0.15, EventKind::kLimitPoint, -1}};
  return sweep;
}

class PieceJournalFile : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    scene_.sweep->values = {0, 0.1, 0.2};
    parts_ = comparison_parts(scene_, {}, {});
    LineFile file(path_);
    PieceJournal journal(file, kLaxityJournal, parts_, 0);
    for (const int number : {0, 3}) journal.append(number, made_up_sweep());
    EXPECT_EQ(journal.failure(), "");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  [[nodiscard]] PieceContents read() const {
    return read_piece_journal(path_, kLaxityJournal, parts_, scene_);
  }
  /// How many sweeps are read of the journal of that one.
  [[nodiscard]] std::size_t read_back(const SweepResult& sweep) const {
    fs::remove(path_);
    LineFile file(path_);
    PieceJournal(file, kLaxityJournal, parts_, 0).append(1, sweep);
    return read().sweeps.size();
  }

  fs::path folder_ = test::scratch_folder("piece_journal"), path_ = folder_ / "lax.h5.journal";
  Scene scene_ = parse_scene(kSmallScene, "knee.toml");
  JournalParts parts_;
};

TEST_F(PieceJournalFile, GivesBackTheLastBit) {
  const PieceContents journal = read();
  ASSERT_TRUE(journal.head);
  EXPECT_TRUE(same_parts(*journal.head, parts_));
  EXPECT_EQ(journal.whole_bytes, fs::file_size(path_));
  ASSERT_EQ(journal.sweeps.size(), 2U);
  const SweepResult &back = journal.sweeps.at(3), there = made_up_sweep();
  // Words have the digits that tell each number exactly.
  std::string words, words_back;
  put_sweep(there, words);
  put_sweep(back, words_back);
  EXPECT_EQ(words, words_back);
  ASSERT_EQ(back.poses.size(), 3U);
  const PoseResult &pose = back.poses[2], from = there.poses[2];
  EXPECT_EQ(pose.remark, from.remark);
  EXPECT_EQ(pose.X_BA.R, from.X_BA.R);
  EXPECT_TRUE(std::signbit(pose.lowest_stiffness));
  EXPECT_EQ(pose.residual, from.residual);
  EXPECT_EQ(pose.event_seconds, from.event_seconds);
  EXPECT_EQ(pose.joint.distraction, 6);
  EXPECT_EQ(pose.ligaments[0].force, from.ligaments[0].force);
  EXPECT_EQ(pose.conditions[0].multiplier, from.conditions[0].multiplier);
  expect_same_trace(pose.trace, from.trace);
  const ContactResult& contact = pose.contacts[0];
  EXPECT_EQ(contact.shape, ContactShape::kLine);
  EXPECT_FALSE(contact.points[0].hertz);
  EXPECT_TRUE(std::isnan(contact.points[1].hertz->approach));
  EXPECT_EQ(contact.points[1].normal_ground, from.contacts[0].points[1].normal_ground);
  EXPECT_EQ(contact.points[1].edge_distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(contact.layer->points, 7);
  EXPECT_EQ(contact.pressures.size(), 2U);
  EXPECT_EQ(pose.paths[0].points[1], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(pose.joint_stiffness->stiffness(5, 5), 0.1);
  EXPECT_EQ(back.poses[1].reason, "nothing resists");
  EXPECT_EQ(back.events[1].kind, EventKind::kLimitPoint);
}

// Never an error, and every whole line is there.
TEST_F(PieceJournalFile, IsReadUpToWhereItWasCut) {
  const std::string whole = bytes_of_file(path_);
  for (std::size_t bytes = 0; bytes <= whole.size(); bytes += 11) {
    write(whole.substr(0, bytes));
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<long>(bytes), '\n');
    const PieceContents journal = read();
    EXPECT_EQ(journal.head.has_value(), lines > 0);
    EXPECT_EQ(static_cast<long>(journal.sweeps.size()), std::max(0L, lines - 1)) << bytes;
  }
}

TEST_F(PieceJournalFile, DoesNotBelieveALineThatWasDamaged) {
  const std::string whole = bytes_of_file(path_);
  const std::size_t last = whole.rfind("sweep ");
  for (std::size_t at = last; at + 1 < whole.size(); at += 29) {
    std::string damaged = whole;
    damaged[at] = damaged[at] == '1' ? '2' : '1';
    write(damaged);
    EXPECT_EQ(read().sweeps.size(), 1U) << at - last;
  }
}

// With a hash that fits: whoever wrote it had another knee, or no good in mind.
TEST_F(PieceJournalFile, DoesNotTakeWhatTheSceneCannotHold) {
  EXPECT_EQ(read_back(made_up_sweep()), 1U);
  const auto changed = [&](const auto& change) {
    SweepResult sweep = made_up_sweep();
    change(sweep);
    return read_back(sweep);
  };
  EXPECT_EQ(changed([](SweepResult& s) { s.poses.pop_back(); }), 0U);
  EXPECT_EQ(changed([](SweepResult& s) { s.poses[0].value = 7; }), 0U);
  EXPECT_EQ(changed([](SweepResult& s) { s.poses[0].contacts.clear(); }), 0U);
  EXPECT_EQ(changed([](SweepResult& s) { s.poses[0].ligaments.emplace_back(); }), 0U);
  EXPECT_EQ(changed([](SweepResult& s) { s.poses[0].conditions.clear(); }), 0U);
  EXPECT_EQ(changed([](SweepResult& s) { s.poses[0].paths[0].touches.emplace_back(); }), 0U);
  EXPECT_EQ(changed([](SweepResult& s) { s.poses[0].paths.emplace_back(); }), 0U);
  EXPECT_EQ(changed([](SweepResult& s) { s.events[0].contact = 1; }), 0U);
  EXPECT_EQ(changed([](SweepResult& s) { s.events[0].ligament = 0; }), 0U);  // it wraps on nothing
  EXPECT_EQ(changed([](SweepResult& s) { s.poses[0].status = static_cast<PoseStatus>(99); }), 0U);
}

// A count that is larger than any memory is believed no further than there are words.
TEST_F(PieceJournalFile, HoldsNoMoreThanItsLines) {
  std::string line = "sweep 0 1000000000000000 0 0";
  seal_line(0, line);
  const std::string whole = bytes_of_file(path_);
  write(whole.substr(0, whole.find('\n') + 1) + line);
  EXPECT_TRUE(read().sweeps.empty());
}

TEST_F(PieceJournalFile, GoesOnAfterItsLastWholeLine) {
  write(bytes_of_file(path_) + "sweep 4 torn");
  {
    LineFile file(path_);
    PieceJournal(file, kLaxityJournal, parts_, read().whole_bytes).append(5, made_up_sweep());
  }
  EXPECT_EQ(read().sweeps.size(), 3U);
  EXPECT_TRUE(read().sweeps.contains(5));
}

TEST_F(PieceJournalFile, ThatIsSomethingElseIsNamed) {
  const auto message = [&] {
    try {
      (void)read();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  for (const char* other : {"notes of mine\n", "condyle journal 1 scene 0 surfaces 0\n",
                            "condyle compare 1 scene 0 surfaces 0 asked 0 program 0\n"}) {
    write(other);
    EXPECT_EQ(message(), path_.string() +
                             ": is no journal of a test of laxity, expected this name to be free "
                             "for one");
  }
  write("condyle laxity 1 scene 0 surfaces 0\n");
  EXPECT_EQ(message(),
            path_.string() + ": is a journal of another format, expected \"condyle laxity 1\"");
  write("condyle laxity 2 what follows\n");
  EXPECT_EQ(message(), path_.string() +
                           ": written by a later condyle (format \"condyle laxity 2\"), this one "
                           "reads up to \"condyle laxity 1\"");
}

TEST_F(PieceJournalFile, OfAnotherSceneOrOtherOptionsIsNamed) {
  const PieceContents journal = read();
  const auto message = [&](const JournalParts& parts) {
    try {
      expect_same_parts("lax.h5.journal", *journal.head, parts);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message(parts_), "no error");
  CompareOptions cubic;
  cubic.degree = 3;
  EXPECT_EQ(message(comparison_parts(scene_, {}, cubic)),
            "lax.h5.journal: belongs to another range, --degree or --strain, expected those of the "
            "run that was stopped");
  Scene other = scene_;
  other.text += "# another\n";
  EXPECT_EQ(message(comparison_parts(other, {}, {})),
            "lax.h5.journal: belongs to another text of the scene, expected that of knee.toml");
}

}  // namespace
}  // namespace condyle
