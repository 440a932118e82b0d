/// What a killed command left behind. The first byte says whether checksums are set right before the
/// journal is read: otherwise nearly nothing would get past them.

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "condyle/network/integrate.h"
#include "condyle/network/motion_lattices.h"
#include "condyle/results/calibration_journal.h"
#include "condyle/results/journal.h"
#include "condyle/results/journal_line.h"
#include "condyle/results/motion_journal.h"
#include "condyle/results/piece_journal.h"
#include "condyle/results/run_columns.h"
#include "condyle/results/run_identity.h"
#include "condyle/results/study_chunk_file.h"
#include "condyle/results/study_identity.h"
#include "condyle/results/sweep_record.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/surface/exact_surfaces.h"
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
std::string with_hashes(const std::string& text, std::string (*hash_in_words)(std::uint64_t)) {
  std::string sealed;
  bool head = true;
  for (std::size_t at = 0; at < text.size(); head = false) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    if (!head) {
      line.resize(std::min(line.rfind(' '), line.size()));
      line += hash_in_words(hash_bytes(line));
    }
    sealed += line + "\n";
    at = end + 1;
  }
  return sealed;
}

std::string decimal(std::uint64_t hash) { return fmt::format(" {}", hash); }
std::string hexadecimal(std::uint64_t hash) { return fmt::format(" {:016x}", hash); }

std::string journal_of(Bytes bytes, std::string (*hash_in_words)(std::uint64_t) = decimal) {
  if (bytes.empty()) return "";
  const std::string text = text_of(bytes.subspan(1));
  return bytes[0] % 2 == 0 ? with_hashes(text, hash_in_words) : text;
}

/// With a head in place of the first line where the first byte says so.
std::string with_head(Bytes bytes, const std::string& head, const std::string& journal) {
  if (bytes.empty() || bytes[0] % 4 >= 2) return journal;
  return head + journal.substr(std::min(journal.size(), journal.find('\n') + 1));
}

const JournalParts kParts = {{"scene", 1, "another"}, {"mass", 2, "another"}};

std::string head_of(const JournalKind& kind) {
  return fmt::format("{} scene {:016x} mass {:016x}\n", kind.format, 1, 2);
}

/// A ball on a plane, held by a spring.
Network ball_on_spring() {
  MassProperties mass;
  mass.mass = 1e-3;
  mass.inertia = 0.36 * Eigen::Matrix3d::Identity();
  Network network;
  network.bodies = {{"ball", mass, {0, 0, 0}, false}};
  network.contacts = {{"floor", 0, make_plane({0, 0, 0}, {0, 0, 1}),
                       make_sphere({0, 0, 0}, 30, true), true, false}};
  LineComponent spring;
  spring.name = "spring";
  spring.from = add_port(network, "above", kGround, {5, 0, 90});
  spring.to = add_port(network, "top", 0, {5, 0, 30});
  spring.law = QuadraticLaw{0.1, 50};
  network.lines = {spring};
  network.gravity = {0, 0, -9810};
  return network;
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
  const MemoryFile file(with_head(bytes, head, journal_of(bytes, hexadecimal)));
  static Scene scene = [] {
    Scene calibrated = quadric_scene();
    calibrated.calibration.emplace();
    return calibrated;
  }();
  taken([&] { (void)read_calibration_journal(file.path(), {{1, 2}, 3}, scene); });
}

void open_piece_journal(Bytes bytes) {
  const MemoryFile file(with_head(bytes, head_of(kCompareJournal), journal_of(bytes)));
  taken([&] {
    const Scene& scene = quadric_scene();
    const PieceContents contents = read_piece_journal(file.path(), kCompareJournal, kParts, scene);
    for (const auto& [number, sweep] : contents.sweeps) {
      Run run;
      run.scene = scene;
      run.sweep = sweep;
      (void)columns_of(run);  // all that is written of it
      std::string words;
      put_sweep(sweep, words);
    }
  });
}

void open_motion_journal(Bytes bytes) {
  const MemoryFile file(with_head(bytes, head_of(kMotionJournal), journal_of(bytes)));
  taken([&] {
    const MotionContents contents = read_motion_journal(file.path(), kParts);
    Network network = ball_on_spring();
    for (const LatticeRefinement& refinement : contents.refinements)
      refine_lattice(refinement, network);
    NetworkState start;
    start.bodies = {{{Eigen::Matrix3d::Identity(), {0, 0, 31}}, {0, 0, 0}, {0, 0, 0}}};
    start.contacts.resize(1);
    start.contacts[0].places.on_A.numbers = {0, 0, -30};
    IntegrationOptions options;
    options.end = 0.02;
    options.interval = 0.001;
    options.tolerance = 1e-5;
    options.most_steps = 500;
    (void)integrate(network, start, options, {}, {contents.stretches, {}, {}});
  });
}

}  // namespace condyle::fuzz
