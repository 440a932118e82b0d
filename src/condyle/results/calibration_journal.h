#pragma once

/// The journal (journal_file.h) of a calibration under way: the best numbers so far, a line each time
/// that better ones are found.
///
///     condyle calibration 1 scene HASH surfaces HASH table HASH
///     best COST θ1 θ2 ... HASH
///
/// θ in mm, rad and 1, with as many digits as say them exactly; the hash at the end is hexadecimal.

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>

#include "condyle/results/journal_file.h"

namespace condyle {

struct CalibrationIdentity {
  RunIdentity run;
  std::uint64_t table = 0;  ///< hash of the bytes of the measurements
};

[[nodiscard]] CalibrationIdentity calibration_identity(const Scene& scene,
                                                       const std::vector<FittedSurface>& surfaces);

struct CalibrationContents {
  std::optional<Eigen::VectorXd> best;  ///< θ of the least cost
  std::size_t whole_bytes = 0;          ///< up to the end of the last whole line
};

/// What a journal holds, nothing where there is none. Throws InputError for a file that is no such
/// journal, and, naming which, where scene, patches or table are not these.
[[nodiscard]] CalibrationContents read_calibration_journal(const std::filesystem::path& path,
                                                           const CalibrationIdentity& identity,
                                                           const Scene& scene);

/// Throws InputError where something else than a journal of a calibration stands at `path`.
void expect_calibration_journal(const std::filesystem::path& path);

class CalibrationJournal : public JournalLines {
 public:
  CalibrationJournal(LineFile& file, const CalibrationIdentity& identity, std::size_t kept_bytes);

  void append(const Eigen::VectorXd& theta, double cost);
};

}  // namespace condyle
