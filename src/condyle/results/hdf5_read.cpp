#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/results/hdf5_calls.h"
#include "condyle/results/hdf5_group.h"
#include "condyle/results/hdf5_own_data.h"

namespace condyle {

using hdf5::count;
using hdf5::property_list;
using hdf5::shape_of;
using hdf5::text_type;
using hdf5::written;

Hdf5Handle Hdf5Group::open_dataset(const std::string& name) const {
  check_link("dataset", name);
  const hid_t id = H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT);
  Hdf5Handle dataset = checked(id, H5Dclose, fmt::format("{} is no dataset", name));
  const std::string foreign = foreign_storage(dataset.id());
  if (!foreign.empty()) fail(fmt::format("dataset {} {}", name, foreign));
  return dataset;
}

DatasetKind Hdf5Group::kind(const std::string& name) const {
  if (process_) {
    const std::uint64_t kind = ask(Hdf5Asked::kKind, name).number;
    return kind < kDatasetKinds ? static_cast<DatasetKind>(kind) : DatasetKind::kOther;
  }
  const Hdf5Handle dataset = open_dataset(name);
  const Hdf5Handle type(H5Dget_type(dataset.id()), H5Tclose);
  const H5T_class_t of = H5Tget_class(type.id());
  if (of == H5T_FLOAT) return DatasetKind::kNumbers;
  if (of == H5T_STRING && H5Tis_variable_str(type.id()) > 0) return DatasetKind::kTexts;
  if (of != H5T_INTEGER) return DatasetKind::kOther;
  const bool fits = H5Tget_size(type.id()) + (H5Tget_sign(type.id()) == H5T_SGN_NONE ? 1 : 0) <= 4;
  return fits ? DatasetKind::kIntegers : DatasetKind::kNumbers;
}

Hdf5Array Hdf5Group::read(const std::string& name) const {
  if (process_) {
    Hdf5Answer answer = ask(Hdf5Asked::kNumbers, name);
    if (count(answer.shape) != answer.values.size())
      fail(fmt::format("dataset {} cannot be read as numbers", name));
    return {std::move(answer.values), std::move(answer.shape)};
  }
  const Hdf5Handle dataset = open_dataset(name);
  const Hdf5Handle space(H5Dget_space(dataset.id()), H5Sclose);
  Hdf5Array array;
  array.shape = shape_of(space);
  array.values.resize(count(array.shape));
  check(
      H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()),
      fmt::format("dataset {} cannot be read as numbers", name));
  return array;
}

std::vector<double> Hdf5Group::read(const std::string& name, const Shape& shape) const {
  Hdf5Array array = read(name);
  if (array.shape != shape) {
    fail(fmt::format("dataset {} has shape {}, expected {}", name, written(array.shape),
                     written(shape)));
  }
  return std::move(array.values);
}

std::vector<int> Hdf5Group::read_integers(const std::string& name, const Shape& shape) const {
  const std::vector<double> values = read(name, shape);
  const auto whole = [](double value) {
    return std::trunc(value) == value && std::abs(value) < 2e9;
  };
  if (!std::all_of(values.begin(), values.end(), whole))
    fail(fmt::format("dataset {} does not hold whole numbers", name));
  return {values.begin(), values.end()};
}

std::vector<std::string> Hdf5Group::read_texts(const std::string& name) const {
  if (process_) return ask(Hdf5Asked::kTexts, name).texts;
  const Hdf5Handle dataset = open_dataset(name);
  const Hdf5Handle space(H5Dget_space(dataset.id()), H5Sclose);
  const Hdf5Handle type = text_type();
  std::vector<char*> raw(count(shape_of(space)), nullptr);
  if (raw.empty()) return {};
  TextMemory memory(dataset.id());
  const Hdf5Handle transfer = property_list(H5P_DATASET_XFER);
  H5Pset_vlen_mem_manager(transfer.id(), TextMemory::allocate, &memory, TextMemory::keep, &memory);
  check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, transfer.id(), raw.data()),
        fmt::format("dataset {} cannot be read as texts", name));
  std::vector<std::string> texts;
  for (const char* text : raw) texts.emplace_back(text == nullptr ? "" : text);
  return texts;
}

std::string Hdf5Group::read_attribute(const std::string& name) const {
  if (process_) return ask_text(Hdf5Asked::kAttribute, "", name);
  return read_attribute_of(handle_, name);
}

std::string Hdf5Group::read_attribute(const std::string& dataset, const std::string& name) const {
  if (process_) return ask_text(Hdf5Asked::kAttributeOf, dataset, name);
  return read_attribute_of(open_dataset(dataset), name);
}

std::vector<std::string> Hdf5Group::read_attribute_texts(const std::string& dataset,
                                                         const std::string& name) const {
  if (process_) return ask(Hdf5Asked::kAttributeTexts, dataset, name).texts;
  const Hdf5Handle object = open_dataset(dataset);
  if (H5Aexists(object.id(), name.c_str()) <= 0) return {};
  const Hdf5Handle attribute =
      checked(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), H5Aclose,
              fmt::format("attribute {} of {} cannot be opened", name, dataset));
  const Hdf5Handle type = text_type();
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  std::vector<char*> raw(count(shape_of(space)), nullptr);
  if (raw.empty()) return {};
  check(H5Aread(attribute.id(), type.id(), raw.data()),
        fmt::format("attribute {} of {} cannot be read as texts", name, dataset));
  std::vector<std::string> texts;
  for (const char* text : raw) texts.emplace_back(text == nullptr ? "" : text);
  H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, raw.data());
  return texts;
}

std::string Hdf5Group::read_attribute_of(const Hdf5Handle& object, const std::string& name) const {
  const hid_t id = H5Aexists(object.id(), name.c_str()) > 0
                       ? H5Aopen(object.id(), name.c_str(), H5P_DEFAULT)
                       : -1;
  const Hdf5Handle attribute = checked(id, H5Aclose, fmt::format("attribute {} is missing", name));
  const Hdf5Handle type = text_type();
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  char* raw = nullptr;
  const Shape shape = shape_of(space);
  const bool one =
      std::all_of(shape.begin(), shape.end(), [](std::size_t size) { return size == 1; });
  check(one ? H5Aread(attribute.id(), type.id(), &raw) : -1,
        fmt::format("attribute {} cannot be read, expected a text: the file is damaged", name));
  std::string text = raw == nullptr ? "" : raw;
  H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, &raw);
  return text;
}

DataColumn read_column(const Hdf5Group& group, const std::string& name) {
  DataColumn column;
  for (std::string& units : group.read_attribute_texts(name, "units"))
    column.units = std::move(units);
  std::vector<std::string> meanings = group.read_attribute_texts(name, "meaning");
  if (!meanings.empty()) column.attributes["meaning"] = std::move(meanings);
  const DatasetKind kind = group.kind(name);
  if (kind == DatasetKind::kTexts) {
    std::vector<std::string> texts = group.read_texts(name);
    column.shape = {texts.size()};
    column.values = std::move(texts);
    return column;
  }
  Hdf5Array array = group.read(name);
  column.shape = array.shape;
  if (kind == DatasetKind::kIntegers)
    column.values = group.read_integers(name, array.shape);
  else
    column.values = std::move(array.values);
  return column;
}

namespace {

/// A damaged file may say that a group has one place and have it within itself.
ColumnTree read_columns_within(const Hdf5Group& group, int depth, long& groups) {
  constexpr int kDeepest = 16;
  constexpr long kMostGroups = 200000;
  if (depth > kDeepest || ++groups > kMostGroups)
    group.fail(fmt::format("groups lie {} deep, expected at most {}, and {} in all", depth,
                           kDeepest, kMostGroups));
  ColumnTree tree;
  for (const std::string& name : group.names()) {
    if (group.is_group(name)) {
      tree.make_group(name) = read_columns_within(group.open(name), depth + 1, groups);
    } else if (group.kind(name) != DatasetKind::kOther) {
      tree.add(name, read_column(group, name));
    }
  }
  return tree;
}

}  // namespace

ColumnTree read_columns(const Hdf5Group& group) {
  long groups = 0;
  return read_columns_within(group, 0, groups);
}

}  // namespace condyle
