#pragma once

/// A TOML file as a plain tree that remembers on which line each value stands. toml++ stays behind
/// this door.

#include <string>
#include <vector>

namespace condyle {

struct Value {
  enum class Type { kBoolean, kInteger, kNumber, kText, kArray, kTable, kDate };
  Type type = Type::kTable;
  int line = 1;  ///< in the file, from 1
  int column = 0,
      end = 0;  ///< on it, the first character and the one behind the last, from 1 [code
                ///< points]; of tables and arrays, which may end elsewhere, of no use
  bool boolean = false;
  double number = 0;  ///< integers too
  std::string text;
  std::vector<Value> items;       ///< of an array, or of a table in the order of `keys`
  std::vector<std::string> keys;  ///< tables only

  [[nodiscard]] bool is_number() const { return type == Type::kInteger || type == Type::kNumber; }
  /// The entry of a table, or null.
  [[nodiscard]] const Value* find(const std::string& key) const;
};

/// Throws InputError with `file` and line for text that is not TOML.
[[nodiscard]] Value parse_document(const std::string& text, const std::string& file);

/// The value as it could stand in the file, on one line, shortened where long.
[[nodiscard]] std::string to_text(const Value& value);

}  // namespace condyle
