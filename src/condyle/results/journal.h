#pragma once

/// The journal of a sweep under way: a text file beside the result file, with a line for each pose,
/// written as soon as the pose is known. A run that is killed leaves it behind, and a later one
/// goes on from it.
///
///     condyle journal 1 scene HASH surfaces HASH
///     pose VALUE VISIT STATUS ITERATIONS RESIDUAL SECONDS  R (9, by columns) a (3)
///          n σ ...  n {contact p point_ground point_moving} ...
///          FROM n {value kind contact} ...  "REASON" "REMARK" LENGTH ELSEWHERE HASH
///
/// (one line each). Numbers in mm, N, N mm, rad, s, with as many digits as say them exactly; FROM
/// is nan where the events before the pose are not known, LENGTH is that of the remark in bytes,
/// ELSEWHERE 1 where the pose was not found from the one before it. The hash is that of the line
/// before it, so a line that was torn is known as such; what follows a torn line is not read.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/equilibrium/known_poses.h"
#include "condyle/results/line_file.h"
#include "condyle/results/run_identity.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// "RUN.h5.journal"
[[nodiscard]] std::filesystem::path journal_path(const std::filesystem::path& run);

struct JournalContents {
  bool started = false;  ///< the head is there
  RunIdentity identity;
  std::vector<KnownPose> poses;
  std::size_t whole_bytes = 0;  ///< up to the end of the last whole line
};

/// What a journal holds, nothing where there is none. Throws InputError for a file that is no
/// journal, of another format, or names a contact or condition that the scene does not have.
[[nodiscard]] JournalContents read_journal(const std::filesystem::path& path, const Scene& scene);

class Journal {
 public:
  /// Goes on after the first `kept_bytes` of a journal, or with 0 starts a new one. The file is taken before
  /// it is read (line_file.h) and stays. Throws InputError where it cannot be written.
  Journal(LineFile& file, const RunIdentity& identity, std::size_t kept_bytes);

  /// One line, in one write. The first failure ends the journal and is kept in `failure`.
  void append(const KnownPose& known);
  [[nodiscard]] const std::string& failure() const { return file_.failure(); }

  /// The run is complete: the journal is no longer needed.
  void remove() { file_.remove(); }

 private:
  LineFile& file_;
  std::string head_;  ///< as long as it is not written: with the first pose
  std::string line_;
};

}  // namespace condyle
