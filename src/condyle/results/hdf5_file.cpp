#include "condyle/results/hdf5_file.h"

#include <new>
#include <utility>

#include "condyle/file_ending.h"
#include "condyle/input_error.h"
#include "condyle/results/hdf5_answers.h"
#include "condyle/results/hdf5_calls.h"

namespace condyle {

Hdf5Builder::Hdf5Builder(const std::string& file) : name_(file) {
  hdf5::silence();
  constexpr std::size_t kGrowth = 1 << 22;
  const Hdf5Handle access = hdf5::property_list(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access.id(), kGrowth, false);
  const Hdf5Handle creation = hdf5::ordered_group_properties(H5P_FILE_CREATE);
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

Hdf5DiskFile::Hdf5DiskFile(const std::filesystem::path& file, std::string named)
    : name_(std::move(named)) {
  hdf5::silence();
  const Hdf5Handle creation = hdf5::ordered_group_properties(H5P_FILE_CREATE);
  file_ = Hdf5Handle(H5Fcreate(file.c_str(), H5F_ACC_EXCL, creation.id(), H5P_DEFAULT), H5Fclose);
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

namespace {

void check_plain_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError(name + ": is a folder, expected a run (HDF5)");
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(
        name + (std::filesystem::exists(file, error) ? ": is no plain file" : ": no such file") +
        ", expected a run (HDF5)");
  if (file_ending(file) == ".toml")
    throw InputError(name +
                     ": is a scene (TOML), expected a run (HDF5), as condyle sweep writes it");
}

Hdf5Handle opened(const std::string& name) {
  hdf5::silence();
  Hdf5Handle file(H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (file.id() < 0 && hdf5::lacked_memory()) throw std::bad_alloc();
  if (file.id() < 0)
    throw InputError(name + ": cannot be opened, expected a run (HDF5), whole and readable");
  return file;
}

Hdf5Group root_of(const Hdf5Handle& file, const std::string& name) {
  return {Hdf5Handle(H5Gopen2(file.id(), "/", H5P_DEFAULT), H5Gclose), name + ": /"};
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file, ReadBy by) : name_(file.string()) {
  check_plain_file(file);
  if (by == ReadBy::kThisProcess) {
    file_ = opened(name_);
    return;
  }
  process_ = std::make_shared<Hdf5Process>(file, [&] {
    file_ = opened(name_);
    return answers_of(root_of(file_, name_));
  });
}

Hdf5Group Hdf5Reader::root() const {
  return process_ ? Hdf5Group(process_, 0, name_ + ": /") : root_of(file_, name_);
}

}  // namespace condyle
