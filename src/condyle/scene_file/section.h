#pragma once

/// One table of a scene file while it is read: typed access to its keys, and errors that name file,
/// line, table, key, value and what was expected. A key nobody asked for is an error in `finish`.

#include <Eigen/Core>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "condyle/scene_file/document.h"

namespace condyle {

/// Where a document came from.
struct Source {
  std::string file;              ///< as messages name it
  std::filesystem::path folder;  ///< relative paths start here
  bool meshes_must_exist = true;
};

enum class Range { kAny, kNotNegative, kPositive };

template <typename T>
using Choices = std::vector<std::pair<std::string, T>>;

class Section {
 public:
  /// `label` names the table in messages: [[ligament]] "aACL". Keys are shown as prefix + key.
  Section(const Value& table, const Source& source, std::string label, std::string prefix = "");

  [[nodiscard]] bool has(const std::string& key) const { return find(key) != nullptr; }
  [[nodiscard]] const Source& source() const { return *source_; }
  [[nodiscard]] const std::string& label() const { return label_; }
  [[nodiscard]] int line() const { return table_->line; }

  // Each throws InputError where the key is missing, of another type, not finite or out of range.
  // `expected` is a noun: "a length", "the name of a body".
  [[nodiscard]] const Value& value(const std::string& key, const std::string& expected) const;
  [[nodiscard]] std::string text(const std::string& key, const std::string& expected) const;
  [[nodiscard]] bool boolean(const std::string& key) const;
  [[nodiscard]] double number(const std::string& key,
                              const std::string& expected,
                              Range range = Range::kAny) const;
  [[nodiscard]] double number_or(const std::string& key,
                                 double otherwise,
                                 const std::string& expected,
                                 Range range = Range::kAny) const;
  [[nodiscard]] std::vector<double> numbers(const std::string& key,
                                            const std::string& expected) const;
  [[nodiscard]] Eigen::Vector3d vector(const std::string& key, const std::string& expected) const;
  [[nodiscard]] std::vector<Eigen::Vector3d> vectors(const std::string& key,
                                                     const std::string& expected) const;
  template <typename T>
  [[nodiscard]] T choice(const std::string& key, const Choices<T>& choices) const;
  /// A table within this one; at the top of a file it is labelled [key].
  [[nodiscard]] Section table(const std::string& key, const std::string& expected) const;
  /// Tables of an inline array.
  [[nodiscard]] std::vector<Section> tables(const std::string& key,
                                            const std::string& expected) const;
  /// [[key]] tables at the top of a file, or [[table.key]] of a table there, each labelled with its
  /// name; empty where there are none.
  [[nodiscard]] std::vector<Section> sections(const std::string& key) const;

  /// Index in `names` of the name that stands at `key`.
  [[nodiscard]] int reference(const std::string& key,
                              const std::string& what,
                              const std::vector<std::string>& names) const;
  [[nodiscard]] int reference(const std::string& key,
                              const Value& name,
                              const std::string& what,
                              const std::vector<std::string>& names) const;

  /// What an error about a key that is there begins with: file, line, table and key.
  [[nodiscard]] std::string place(const std::string& key) const;
  /// "key = value, expected ..."
  [[noreturn]] void fail(const std::string& key, const std::string& expected) const;
  [[noreturn]] void fail(const std::string& key,
                         const Value& value,
                         const std::string& expected) const;
  /// Any other sentence about this table.
  [[noreturn]] void fail_with(const std::string& message) const;

  /// Throws for the first key of the table that was never asked for.
  void finish() const;

 private:
  [[nodiscard]] const Value* find(const std::string& key) const;
  [[nodiscard]] double checked(const std::string& key,
                               const Value& value,
                               const std::string& expected,
                               Range range) const;
  [[nodiscard]] Eigen::Vector3d vector_of(const std::string& key,
                                          const Value& value,
                                          const std::string& expected) const;
  [[nodiscard]] std::string place_at(int line) const;
  [[noreturn]] void fail_at(int line, const std::string& message) const;
  [[noreturn]] void fail_missing(const std::string& key, const std::string& expected) const;
  [[noreturn]] void fail_unknown(const std::string& key, const Value& value) const;

  const Value* table_;
  const Source* source_;
  std::string label_, prefix_;
  mutable std::set<std::string> known_;
};

/// The candidate that was probably meant by `word`, or empty.
[[nodiscard]] std::string nearest(const std::string& word,
                                  const std::vector<std::string>& candidates);

/// "a, b or c", each in quotes; only the first few of a long list.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

template <typename T>
T Section::choice(const std::string& key, const Choices<T>& choices) const {
  std::vector<std::string> names;
  for (const auto& [name, unused] : choices) names.push_back(name);
  return choices[static_cast<std::size_t>(reference(key, "", names))].second;
}

}  // namespace condyle
