#include "condyle/results/journal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/results/journal_line.h"
#include "condyle/specimen/fit_surfaces.h"
#include "results/made_up_run.h"
#include "support/same_sweep.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

constexpr RunIdentity kIdentity = {0x1234, 0xfedcba9876543210};

KnownPose made_up_known(int i) {
  KnownPose known;
  known.pose = made_up_pose(i);
  known.visit = i;
  known.from = 0.1 * (i - 1);
  known.pose.remark = "a \"second\" position of equilibrium exists" + std::string(i, '!');
  known.from_elsewhere = i == 1;
  known.events = {{0.1 * i - 0.03, EventKind::kOpening, 0}, {0.1 * i, EventKind::kLimitPoint, -1}};
  return known;
}

class JournalFile : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    LineFile file(path_);
    Journal journal(file, kIdentity, 0);
    for (int i = 0; i < 3; ++i) journal.append(made_up_known(i));
    EXPECT_EQ(journal.failure(), "");
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string text() const {
    std::ifstream stream(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  [[nodiscard]] JournalContents read() const { return read_journal(path_, scene_); }
  [[nodiscard]] std::string message() const {
    try {
      (void)read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_ = test::scratch_folder("journal"), path_ = folder_ / "run.h5.journal";
  Scene scene_ = parse_scene(kSmallScene, "knee.toml");
};

TEST_F(JournalFile, GivesBackTheLastBit) {
  const JournalContents journal = read();
  EXPECT_TRUE(journal.started);
  EXPECT_EQ(journal.identity, kIdentity);
  EXPECT_EQ(journal.whole_bytes, fs::file_size(path_));
  ASSERT_EQ(journal.poses.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const KnownPose &a = made_up_known(i), &b = journal.poses[static_cast<std::size_t>(i)];
    EXPECT_EQ(a.pose.value, b.pose.value);
    EXPECT_EQ(a.visit, b.visit);
    EXPECT_EQ(a.from, b.from);
    EXPECT_EQ(a.pose.remark, b.pose.remark);
    EXPECT_EQ(a.from_elsewhere, b.from_elsewhere);
    EXPECT_EQ(a.pose.X_BA.R, b.pose.X_BA.R);
    EXPECT_EQ(a.pose.X_BA.p, b.pose.X_BA.p);
    EXPECT_EQ(a.pose.seconds, b.pose.seconds);
    expect_same_trace(a.pose.trace, b.pose.trace);
    EXPECT_EQ(a.pose.conditions[0].multiplier, b.pose.conditions[0].multiplier);
    EXPECT_EQ(b.pose.contacts[0].force, a.pose.contacts[0].force);
    EXPECT_EQ(b.pose.contacts[0].points[1].point_moving, a.pose.contacts[0].points[1].point_moving);
    ASSERT_EQ(b.events.size(), 2u);
    EXPECT_EQ(b.events[0].value, a.events[0].value);
    EXPECT_EQ(b.events[1].kind, EventKind::kLimitPoint);
    EXPECT_EQ(b.events[1].contact, -1);
  }
}

TEST_F(JournalFile, HoldsAFailureWithItsReason) {
  KnownPose failed;
  failed.pose.value = 1.0 / 3;
  failed.pose.status = PoseStatus::kSingular;
  failed.pose.reason = "\"a\" and \"b\"\ndepend on each other";
  failed.pose.residual = std::numeric_limits<double>::infinity();
  std::string line;
  write_journal_line(failed, line);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  line.pop_back();
  KnownPose back;
  ASSERT_TRUE(read_journal_line(line, 1, 1, back));
  EXPECT_EQ(back.pose.value, 1.0 / 3);
  EXPECT_EQ(back.pose.status, PoseStatus::kSingular);
  EXPECT_EQ(back.pose.reason, "\"a\" and \"b\" depend on each other");
  EXPECT_EQ(back.pose.residual, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(back.from);
}

// Lines of runs before remarks were kept end with the reason.
TEST_F(JournalFile, ReadsALineWithoutARemark) {
  KnownPose known = made_up_known(1);
  known.pose.remark.clear();
  known.pose.reason = "an \"old\" one";
  std::string line;
  write_journal_line(known, line);
  line.resize(line.rfind(" \"\" "));
  line += " " + std::to_string(hash_bytes(line));
  KnownPose back;
  ASSERT_TRUE(read_journal_line(line, 1, 1, back));
  EXPECT_EQ(back.pose.reason, known.pose.reason);
  EXPECT_EQ(back.pose.remark, "");
  EXPECT_FALSE(back.from_elsewhere);
}

// Lines of runs before traces were kept go from the events to the words.
TEST_F(JournalFile, ReadsALineWithoutATrace) {
  const KnownPose known = made_up_known(1);
  std::string line;
  write_journal_line(known, line);
  const std::size_t trace = line.find(" trace "), words = line.find(" \"");
  ASSERT_LT(trace, words);
  line = line.substr(0, trace) + line.substr(words, line.rfind(' ') - words);
  line += " " + std::to_string(hash_bytes(line));
  KnownPose back;
  ASSERT_TRUE(read_journal_line(line, 1, 1, back));
  EXPECT_EQ(back.pose.remark, known.pose.remark);
  EXPECT_FALSE(back.pose.trace.told());
}

// Cut after every single byte: never an error, and every whole line is there.
TEST_F(JournalFile, IsReadUpToWhereItWasCut) {
  const std::string whole = text();
  for (std::size_t bytes = 0; bytes <= whole.size(); ++bytes) {
    write(whole.substr(0, bytes));
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<long>(bytes), '\n');
    const JournalContents journal = read();
    EXPECT_EQ(journal.started, lines > 0);
    EXPECT_EQ(static_cast<long>(journal.poses.size()), std::max(0L, lines - 1)) << bytes;
  }
}

TEST_F(JournalFile, DoesNotBelieveALineThatWasDamaged) {
  const std::string whole = text();
  const std::size_t third = whole.rfind("pose ");
  for (std::size_t at = third; at + 1 < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = damaged[at] == '1' ? '2' : '1';
    write(damaged);
    EXPECT_EQ(read().poses.size(), 2u) << at - third;
  }
}

TEST_F(JournalFile, GoesOnAfterItsLastWholeLine) {
  write(text() + "pose 0.7 torn");
  {
    LineFile file(path_);
    Journal journal(file, kIdentity, read().whole_bytes);
    journal.append(made_up_known(3));
  }
  ASSERT_EQ(read().poses.size(), 4u);
  EXPECT_EQ(read().poses[3].visit, 3);
}

TEST_F(JournalFile, IsGoneWhenTheRunIsWritten) {
  LineFile file(path_);
  Journal journal(file, kIdentity, 0);
  EXPECT_TRUE(read().poses.empty());  // a new one
  journal.remove();
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_FALSE(read().started);
}

TEST_F(JournalFile, OfNoPoseIsNotLeft) {
  fs::remove(path_);
  {
    LineFile file(path_);
    const Journal journal(file, kIdentity, 0);
    EXPECT_TRUE(fs::exists(path_));  // taken
  }
  EXPECT_FALSE(fs::exists(path_));
}

// What a signal does before the program ends by it.
TEST_F(JournalFile, IsRemovedByASignalAsLongAsItHoldsNothing) {
  fs::remove(path_);
  {
    LineFile file(path_);
    Journal journal(file, kIdentity, 0);
    remove_unkept_files();
    EXPECT_FALSE(fs::exists(path_));
  }
  LineFile file(path_);
  Journal journal(file, kIdentity, 0);
  journal.append(made_up_known(0));
  remove_unkept_files();
  EXPECT_EQ(read().poses.size(), 1U);
}

// A study on many threads has one each.
TEST_F(JournalFile, AndSoAreManyOfThem) {
  std::vector<std::unique_ptr<LineFile>> files;
  for (int i = 0; i < 32; ++i)
    files.push_back(std::make_unique<LineFile>(path_.string() + std::to_string(i)));
  remove_unkept_files();
  for (int i = 0; i < 32; ++i) EXPECT_FALSE(fs::exists(path_.string() + std::to_string(i))) << i;
}

TEST_F(JournalFile, BelongsToOneRunAtATime) {
  const LineFile file(path_);
  EXPECT_THROW(LineFile{path_}, InputError);
}

TEST_F(JournalFile, ThatIsSomethingElseIsNamed) {
  write("notes of mine");
  EXPECT_EQ(message(),
            path_.string() + ": is no journal of a sweep, expected this name to be free for one");
  write("condyle journal x what follows\n");
  EXPECT_EQ(message(),
            path_.string() + ": is a journal of another format, expected \"condyle journal 1\"");
  write("condyle journal 2 what follows\n");
  EXPECT_EQ(message(), path_.string() +
                           ": written by a later condyle (format \"condyle journal 2\"), this one "
                           "reads up to \"condyle journal 1\"");
}

// A pose that was not found has a line as soon as it is given up, and another as final.
TEST_F(JournalFile, HoldsOfTwoLinesOfAPoseTheLaterOne) {
  KnownPose lost = made_up_known(1);
  lost.pose.status = PoseStatus::kNoEquilibrium;
  lost.open = true;
  LineFile file(path_);
  Journal journal(file, kIdentity, 0);
  journal.append(lost);
  journal.append(made_up_known(0));
  ASSERT_EQ(read().poses.size(), 2U);
  EXPECT_TRUE(read().poses[0].open);
  EXPECT_TRUE(read().poses[0].from_elsewhere);
  EXPECT_FALSE(read().poses[1].open);
  KnownPose found = made_up_known(1);
  found.pose.status = PoseStatus::kConverged;
  journal.append(found);
  const std::vector<KnownPose> poses = read().poses;
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].visit, 0);
  EXPECT_TRUE(poses[1].pose.converged());
  EXPECT_FALSE(poses[1].open);
}

TEST_F(JournalFile, CostsAFewMicrosecondsAPose) {
  LineFile file(path_);
  Journal journal(file, kIdentity, 0);
  const KnownPose known = made_up_known(1);
  constexpr int kLines = 2000;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kLines; ++i) journal.append(known);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  RecordProperty("microseconds", std::to_string(1e6 * seconds.count() / kLines));
  EXPECT_LT(seconds.count() / kLines, 2e-4);  // a busy machine is given much room
}

// A journal cut anywhere leads to the same sweep.
TEST_F(JournalFile, OfThePhantomResumesFromEveryKindOfCut) {
  const Scene scene = read_scene(fs::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml");
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  SweepOptions options;
  SweepResult uninterrupted;
  {
    LineFile file(path_);
    Journal journal(file, identity(scene, surfaces), 0);
    options.on_computed = [&](const KnownPose& pose) { journal.append(pose); };
    uninterrupted = sweep(scene, surfaces, options);
  }
  const std::string whole = text();
  const std::size_t head = whole.find('\n') + 1, eighth = [&] {
    std::size_t at = 0;
    for (int line = 0; line < 8; ++line) at = whole.find('\n', at) + 1;
    return at;
  }();
  for (const std::size_t bytes : {std::size_t{0}, head / 2, head, head + 5, eighth, eighth + 200,
                                  whole.size() - 1, whole.size()}) {
    SCOPED_TRACE(bytes);
    write(whole.substr(0, bytes));
    const JournalContents left = read_journal(path_, scene);
    std::size_t computed = 0;
    SweepOptions resumed;
    resumed.known = left.poses;
    resumed.on_computed = [&](const KnownPose&) { ++computed; };
    test::expect_same_sweep(uninterrupted, sweep(scene, surfaces, resumed));
    EXPECT_EQ(computed, 25 - left.poses.size());
  }
}

}  // namespace
}  // namespace condyle
