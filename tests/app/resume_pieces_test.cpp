/// laxity, compare and simulate that are stopped and go on with --resume. A limit on the size of files
/// cuts the journal in the middle of a line, as a kill may, and lets no result be written.

#include <algorithm>
#include <ostream>

#include "app/run_program.h"
#include "app/same_result.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::Outcome;

/// `simulate` of the small scene: the leg swings for some ten thousand steps.
std::string swinging() {
  const std::string mass =
      "mass = 4\ncenter = [0, -100, 0]\n"
      "inertia = [[20000, 0, 0], [0, 5000, 0], [0, 0, 20000]]\n";
  std::string text =
      with(kSmallScene, "start.rotation = [0, 0, 0]\n", "start.rotation = [0, 0, 0]\n" + mass);
  text = text.substr(0, text.find("[sweep]"));
  return text +
         "[simulate]\ntime = 8\nrate = 50\ngravity = [0, -9810, 0]\nflexion = 10\ntolerance = "
         "1e-10\n";
}

struct Work {
  std::string name, command, scene;
  int blocks;          ///< of 512 bytes: the limit, within the journal and less than the result
  std::string pieces;  ///< that the journal holds

  friend std::ostream& operator<<(std::ostream& out, const Work& work) { return out << work.name; }
};

const std::vector<Work> kWorks = {
    {"laxity", "laxity knee.toml -o run.h5",
     contents(CONDYLE_SOURCE_DIR "/data/wismans-type/drawer.toml"), 200, "sweeps"},
    {"compare", "compare knee.toml -o run.h5 --step 10",
     contents(CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml"), 120, "sweeps"},
    {"simulate", "simulate knee.toml -o run.h5", swinging(), 400, "frames"}};

class ResumePieces : public test::CommandLine, public testing::WithParamInterface<Work> {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("knee.toml", GetParam().scene);
  }
  [[nodiscard]] std::string limited() const {
    return "trap '' XFSZ; ulimit -f " + std::to_string(GetParam().blocks) + "; ";
  }
  /// Leaves a journal that holds something and ends within a line.
  void stop() const {
    const Outcome stopped = run(GetParam().command, limited());
    EXPECT_EQ(stopped.code, 1);
    EXPECT_NE(stopped.err.find("cannot be written"), std::string::npos) << stopped.err;
    ASSERT_EQ(results(), std::vector<std::string>{"run.h5.journal"});
    const std::string journal = contents(at("run.h5.journal"));
    ASSERT_GE(std::count(journal.begin(), journal.end(), '\n'), 2);
    ASSERT_NE(journal.back(), '\n');
  }
  [[nodiscard]] Outcome resume() const { return run(GetParam().command + " --resume"); }
};

TEST_P(ResumePieces, GoOnToTheSameBits) {
  EXPECT_EQ(run(GetParam().command).code, 0);
  fs::create_directory(at("whole"));
  fs::rename(at("run.h5"), at("whole/run.h5"));
  EXPECT_EQ(run(GetParam().command, limited()).code, 1);
  const std::string journal = contents(at("run.h5.journal"));
  const auto lines = std::count(journal.begin(), journal.end(), '\n');
  ASSERT_GE(lines, 2);
  const Outcome resumed = resume();
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("resuming with "), std::string::npos) << resumed.out;
  EXPECT_NE(resumed.out.find(' ' + GetParam().pieces + " of run.h5.journal"), std::string::npos)
      << resumed.out;
  EXPECT_FALSE(fs::exists(at("run.h5.journal")));
  test::expect_same_result(at("whole/run.h5"), at("run.h5"));

  // From one piece, from the head alone, and from less.
  const std::size_t head = journal.find('\n') + 1;
  for (const std::size_t bytes : {journal.find('\n', head) + 1, head, head / 2}) {
    SCOPED_TRACE(bytes);
    fs::remove(at("run.h5"));
    write("run.h5.journal", journal.substr(0, bytes));
    const Outcome again = resume();
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(
        again.out.find("nothing to resume from in run.h5, starting anew") == std::string::npos,
        bytes > head)
        << again.out;
    test::expect_same_result(at("whole/run.h5"), at("run.h5"));
  }
}

TEST_P(ResumePieces, RefuseTheJournalOfAnotherScene) {
  stop();
  const std::string journal = contents(at("run.h5.journal"));
  write("knee.toml", GetParam().scene + "# another\n");
  const Outcome resumed = resume();
  EXPECT_EQ(resumed.code, 1);
  EXPECT_TRUE(
      resumed.err.ends_with("condyle: run.h5.journal: belongs to another text of the scene, "
                            "expected that of knee.toml\n"))
      << resumed.err;
  EXPECT_EQ(contents(at("run.h5.journal")), journal);
}

TEST_P(ResumePieces, OfferItWhereAStoppedRunIsReplaced) {
  stop();
  const Outcome anew = run(GetParam().command);
  EXPECT_EQ(anew.code, 0) << anew.err;
  EXPECT_NE(anew.out.find(GetParam().pieces +
                          " of a run that was stopped: --resume would have gone on with it, this "
                          "run starts anew"),
            std::string::npos)
      << anew.out;
  EXPECT_EQ(results(), std::vector<std::string>{"run.h5"});
}

TEST_P(ResumePieces, DoNotWriteOverAFileThatIsNoJournal) {
  write("run.h5.journal", "notes of mine\n");
  const Outcome outcome = run(GetParam().command);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.err.starts_with("condyle: run.h5.journal: is no journal of a"))
      << outcome.err;
  EXPECT_EQ(contents(at("run.h5.journal")), "notes of mine\n");
}

INSTANTIATE_TEST_SUITE_P(Commands, ResumePieces, testing::ValuesIn(kWorks), [](const auto& one) {
  return one.param.name;
});

}  // namespace
}  // namespace condyle
