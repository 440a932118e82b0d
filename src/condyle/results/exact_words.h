#pragma once

/// Structs as words of a journal's line (journal_words.h) and back, to the last bit. A struct is told
/// once, for writer and reader alike, by a function template that hands its members to a door:
///
///     template <class Door, Is<LigamentResult> Value>
///     void members(Door& door, Value& value) { door(value.length, value.strain, value.force); }

#include <Eigen/Core>

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "condyle/math/rigid_transform.h"
#include "condyle/results/journal_words.h"

namespace condyle {

template <class Value, class T>
concept Is = std::same_as<std::remove_const_t<Value>, T>;

/// How many values an enumeration has, which are 0, 1, 2, ...
template <class Enum>
inline constexpr std::size_t kCountOf = 0;

class ExactWriter {
 public:
  explicit ExactWriter(std::string& out) : out_(out) {}

  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }

 private:
  template <class Value>
  void put(const Value& value) {
    if constexpr (std::is_enum_v<Value> || std::same_as<Value, bool>)
      put_word(out_, static_cast<int>(value));
    else if constexpr (std::is_arithmetic_v<Value>)
      put_word(out_, value);
    else
      members(*this, value);
  }
  void put(const std::string& text) {
    put_word(out_, text.size());
    out_ += " \"" + text + '"';
  }
  template <int kRows, int kColumns>
  void put(const Eigen::Matrix<double, kRows, kColumns>& matrix) {
    put_words(out_, matrix.data(), matrix.size());
  }
  template <class Value, std::size_t kSize>
  void put(const std::array<Value, kSize>& values) {
    for (const Value& value : values) put(value);
  }
  template <class Value>
  void put(const std::vector<Value>& values) {
    put_word(out_, values.size());
    for (const Value& value : values) put(value);
  }
  template <class Value>
  void put(const std::optional<Value>& value) {
    put(value.has_value());
    if (value) put(*value);
  }

  std::string& out_;
};

/// Fills what it can; the taker's `ok` tells whether all was there. Counts are believed no further than
/// there are words.
class ExactReader {
 public:
  explicit ExactReader(WordTaker& take) : take_(take) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }

 private:
  template <class Value>
  void get(Value& value) {
    if constexpr (std::is_enum_v<Value>)
      value = static_cast<Value>(take_.index(kCountOf<Value>));
    else if constexpr (std::same_as<Value, bool>)
      value = take_.index(2) == 1;
    else if constexpr (std::is_arithmetic_v<Value>)
      value = take_.number<Value>();
    else
      members(*this, value);
  }
  void get(std::string& text) {
    const auto size = take_.number<std::size_t>();
    const std::string_view rest = take_.rest;
    take_.ok =
        take_.ok && rest.starts_with(" \"") && size < rest.size() - 2 && rest[size + 2] == '"';
    if (!take_.ok) return;
    text = rest.substr(2, size);
    take_.rest.remove_prefix(size + 3);
  }
  template <int kRows, int kColumns>
  void get(Eigen::Matrix<double, kRows, kColumns>& matrix) {
    take_.numbers(matrix.data(), matrix.size());
  }
  template <class Value, std::size_t kSize>
  void get(std::array<Value, kSize>& values) {
    for (Value& value : values) get(value);
  }
  template <class Value>
  void get(std::vector<Value>& values) {
    values.clear();
    const auto size = take_.number<std::size_t>();
    for (std::size_t k = 0; take_.ok && k < size; ++k) get(values.emplace_back());
  }
  template <class Value>
  void get(std::optional<Value>& value) {
    value.reset();
    if (take_.index(2) == 1) get(value.emplace());
  }

  WordTaker& take_;
};

template <class Door, Is<RigidTransform> Value>
void members(Door& door, Value& X) {
  door(X.R, X.p);
}

}  // namespace condyle
