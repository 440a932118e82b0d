#include "condyle/results/study_journal.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "condyle/input_error.h"
#include "condyle/results/study_chunk_file.h"
#include "results/made_up_study.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

class StudyJournalFolder : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] StudyJournals open(bool resume, StudyPart part = {}) const {
    return {result_, plan_, part, resume};
  }
  /// What a run leaves that was stopped after all chunks.
  void leave_all() const {
    StudyJournals journals = open(false);
    for (const std::uint64_t c : journals.missing()) journals.append(0, made_up_chunk(plan_, c));
  }
  [[nodiscard]] std::string message(bool resume, StudyPart part = {}) const {
    try {
      (void)open(resume, part);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  [[nodiscard]] fs::path file() const {
    for (const auto& entry : fs::directory_iterator(journal_))
      if (entry.path().extension() == ".chunks") return entry.path();
    return "none";
  }
  /// Turns a byte over.
  void damage(std::streamoff at) const {
    std::fstream stream(file(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(at);
    const char byte = static_cast<char>(stream.get() ^ 1);
    stream.seekp(at);
    stream.put(byte);
  }
  [[nodiscard]] std::string refusal(const std::string& what) const {
    return journal_.string() + ": " + what +
           " that its chunks were computed from, expected the same or another output";
  }

  StudyPlan plan_ = made_up_study();
  fs::path folder_ = test::scratch_folder("study_journal");
  fs::path result_ = folder_ / "study.h5", journal_ = folder_ / "study.h5.journal";
};

TEST_F(StudyJournalFolder, HandsBackWhatWorkersAppended) {
  for (const bool single : {false, true}) {
    plan_.study.single_precision = single;
    {
      StudyJournals journals = open(false);
      EXPECT_EQ(journals.missing(), (std::vector<std::uint64_t>{0, 1, 2}));
      journals.append(1, made_up_chunk(plan_, 2));
      journals.append(0, made_up_chunk(plan_, 0));
      EXPECT_EQ(journals.count(), 2U);
      EXPECT_EQ(journals.missing(), (std::vector<std::uint64_t>{1}));
      expect_same_chunk(journals.read(2), made_up_chunk(plan_, 2), single ? 1e-7 : 0);
    }
    const StudyJournals journals = open(true);
    EXPECT_TRUE(journals.has(0) && !journals.has(1) && journals.has(2));
    expect_same_chunk(journals.read(0), made_up_chunk(plan_, 0), single ? 1e-7 : 0);
  }
}

TEST_F(StudyJournalFolder, WhatIsTornIsComputedAgain) {
  leave_all();
  fs::resize_file(file(), fs::file_size(file()) - 5);
  EXPECT_EQ(open(true).missing(), (std::vector<std::uint64_t>{2}));
  fs::resize_file(file(), 20);  // within the head
  EXPECT_EQ(open(true).count(), 0U);
  fs::resize_file(file(), 0);
  EXPECT_EQ(open(true).count(), 0U);
}

TEST_F(StudyJournalFolder, WhatIsNoJournalIsNotRead) {
  leave_all();
  std::ofstream(journal_ / "zeros.chunks") << "";
  fs::resize_file(journal_ / "zeros.chunks",
                  std::uintmax_t{1} << 32);  // of a file that has no blocks
  ASSERT_EQ(::mkfifo((journal_ / "pipe.chunks").c_str(), 0600), 0);
  EXPECT_TRUE(open(true).missing().empty());
}

TEST_F(StudyJournalFolder, ADamagedChunkCostsItself) {
  leave_all();
  const auto size = static_cast<std::streamoff>(fs::file_size(file()));
  const auto last = static_cast<std::streamoff>(chunk_layout(plan_).record_bytes(2));
  damage(size - last - 500);  // in the last but one
  EXPECT_EQ(open(true).missing(), (std::vector<std::uint64_t>{1}));
  damage(size - 500);  // in the last one
  EXPECT_EQ(open(true).missing(), (std::vector<std::uint64_t>{1, 2}));
  damage(size - last);  // in its head
  EXPECT_EQ(open(true).missing(), (std::vector<std::uint64_t>{1, 2}));
  damage(20);  // in the head: nothing of it can be trusted
  EXPECT_EQ(open(true).count(), 0U);
}

TEST_F(StudyJournalFolder, SaysWhereAChunkWasDamagedSinceItWasFound) {
  leave_all();
  const StudyJournals journals = open(true);
  damage(static_cast<std::streamoff>(fs::file_size(file())) - 100);
  expect_same_chunk(journals.read(0), made_up_chunk(plan_, 0));
  EXPECT_THROW((void)journals.read(2), InputError);
}

TEST_F(StudyJournalFolder, BelongsToOneRunAtATime) {
  const std::string held =
      journal_.string() +
      ": another run is writing into it, expected an output of its own for each run";
  {
    const StudyJournals whole = open(false);
    EXPECT_EQ(message(true), held);
    EXPECT_EQ(message(true, {1, 2}), held);
  }
  const StudyJournals first = open(false, {1, 3});
  const StudyJournals second = open(false, {2, 3});
  EXPECT_EQ(message(true), held);
  EXPECT_EQ(message(true, {2, 3}),
            journal_.string() + ": another run is computing part 2/3, expected each part once");
}

TEST_F(StudyJournalFolder, PartsShareTheChunks) {
  for (const int i : {2, 1, 2}) {  // the second one anew
    StudyJournals part = open(false, {i, 2});
    EXPECT_EQ(part.missing(),
              i == 1 ? (std::vector<std::uint64_t>{0, 2}) : (std::vector<std::uint64_t>{1}));
    for (const std::uint64_t c : part.missing()) part.append(0, made_up_chunk(plan_, c));
  }
  EXPECT_TRUE(open(true).missing().empty());
  EXPECT_TRUE(open(true, {1, 2}).missing().empty());
  EXPECT_EQ(open(false).missing().size(), 3U);  // a whole run anew
}

TEST_F(StudyJournalFolder, OthersOfATeamReadAndWriteBesideTheFirst) {
  StudyJournals first = open(false);
  StudyJournals other = StudyJournals::join(result_, plan_);
  other.append(0, made_up_chunk(plan_, 1));
  first.append(0, made_up_chunk(plan_, 0));
  EXPECT_FALSE(first.has(1));
  first.read_again();
  EXPECT_EQ(first.missing(), (std::vector<std::uint64_t>{2}));
  expect_same_chunk(first.read(1), made_up_chunk(plan_, 1));
  first.remove();
  EXPECT_FALSE(fs::exists(journal_));
}

TEST_F(StudyJournalFolder, RefusesWhatIsNoFolderOfChunks) {
  fs::create_directory(journal_);
  std::ofstream(journal_ / "diary.txt") << "mine\n";
  EXPECT_EQ(message(false), journal_.string() +
                                ": holds diary.txt, which is no part of a study, expected a folder "
                                "of a study's chunks or none");
  EXPECT_TRUE(fs::exists(journal_ / "diary.txt"));
  fs::remove_all(journal_);
  std::ofstream(journal_) << "mine\n";
  EXPECT_EQ(message(false),
            journal_.string() +
                ": is no folder of a study's chunks, expected this name to be free for one");
}

TEST_F(StudyJournalFolder, NamesWhatDiffersFromTheStudyThatLeftIt) {
  leave_all();
  const auto changed = [&](const auto& change) {
    plan_ = made_up_study();
    change();
    return message(true);
  };
  EXPECT_EQ(changed([&] { plan_.study.text += "#"; }), refusal("the study is not the one"));
  EXPECT_EQ(changed([&] { plan_.study.seed = 8; }), refusal("the seed is not the one"));
  EXPECT_EQ(changed([&] { plan_.points = 151; }), refusal("the number of samples is not the one"));
  EXPECT_EQ(changed([&] { plan_.parameters[1].spread.bounds[1] = 0.3; }),
            refusal("the design is not the one"));
  EXPECT_EQ(changed([&] {
              plan_.table = {{0, 0.1}};
            }),
            refusal("the table of the design is not the one"));
  EXPECT_EQ(changed([&] { plan_.knees[0].scene.text += "#"; }),
            refusal("the scene knee1.toml is not the one"));
  EXPECT_EQ(changed([&] { plan_.knees.pop_back(); }), refusal("the design is not the one"));
  EXPECT_EQ(changed([] {}), "no error");
}

TEST_F(StudyJournalFolder, RefusesChunksOfAnotherProgram) {
  StudyIdentity identity = study_identity(plan_);
  for (auto& [what, hash] : identity)
    if (what == "program") ++hash;
  fs::create_directory(journal_);
  std::ofstream(journal_ / "whole.host.1.0.0.chunks") << head_of(identity);
  EXPECT_EQ(message(true), refusal("the program is not the one"));
}

TEST_F(StudyJournalFolder, AFullDiskIsToldAndLosesNothing) {
  StudyJournals journals = open(false);
  journals.append(0, made_up_chunk(plan_, 0));
  struct rlimit before {};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small = {fs::file_size(file()) + 100, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(journals.append(0, made_up_chunk(plan_, 1)), InputError);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  journals.append(0, made_up_chunk(plan_, 2));
  journals.read_again();
  EXPECT_EQ(journals.missing(), (std::vector<std::uint64_t>{1}));
  expect_same_chunk(journals.read(2), made_up_chunk(plan_, 2));
}

}  // namespace
}  // namespace condyle
