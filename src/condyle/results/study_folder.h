#pragma once

/// The folder of a study's journals, and who may use it: a whole run alone (exclusive lock on `lock`), or
/// runs of parts at the same time (shared on `lock`, exclusive on one file a part).

#include <filesystem>
#include <string>
#include <vector>

namespace condyle {

/// Part i of n, 1 <= i <= n: the chunks c with c % n == i - 1.
struct StudyPart {
  int i = 1, n = 1;
  [[nodiscard]] bool whole() const { return n == 1; }
};

class StudyFolder {
 public:
  /// Makes it where there is none. Throws InputError where another run holds it, or where something
  /// else stands there.
  StudyFolder(std::filesystem::path folder, StudyPart part);
  /// Without any lock: another process of the same team has it.
  explicit StudyFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;
  ~StudyFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  /// In the order of their names.
  [[nodiscard]] std::vector<std::filesystem::path> journals() const;
  /// Journals whose names begin so.
  void remove_journals(const std::string& prefix) const;
  void remove() const;

 private:
  void make();
  void expect_study() const;
  int lock(const std::string& name, int how, const std::string& refusal);

  std::filesystem::path folder_;
  std::vector<int> locks_;
};

}  // namespace condyle
