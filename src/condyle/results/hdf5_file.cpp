#include "condyle/results/hdf5_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <numeric>
#include <type_traits>

#include "condyle/input_error.h"
#include "condyle/results/hdf5_own_data.h"

namespace condyle {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

/// Before any other call of the library. What a full disk kept it from closing it would try to close again
/// when the program ends, through pointers to memory that is gone (1.10).
void silence() {
  static const bool once = H5dont_atexit() >= 0;
  static_cast<void>(once);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  load_no_plugins();
}

std::size_t count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::string written(const Shape& shape) { return fmt::format("[{}]", fmt::join(shape, ", ")); }

/// Whether the call that failed last did so for want of memory.
bool lacked_memory() {
  const auto look = [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
    if (error->maj_num == H5E_RESOURCE &&
        (error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC))
      *static_cast<bool*>(found) = true;
    return 0;
  };
  bool found = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &found);
  return found;
}

Hdf5Handle property_list(hid_t kind) { return {H5Pcreate(kind), H5Pclose}; }

Hdf5Handle text_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

Hdf5Handle data_space(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> sizes(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose};
}

Shape shape_of(const Hdf5Handle& space) {
  std::vector<hsize_t> sizes(
      static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr);
  return {sizes.begin(), sizes.end()};
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

Hdf5Handle ordered_group_properties(hid_t kind) {
  Hdf5Handle properties = property_list(kind);
  H5Pset_link_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(properties.id(), false);
  return properties;
}

}  // namespace

void Hdf5Group::fail(const std::string& message) const {
  if (lacked_memory()) throw std::bad_alloc();
  throw InputError(fmt::format("{}: {}", place_, message));
}

Hdf5Handle Hdf5Group::checked(std::int64_t id,
                              Hdf5Handle::Close close,
                              const std::string& what) const {
  if (id < 0) fail(what);
  return {id, close};
}

void Hdf5Group::check(int status, const std::string& what) const {
  if (status < 0) fail(what);
}

Hdf5Group Hdf5Group::create(const std::string& name) const {
  if (memory_ != nullptr) return {memory_->make_group(name), place_ + name + "/"};
  const Hdf5Handle properties = ordered_group_properties(H5P_GROUP_CREATE);
  const hid_t id =
      H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT);
  return {checked(id, H5Gclose, fmt::format("group {} cannot be made", name)), place_ + name + "/"};
}

Hdf5Group Hdf5Group::open(const std::string& name) const {
  if (memory_ != nullptr) return {memory_->make_group(name), place_ + name + "/"};
  check_link("group", name);
  const hid_t id = H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT);
  return {checked(id, H5Gclose, fmt::format("{} is no group", name)), place_ + name + "/"};
}

bool Hdf5Group::has(const std::string& name) const {
  if (memory_ != nullptr)
    return memory_->group(name) != nullptr || memory_->column(name) != nullptr;
  return H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5Group::has_attribute(const std::string& name) const {
  return H5Aexists(handle_.id(), name.c_str()) > 0;
}

void Hdf5Group::check_link(const char* what, const std::string& name) const {
  if (!has(name)) fail(fmt::format("{} {} is missing", what, name));
  const std::string foreign = foreign_link(handle_.id(), name);
  if (!foreign.empty()) fail(fmt::format("{} {}", name, foreign));
}

bool Hdf5Group::is_group(const std::string& name) const {
  check_link("group", name);
  const Hdf5Handle object(H5Oopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Oclose);
  return H5Iget_type(object.id()) == H5I_GROUP;
}

std::vector<std::string> Hdf5Group::names() const {
  std::vector<std::string> out;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Literate(handle_.id(), H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add, &out) >= 0)
    return out;
  out.clear();  // written by a program that keeps no order of creation
  check(H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &out),
        "cannot be listed");
  return out;
}

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

void Hdf5Group::write(const std::string& name,
                      const std::vector<double>& values,
                      const Shape& shape,
                      const std::string& units) const {
  if (memory_ != nullptr) {
    memory_->add(name, {values, shape, units});
    return;
  }
  const Hdf5Handle dataset = create_dataset(name, H5T_IEEE_F64LE, shape, units);
  check(values.size() == count(shape) ? 0 : -1,
        fmt::format("dataset {} has not the shape {}", name, written(shape)));
  check(H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        name + " cannot be written");
}

void Hdf5Group::write(const std::string& name,
                      const std::vector<int>& values,
                      const Shape& shape,
                      const std::string& units) const {
  if (memory_ != nullptr) {
    memory_->add(name, {values, shape, units});
    return;
  }
  const Hdf5Handle dataset = create_dataset(name, H5T_STD_I32LE, shape, units);
  check(values.size() == count(shape) ? 0 : -1,
        fmt::format("dataset {} has not the shape {}", name, written(shape)));
  check(H5Dwrite(dataset.id(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        name + " cannot be written");
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

Hdf5Handle Hdf5Group::open_dataset(const std::string& name) const {
  check_link("dataset", name);
  const hid_t id = H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT);
  Hdf5Handle dataset = checked(id, H5Dclose, fmt::format("{} is no dataset", name));
  const std::string foreign = foreign_storage(dataset.id());
  if (!foreign.empty()) fail(fmt::format("dataset {} {}", name, foreign));
  return dataset;
}

Hdf5Array Hdf5Group::read(const std::string& name) const {
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
  return read_attribute_of(handle_, name);
}

std::string Hdf5Group::read_attribute(const std::string& dataset, const std::string& name) const {
  return read_attribute_of(open_dataset(dataset), name);
}

std::vector<std::string> Hdf5Group::read_attribute_texts(const std::string& dataset,
                                                         const std::string& name) const {
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
        fmt::format("attribute {} cannot be read as a text", name));
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

DatasetKind Hdf5Group::kind(const std::string& name) const {
  const Hdf5Handle dataset = open_dataset(name);
  const Hdf5Handle type(H5Dget_type(dataset.id()), H5Tclose);
  const H5T_class_t of = H5Tget_class(type.id());
  if (of == H5T_FLOAT) return DatasetKind::kNumbers;
  if (of == H5T_STRING && H5Tis_variable_str(type.id()) > 0) return DatasetKind::kTexts;
  if (of != H5T_INTEGER) return DatasetKind::kOther;
  const bool fits = H5Tget_size(type.id()) + (H5Tget_sign(type.id()) == H5T_SGN_NONE ? 1 : 0) <= 4;
  return fits ? DatasetKind::kIntegers : DatasetKind::kNumbers;
}

ColumnTree read_columns(const Hdf5Group& group) {
  ColumnTree tree;
  for (const std::string& name : group.names()) {
    if (group.is_group(name)) {
      tree.make_group(name) = read_columns(group.open(name));
    } else if (group.kind(name) != DatasetKind::kOther) {
      tree.add(name, read_column(group, name));
    }
  }
  return tree;
}

Hdf5Builder::Hdf5Builder(const std::string& file) : name_(file) {
  silence();
  constexpr std::size_t kGrowth = 1 << 22;
  const Hdf5Handle access = property_list(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access.id(), kGrowth, false);
  const Hdf5Handle creation = ordered_group_properties(H5P_FILE_CREATE);
  file_ = Hdf5Handle(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
  if (file_.id() < 0) throw std::bad_alloc();
}

Hdf5Group Hdf5Builder::root() const {
  return {Hdf5Handle(H5Gopen2(file_.id(), "/", H5P_DEFAULT), H5Gclose), name_ + ": /"};
}

std::string Hdf5Builder::bytes() const {
  const bool flushed = H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = flushed ? H5Fget_file_image(file_.id(), nullptr, 0) : -1;
  if (size < 0) throw std::bad_alloc();  // nothing else can fail there
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file_.id(), image.data(), image.size()) != size) throw std::bad_alloc();
  return image;
}

Hdf5DiskFile::Hdf5DiskFile(const std::filesystem::path& file) : name_(file.string()) {
  silence();
  const Hdf5Handle creation = ordered_group_properties(H5P_FILE_CREATE);
  file_ = Hdf5Handle(H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, creation.id(), H5P_DEFAULT), H5Fclose);
  if (file_.id() < 0) throw InputError(name_ + ": cannot be written");
}

Hdf5Group Hdf5DiskFile::root() const {
  return {Hdf5Handle(H5Gopen2(file_.id(), "/", H5P_DEFAULT), H5Gclose), name_ + ": /"};
}

void Hdf5DiskFile::close() {
  const bool flushed = H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0;
  if (!file_.close_now() || !flushed)
    throw InputError(name_ + ": cannot be written, expected room on the disk");
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : name_(file.string()) {
  silence();
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError(name_ + ": is a folder, expected a run (HDF5)");
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(name_ + ": no such file, expected a run (HDF5)");
  if (file.extension() == ".toml")
    throw InputError(name_ +
                     ": is a scene (TOML), expected a run (HDF5), as condyle sweep writes it");
  file_ = Hdf5Handle(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (file_.id() < 0 && lacked_memory()) throw std::bad_alloc();
  if (file_.id() < 0)
    throw InputError(name_ + ": cannot be opened, expected a run (HDF5), whole and readable");
}

Hdf5Group Hdf5Reader::root() const {
  return {Hdf5Handle(H5Gopen2(file_.id(), "/", H5P_DEFAULT), H5Gclose), name_ + ": /"};
}

}  // namespace condyle
