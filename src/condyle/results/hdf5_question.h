#pragma once

/// What one process asks another that holds a file of HDF5 open (hdf5_process.h), and what that answers: one question for each
/// way of reading that a group knows (hdf5_group.h).

#include <cstdint>
#include <string>
#include <vector>

#include "condyle/results/hdf5_shape.h"

namespace condyle {

struct Hdf5Question {
  enum class Kind : std::uint8_t {
    kOpen,            ///< a group: its number
    kHas,             ///< number: 1 or 0
    kHasAttribute,    ///< number: 1 or 0
    kIsGroup,         ///< number: 1 or 0
    kNames,           ///< texts
    kKind,            ///< number: DatasetKind
    kNumbers,         ///< values and shape
    kTexts,           ///< texts
    kAttribute,       ///< of the group: a text
    kAttributeOf,     ///< of a dataset: a text
    kAttributeTexts,  ///< of a dataset: texts
  };
  static constexpr std::uint8_t kKinds = 11;
  Kind kind = Kind::kOpen;
  std::uint64_t group = 0;  ///< number of one that was opened; 0: the root
  std::string name, attribute;
};

using Hdf5Asked = Hdf5Question::Kind;

struct Hdf5Answer {
  std::uint64_t number = 0;
  std::vector<std::string> texts;
  std::vector<double> values;  ///< last index fastest
  Shape shape;
};

}  // namespace condyle
