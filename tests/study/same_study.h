#pragma once

/// Whether two results of studies hold the same bits, but for /provenance.

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>

#include "condyle/input_error.h"
#include "condyle/results/hdf5_file.h"

namespace condyle::test {

inline bool same_bits(const Hdf5Array& a, const Hdf5Array& b) {
  if (a.shape != b.shape) return false;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    if (std::bit_cast<std::uint64_t>(a.values[i]) != std::bit_cast<std::uint64_t>(b.values[i]))
      return false;
  return true;
}

/// A dataset of numbers, or of texts.
inline bool same_dataset(const Hdf5Group& a, const Hdf5Group& b, const std::string& name) {
  try {
    return same_bits(a.read(name), b.read(name));
  } catch (const InputError&) {
    return a.read_texts(name) == b.read_texts(name);
  }
}

/// The first place where they differ; empty: nowhere.
inline std::string difference(const Hdf5Group& a, const Hdf5Group& b, const std::string& place) {
  if (a.names() != b.names()) return place + " has other names";
  for (const std::string& name : a.names()) {
    const std::string here = place + "/" + name;
    if (here == "/provenance") continue;
    std::string found;
    if (a.is_group(name))
      found = difference(a.open(name), b.open(name), here);
    else if (!same_dataset(a, b, name))
      found = here;
    if (!found.empty()) return found;
  }
  return "";
}

inline std::string difference_of_studies(const std::filesystem::path& a,
                                         const std::filesystem::path& b) {
  const Hdf5Reader first(a), second(b);
  return difference(first.root(), second.root(), "");
}

}  // namespace condyle::test
