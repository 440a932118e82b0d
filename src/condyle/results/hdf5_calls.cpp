#include "condyle/results/hdf5_calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace condyle::hdf5 {

// What a full disk kept it from closing it would try to close again
/// when the program ends, through pointers to memory that is gone (1.10).
void silence() {
  static const bool once = H5dont_atexit() >= 0;
  static_cast<void>(once);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);  // no filter is loaded from a file of code
}

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

Hdf5Handle ordered_group_properties(hid_t kind) {
  Hdf5Handle properties = property_list(kind);
  H5Pset_link_creation_order(properties.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(properties.id(), false);
  return properties;
}

Hdf5Handle text_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

Shape shape_of(const Hdf5Handle& space) {
  std::vector<hsize_t> sizes(
      static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr);
  return {sizes.begin(), sizes.end()};
}

std::size_t count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::string written(const Shape& shape) { return fmt::format("[{}]", fmt::join(shape, ", ")); }

}  // namespace condyle::hdf5
