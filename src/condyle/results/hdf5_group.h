#pragma once

/// A small door to HDF5: groups, datasets with their units, attributes. Every failure throws
/// InputError naming the file and the place in it; nothing of HDF5 is printed. What is read lies in the file itself
/// (hdf5_own_data.h).

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "condyle/results/column_tree.h"
#include "condyle/results/hdf5_handle.h"
#include "condyle/results/hdf5_question.h"
#include "condyle/results/hdf5_shape.h"

namespace condyle {

class Hdf5Process;

struct Hdf5Array {
  std::vector<double> values;  ///< last index fastest
  Shape shape;
};

/// A dataset that is filled by its rows (first index) from the first to the last.
class Hdf5Rows {
 public:
  Hdf5Rows(Hdf5Handle dataset, Shape shape, std::string place)
      : dataset_(std::move(dataset)), shape_(std::move(shape)), place_(std::move(place)) {}
  /// As many whole rows as there are values.
  void append(const std::vector<double>& values);

 private:
  Hdf5Handle dataset_;
  Shape shape_;
  std::size_t row_ = 0;
  std::string place_;
};
/// kOther: nothing that condyle writes, as others may add to a file.
enum class DatasetKind { kNumbers, kIntegers, kTexts, kOther };
inline constexpr std::uint64_t kDatasetKinds = 4;
enum class StoredAs { kFloat64, kFloat32, kInt32, kUint8 };

class Hdf5Group {
 public:
  /// `place` names the group in messages: "run.h5: /sweep".
  Hdf5Group(Hdf5Handle handle, std::string place)
      : handle_(std::move(handle)), place_(std::move(place)) {}
  /// A group of a file that another process holds open, by its number there; it is read and not written.
  Hdf5Group(std::shared_ptr<Hdf5Process> process, std::uint64_t number, std::string place)
      : process_(std::move(process)), number_(number), place_(std::move(place)) {}
  /// A group that is kept in `memory` and written to no file; create, open, has, write and write_attribute know it.
  Hdf5Group(ColumnTree& memory, std::string place) : memory_(&memory), place_(std::move(place)) {}

  [[nodiscard]] Hdf5Group create(const std::string& name) const;
  [[nodiscard]] Hdf5Group open(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] bool has_attribute(const std::string& name) const;
  [[nodiscard]] bool is_group(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names()
      const;  ///< of what it holds, in the order of creation

  void write(const std::string& name,
             const std::vector<double>& values,
             const Shape& shape,
             const std::string& units) const;
  void write(const std::string& name,
             const std::vector<int>& values,
             const Shape& shape,
             const std::string& units) const;
  void write(const std::string& name, const std::vector<std::string>& values) const;
  /// All of it lies in one piece of the file.
  [[nodiscard]] Hdf5Rows create_rows(const std::string& name,
                                     StoredAs type,
                                     const Shape& shape,
                                     const std::string& units) const;
  void write_attribute(const std::string& name, const std::string& text) const;
  /// An attribute of a dataset of this group.
  void write_attribute(const std::string& dataset,
                       const std::string& name,
                       const std::vector<std::string>& texts) const;

  [[nodiscard]] DatasetKind kind(const std::string& name) const;
  [[nodiscard]] Hdf5Array read(const std::string& name) const;
  /// The same, of a shape that must be met.
  [[nodiscard]] std::vector<double> read(const std::string& name, const Shape& shape) const;
  [[nodiscard]] std::vector<int> read_integers(const std::string& name, const Shape& shape) const;
  [[nodiscard]] std::vector<std::string> read_texts(const std::string& name) const;
  [[nodiscard]] std::string read_attribute(const std::string& name) const;
  [[nodiscard]] std::string read_attribute(const std::string& dataset,
                                           const std::string& name) const;

  /// The texts of an attribute of a dataset; none where there is no such attribute.
  [[nodiscard]] std::vector<std::string> read_attribute_texts(const std::string& dataset,
                                                              const std::string& name) const;

  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[nodiscard]] Hdf5Handle checked(std::int64_t id,
                                   Hdf5Handle::Close close,
                                   const std::string& what) const;
  void check(int status, const std::string& what) const;
  struct Hdf5Types {
    std::int64_t in_file, in_memory;
  };
  template <typename Number>
  void write_numbers(const std::string& name,
                     const std::vector<Number>& values,
                     const Shape& shape,
                     const std::string& units,
                     Hdf5Types types) const;
  [[nodiscard]] Hdf5Handle create_dataset(const std::string& name,
                                          std::int64_t type,
                                          const Shape& shape,
                                          const std::string& units,
                                          bool in_one_piece = false) const;
  void attach(const Hdf5Handle& object,
              const std::string& name,
              const std::vector<std::string>& texts,
              bool scalar) const;

  /// That there is something under a name, in this file.
  void check_link(const char* what, const std::string& name) const;
  [[nodiscard]] Hdf5Handle open_dataset(const std::string& name) const;
  [[nodiscard]] std::string read_attribute_of(const Hdf5Handle& object,
                                              const std::string& name) const;

  [[nodiscard]] Hdf5Answer ask(Hdf5Asked kind,
                               const std::string& name,
                               const std::string& attribute = "") const;
  /// The one text that is answered.
  [[nodiscard]] std::string ask_text(Hdf5Asked kind,
                                     const std::string& name,
                                     const std::string& attribute) const;

  Hdf5Handle handle_;
  std::shared_ptr<Hdf5Process> process_;
  std::uint64_t number_ = 0;
  ColumnTree* memory_ = nullptr;
  std::string place_;
};

/// A dataset as it stands in the file.
[[nodiscard]] DataColumn read_column(const Hdf5Group& group, const std::string& name);
/// All numbers and texts that a group holds.
[[nodiscard]] ColumnTree read_columns(const Hdf5Group& group);

}  // namespace condyle
