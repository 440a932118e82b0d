#pragma once

/// Lists of records as datasets of a group, one for each member, side by side: what is said of a member
/// serves writer and reader alike.
///
///     template <class Door>
///     void tell(Door&& door, ...) { door("cost", &CalibrationStart::cost, "1"); ... }
///
/// A member is a number, a whole number, a bool or a text.

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "condyle/results/hdf5_file.h"

namespace condyle {

template <class Record>
class RecordWriter {
 public:
  RecordWriter(const Hdf5Group& group, const std::vector<Record>& records)
      : group_(group), records_(records) {}

  template <class Member>
  void operator()(const char* name, Member Record::*member, const char* units = "1") const {
    using Stored = std::conditional_t<std::is_same_v<Member, bool>, int, Member>;
    std::vector<Stored> values;
    for (const Record& record : records_) values.push_back(static_cast<Stored>(record.*member));
    if constexpr (std::is_same_v<Stored, std::string>)
      group_.write(name, values);
    else
      group_.write(name, values, {values.size()}, units);
  }

 private:
  const Hdf5Group& group_;
  const std::vector<Record>& records_;
};

template <class Record>
class RecordReader {
 public:
  RecordReader(const Hdf5Group& group, std::vector<Record>& records)
      : group_(group), records_(records) {}

  template <class Member>
  void operator()(const char* name, Member Record::*member, const char* /*units*/ = "1") const {
    const auto set = [&](const auto& values) {
      if (values.size() != records_.size())
        group_.fail(std::string("dataset ") + name + " has not one entry for each row");
      for (std::size_t i = 0; i < records_.size(); ++i)
        records_[i].*member = static_cast<Member>(values[i]);
    };
    if constexpr (std::is_same_v<Member, std::string>)
      set(group_.read_texts(name));
    else if constexpr (std::is_same_v<Member, double>)
      set(group_.read(name, {records_.size()}));
    else
      set(group_.read_integers(name, {records_.size()}));
  }

 private:
  const Hdf5Group& group_;
  std::vector<Record>& records_;
};

}  // namespace condyle
