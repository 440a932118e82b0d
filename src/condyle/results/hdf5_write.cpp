#include <fmt/format.h>

#include <algorithm>

#include "condyle/input_error.h"
#include "condyle/results/hdf5_calls.h"
#include "condyle/results/hdf5_group.h"

namespace condyle {

using hdf5::count;
using hdf5::property_list;
using hdf5::text_type;
using hdf5::written;

namespace {

Hdf5Handle data_space(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> sizes(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose};
}

// Long data are compressed in pieces of about half a megabyte.
Hdf5Handle creation_properties(const Shape& shape, bool in_one_piece) {
  constexpr std::size_t kLong = 4096, kPiece = 65536;
  Hdf5Handle properties = property_list(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(properties.id(), false);
  if (in_one_piece) H5Pset_fill_time(properties.id(), H5D_FILL_TIME_NEVER);
  if (in_one_piece || count(shape) < kLong || H5Zfilter_avail(H5Z_FILTER_DEFLATE) <= 0)
    return properties;
  std::vector<hsize_t> piece(shape.begin(), shape.end());
  const std::size_t row = count(shape) / shape[0];
  piece[0] = std::clamp<hsize_t>(kPiece / row, 1, piece[0]);
  H5Pset_chunk(properties.id(), static_cast<int>(piece.size()), piece.data());
  H5Pset_shuffle(properties.id());
  H5Pset_deflate(properties.id(), 4);
  return properties;
}

std::vector<const char*> pointers(const std::vector<std::string>& texts) {
  std::vector<const char*> out;
  for (const std::string& text : texts) out.push_back(text.c_str());
  return out;
}

}  // namespace

Hdf5Handle Hdf5Group::create_dataset(const std::string& name,
                                     std::int64_t type,
                                     const Shape& shape,
                                     const std::string& units,
                                     bool in_one_piece) const {
  const Hdf5Handle space = data_space(shape);
  const Hdf5Handle properties = creation_properties(shape, in_one_piece);
  const hid_t id = H5Dcreate2(handle_.id(), name.c_str(), type, space.id(), H5P_DEFAULT,
                              properties.id(), H5P_DEFAULT);
  Hdf5Handle dataset = checked(id, H5Dclose, fmt::format("dataset {} cannot be made", name));
  attach(dataset, "units", {units}, true);
  return dataset;
}

template <typename Number>
void Hdf5Group::write_numbers(const std::string& name,
                              const std::vector<Number>& values,
                              const Shape& shape,
                              const std::string& units,
                              Hdf5Types types) const {
  if (memory_ != nullptr) {
    memory_->add(name, {values, shape, units});
    return;
  }
  const Hdf5Handle dataset = create_dataset(name, types.in_file, shape, units);
  check(values.size() == count(shape) ? 0 : -1,
        fmt::format("dataset {} has not the shape {}", name, written(shape)));
  check(H5Dwrite(dataset.id(), types.in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        name + " cannot be written");
}

void Hdf5Group::write(const std::string& name,
                      const std::vector<double>& values,
                      const Shape& shape,
                      const std::string& units) const {
  write_numbers(name, values, shape, units, {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE});
}

void Hdf5Group::write(const std::string& name,
                      const std::vector<int>& values,
                      const Shape& shape,
                      const std::string& units) const {
  write_numbers(name, values, shape, units, {H5T_STD_I32LE, H5T_NATIVE_INT});
}

void Hdf5Group::write(const std::string& name, const std::vector<std::string>& values) const {
  if (memory_ != nullptr) {
    memory_->add(name, {values, {values.size()}, "1"});
    return;
  }
  const Hdf5Handle type = text_type();
  const Hdf5Handle dataset = create_dataset(name, type.id(), {values.size()}, "1");
  if (values.empty()) return;
  check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers(values).data()),
        name + " cannot be written");
}

Hdf5Rows Hdf5Group::create_rows(const std::string& name,
                                StoredAs type,
                                const Shape& shape,
                                const std::string& units) const {
  const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I32LE, H5T_STD_U8LE};
  return {create_dataset(name, types[static_cast<int>(type)], shape, units, true), shape,
          place_ + name};
}

void Hdf5Rows::append(const std::vector<double>& values) {
  const std::size_t width = count(shape_) / std::max<std::size_t>(shape_[0], 1);
  const std::size_t rows = width == 0 ? 0 : values.size() / width;
  if (rows == 0) return;
  std::vector<hsize_t> start(shape_.size(), 0), size(shape_.begin(), shape_.end());
  start[0] = row_;
  size[0] = rows;
  const Hdf5Handle space(H5Dget_space(dataset_.id()), H5Sclose);
  const Hdf5Handle memory = data_space({values.size()});
  if (row_ + rows > shape_[0] || values.size() != rows * width ||
      H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) <
          0 ||
      H5Dwrite(dataset_.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT,
               values.data()) < 0)
    throw InputError(place_ + ": cannot be written, expected room on the disk");
  row_ += rows;
}

void Hdf5Group::attach(const Hdf5Handle& object,
                       const std::string& name,
                       const std::vector<std::string>& texts,
                       bool scalar) const {
  const Hdf5Handle type = text_type();
  const Hdf5Handle space = data_space(scalar ? Shape{} : Shape{texts.size()});
  const std::string what = fmt::format("attribute {} cannot be written", name);
  const Hdf5Handle attribute = checked(
      H5Acreate2(object.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, what);
  if (!texts.empty()) check(H5Awrite(attribute.id(), type.id(), pointers(texts).data()), what);
}

void Hdf5Group::write_attribute(const std::string& name, const std::string& text) const {
  if (memory_ != nullptr) {
    memory_->attributes[name] = text;
    return;
  }
  attach(handle_, name, {text}, true);
}

void Hdf5Group::write_attribute(const std::string& dataset,
                                const std::string& name,
                                const std::vector<std::string>& texts) const {
  if (memory_ != nullptr) {
    memory_->columns[dataset].attributes[name] = texts;
    return;
  }
  attach(open_dataset(dataset), name, texts, false);
}

}  // namespace condyle
