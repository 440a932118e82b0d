#include "condyle/results/piece_journal.h"

#include "condyle/equilibrium/known_poses.h"
#include "condyle/results/journal_words.h"
#include "condyle/results/sweep_record.h"
#include "condyle/version.h"

namespace condyle {
namespace {

constexpr std::string_view kSweepWord = "sweep";

/// Has it a pose for each value that the scene sweeps?
bool has_values(const Scene& scene, const SweepResult& sweep) {
  const std::vector<double>& values = scene.sweep->values;
  return std::equal(
      sweep.poses.begin(), sweep.poses.end(), values.begin(), values.end(),
      [](const PoseResult& pose, double value) { return same_value(value, pose.value); });
}

bool take_sweep_line(std::string_view line, const Scene& scene, PieceContents& journal) {
  if (!take_seal(line) || !line.starts_with(kSweepWord)) return false;
  WordTaker take{line.substr(kSweepWord.size())};
  const int number = take.number<int>();
  SweepResult sweep = take_sweep(take);
  if (!take.ok || !take.rest.empty() || !belongs_to(scene, sweep) || !has_values(scene, sweep))
    return false;
  journal.sweeps.insert_or_assign(number, std::move(sweep));
  return true;
}

}  // namespace

JournalParts comparison_parts(const Scene& scene,
                              const std::vector<FittedSurface>& surfaces,
                              const CompareOptions& options) {
  std::string asked;
  put_words(asked, scene.sweep->values.data(),
            static_cast<std::ptrdiff_t>(scene.sweep->values.size()));
  put_word(asked, options.degree);
  put_word(asked, options.strain);
  JournalParts parts = run_parts(identity(scene, surfaces), scene);
  parts.push_back(
      {"asked", hash_bytes(asked),
       "another range, --degree or --strain, expected those of the run that was stopped"});
  parts.push_back(program_part());
  return parts;
}

PieceContents read_piece_journal(const std::filesystem::path& path,
                                 const JournalKind& kind,
                                 const JournalParts& parts,
                                 const Scene& scene) {
  PieceContents journal;
  const std::string text = bytes_of_file(path);
  journal.head = read_journal_head(path.string(), text, kind, parts);
  if (!journal.head) return journal;
  journal.whole_bytes = read_journal_lines(text, journal.head->bytes, [&](std::string_view line) {
    return take_sweep_line(line, scene, journal);
  });
  return journal;
}

void PieceJournal::append(int number, const SweepResult& sweep) {
  std::string line(kSweepWord);
  put_word(line, number);
  put_sweep(sweep, line);
  seal_line(0, line);
  append_line(line);
}

}  // namespace condyle
