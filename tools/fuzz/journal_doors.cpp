/// What a killed command left behind. The first byte says whether checksums are set right before the
/// journal is read: otherwise nearly nothing would get past them.

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "condyle/results/calibration_journal.h"
#include "condyle/results/journal.h"
#include "condyle/results/journal_line.h"
#include "condyle/results/run_identity.h"
#include "condyle/results/study_chunk_file.h"
#include "condyle/results/study_identity.h"
#include "condyle/scene_file/read_scene.h"
#include "fuzz/door_list.h"
#include "fuzz/memory_file.h"
#include "fuzz/refusal.h"

namespace condyle::fuzz {
namespace {

const Scene& quadric_scene() {
  static const Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/hard/one-step.toml");
  return scene;
}

/// Puts the hash of each line but the first in place of its last word.
std::string with_hashes(const std::string& text) {
  std::string sealed;
  bool head = true;
  for (std::size_t at = 0; at < text.size(); head = false) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    if (!head) {
      line.resize(std::min(line.rfind(' '), line.size()));
      line += fmt::format(" {:016x}", hash_bytes(line));
    }
    sealed += line + "\n";
    at = end + 1;
  }
  return sealed;
}

std::string journal_of(Bytes bytes) {
  if (bytes.empty()) return "";
  const std::string text = text_of(bytes.subspan(1));
  return bytes[0] % 2 == 0 ? with_hashes(text) : text;
}

}  // namespace

void open_sweep_journal(Bytes bytes) {
  const MemoryFile file(journal_of(bytes));
  taken([&] {
    const JournalContents contents = read_journal(file.path(), quadric_scene());
    SweepResult result;
    for (const KnownPose& known : contents.poses) result.poses.push_back(known.pose);
    const KnownPoseIndex index(contents.poses);
    if (!contents.poses.empty()) (void)index.find(contents.poses.front().pose.value, 0);
    (void)index.nearest_converged(0.5);
    for (const KnownPose& known : contents.poses) {
      std::string line;
      write_journal_line(known, line);
    }
  });
}

void open_calibration_journal(Bytes bytes) {
  static const std::string head =
      fmt::format("condyle calibration 1 scene {:016x} surfaces {:016x} table {:016x}\n", 1, 2, 3);
  const bool with_head = !bytes.empty() && bytes[0] % 4 < 2;
  const std::string text = journal_of(bytes);
  const MemoryFile file(with_head ? head + text.substr(std::min(text.size(), text.find('\n') + 1))
                                  : text);
  static Scene scene = [] {
    Scene calibrated = quadric_scene();
    calibrated.calibration.emplace();
    return calibrated;
  }();
  taken([&] { (void)read_calibration_journal(file.path(), {{1, 2}, 3}, scene); });
}

}  // namespace condyle::fuzz
