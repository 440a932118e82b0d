#include "condyle/results/hdf5_own_data.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <new>
#include <utility>

#include "condyle/results/hdf5_calls.h"
#include "condyle/results/hdf5_handle.h"

namespace condyle {
namespace {

constexpr double kMostPacking = 1100;   // deflate: 1032, and what stands around it
constexpr double kMostOfNothing = 1e6;  // rows: no scene has so many parts

double product(const std::vector<hsize_t>& sizes) {
  double all = 1;
  for (const hsize_t size : sizes) all *= static_cast<double>(size);
  return all;
}

/// Bytes of all values, or of one chunk where that is more. The space of a virtual dataset is not asked: it is made of
/// other files.
double declared_bytes(hid_t dataset, const Hdf5Handle& properties) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  std::vector<hsize_t> sizes(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr);
  double most = product(sizes);
  if (most > 0 && H5Pget_layout(properties.id()) == H5D_CHUNKED &&
      H5Pget_chunk(properties.id(), rank, sizes.data()) == rank)
    most = std::max(most, product(sizes));
  return most * static_cast<double>(H5Tget_size(type.id()));
}

/// Of a dataset without values how many rows, or columns, it says to have.
double declared_rows_of_nothing(hid_t dataset) {
  const Shape sizes = hdf5::shape_of(Hdf5Handle(H5Dget_space(dataset), H5Sclose));
  const bool is_empty = std::find(sizes.begin(), sizes.end(), 0U) != sizes.end();
  return is_empty ? static_cast<double>(*std::max_element(sizes.begin(), sizes.end())) : 0;
}

/// The first filter that is not built in.
std::string missing_filter(const Hdf5Handle& properties) {
  const int filters = H5Pget_nfilters(properties.id());
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0;
    std::size_t numbers = 0;
    const H5Z_filter_t filter = H5Pget_filter2(properties.id(), static_cast<unsigned>(i), &flags,
                                               &numbers, nullptr, 0, nullptr, nullptr);
    if (filter < 0 || H5Zfilter_avail(filter) <= 0)
      return fmt::format("is packed by filter {}, a plug-in, expected deflate or none", filter);
  }
  return "";
}

}  // namespace

std::string foreign_link(std::int64_t group, const std::string& name) {
  H5L_info_t info;
  if (H5Lget_info(group, name.c_str(), &info, H5P_DEFAULT) < 0) return "cannot be found";
  switch (info.type) {
    case H5L_TYPE_HARD:
      return "";
    case H5L_TYPE_SOFT:
      return "is a soft link, expected what it names";
    case H5L_TYPE_EXTERNAL:
      return "is a link into another file, expected what it names";
    default:
      return "is a link of an unknown kind, expected what it names";
  }
}

std::string foreign_storage(std::int64_t dataset) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(properties.id()) == H5D_VIRTUAL)
    return "is made of datasets of other files, expected its values";
  if (H5Pget_external_count(properties.id()) > 0)
    return "lies in another file, expected its values";
  if (declared_rows_of_nothing(dataset) > kMostOfNothing)
    return "declares many rows of nothing, expected rows that hold something";
  std::string filter = missing_filter(properties);
  if (!filter.empty()) return filter;
  const double declared = declared_bytes(dataset, properties);
  const double stored = static_cast<double>(H5Dget_storage_size(dataset));
  if (declared > kMostPacking * stored)
    return fmt::format(
        "declares {:.4g} bytes, expected no more than the {:.0f} that it stores can hold", declared,
        stored);
  return "";
}

TextMemory::TextMemory(std::int64_t dataset) {
  const Hdf5Handle file(H5Iget_file_id(dataset), H5Fclose);
  hsize_t size = 0;
  if (H5Fget_filesize(file.id(), &size) >= 0) left_ = static_cast<std::size_t>(size);
}

void* TextMemory::allocate(std::size_t size, void* memory) {
  auto& self = *static_cast<TextMemory*>(memory);
  if (size > self.left_) return nullptr;
  std::unique_ptr<char[]> piece(new (std::nothrow) char[size]);
  if (piece == nullptr) return nullptr;
  self.left_ -= size;
  self.pieces_.push_back(std::move(piece));
  return self.pieces_.back().get();
}

void TextMemory::keep(void*, void*) {}

unsigned links_to(std::int64_t object) {
#if H5_VERSION_GE(1, 12, 0)
  H5O_info2_t info{};
  return H5Oget_info3(object, &info, H5O_INFO_BASIC) < 0 ? 0 : info.rc;
#else
  H5O_info_t info{};
  return H5Oget_info2(object, &info, H5O_INFO_BASIC) < 0 ? 0 : info.rc;
#endif
}

}  // namespace condyle
