#pragma once

/// The journal (journal_file.h) of a sweep under way, with a line for each pose, written as soon as the
/// pose is known.
///
///     condyle journal 1 scene HASH surfaces HASH
///     pose VALUE VISIT STATUS ITERATIONS RESIDUAL SECONDS  R (9, by columns) a (3)
///          n σ ...  n {contact p point_ground point_moving} ...
///          FROM n {value kind contact} ...  "REASON" "REMARK" LENGTH ELSEWHERE HASH
///
/// (one line each). Numbers in mm, N, N mm, rad, s, with as many digits as say them exactly; FROM
/// is nan where the events before the pose are not known, LENGTH is that of the remark in bytes,
/// ELSEWHERE is 1 where the pose was not found from the one before it, 2 more where it is open: not found, and not looked
/// for yet from a later one. Another line of that pose follows then, and of two lines of a pose the later one holds.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/equilibrium/known_poses.h"
#include "condyle/results/journal_file.h"
#include "condyle/results/run_identity.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct JournalContents {
  bool started = false;  ///< the head is there
  RunIdentity identity;
  std::vector<KnownPose> poses;
  std::size_t whole_bytes = 0;  ///< up to the end of the last whole line
};

/// What a journal holds, nothing where there is none. Throws InputError for a file that is no
/// journal, of another format, or names a contact or condition that the scene does not have.
[[nodiscard]] JournalContents read_journal(const std::filesystem::path& path, const Scene& scene);

class Journal : public JournalLines {
 public:
  Journal(LineFile& file, const RunIdentity& identity, std::size_t kept_bytes);

  void append(const KnownPose& known);

 private:
  std::string line_;
};

}  // namespace condyle
