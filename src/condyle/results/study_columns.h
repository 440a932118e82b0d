#pragma once

/// What the file of a study says, under its names (docs/results.md), for those who look into it.

#include <filesystem>
#include <memory>
#include <string>

#include "condyle/results/column_tree.h"
#include "condyle/results/file_state.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/read_by.h"
#include "condyle/results/study_file.h"

namespace condyle {

/// All but /outputs is in memory; of these each is read when it is first asked for, since together they may be as large
/// as memory. The file is held open, and may be removed meanwhile.
class StudyColumns {
 public:
  [[nodiscard]] const StudyView& view() const { return view_; }
  /// The tree with what stands at "outputs/aACL.force" read, and of "outputs" all; other places are there.
  [[nodiscard]] const ColumnTree& tree_at(const std::string& place);

 private:
  StudyColumns(const std::filesystem::path& path, ReadBy by);
  friend std::shared_ptr<StudyColumns> open_study(const std::filesystem::path& path, ReadBy by);
  void read_output(const std::string& name);
  void expect_unchanged() const;

  std::filesystem::path path_;
  FileState state_;  // as it was opened
  Hdf5Reader reader_;
  StudyView view_;
  Hdf5Group outputs_;
  ColumnTree columns_;
};

/// Throws InputError for a file that is missing, damaged, or no study; so does tree_at of it where what it reads is damaged, or
/// the file is not as it was when it was opened.
[[nodiscard]] std::shared_ptr<StudyColumns> open_study(const std::filesystem::path& path,
                                                       ReadBy by = ReadBy::kProcessOfItsOwn);

}  // namespace condyle
