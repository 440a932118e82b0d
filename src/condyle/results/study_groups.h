#pragma once

/// Groups of a study's file that tell what its samples say: /bands, /indices, /failures, and the same
/// below /knees/NAME. p poses, d parameters.

#include <string>

#include "condyle/results/hdf5_file.h"
#include "condyle/study/study_summary.h"

namespace condyle {

struct StudyView;

inline constexpr const char* kStudyFormat = "condyle study 1";

/// Throws InputError for the root of a file that is no study.
[[nodiscard]] StudyView read_study_in(const Hdf5Group& root);

void write_band(const Hdf5Group& bands,
                const std::string& output,
                const StudyBand& band,
                const std::string& units);
void write_effects(const Hdf5Group& indices,
                   const std::string& output,
                   const StudyEffects& effects);
void write_failures(const Hdf5Group& group, const StudyFailures& failures);

[[nodiscard]] StudyBand read_band(const Hdf5Group& bands,
                                  const std::string& output,
                                  std::size_t poses);
[[nodiscard]] StudyEffects read_effects(const Hdf5Group& indices,
                                        const std::string& output,
                                        std::size_t parameters,
                                        std::size_t poses);
[[nodiscard]] StudyFailures read_failures(const Hdf5Group& group,
                                          std::size_t parameters,
                                          std::size_t poses);

}  // namespace condyle
