#pragma once

/// What the sources about HDF5 share: its lists of properties, types and shapes.

#include <hdf5.h>

#include <cstddef>
#include <string>
#include <type_traits>

#include "condyle/results/hdf5_handle.h"
#include "condyle/results/hdf5_shape.h"

namespace condyle::hdf5 {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

/// Nothing is printed and no plug-in loaded. Before any other call of the library.
void silence();

/// Whether the call that failed last did so for want of memory.
[[nodiscard]] bool lacked_memory();

[[nodiscard]] Hdf5Handle property_list(hid_t kind);
/// Of groups and files that keep the order in which their parts were made, and no times.
[[nodiscard]] Hdf5Handle ordered_group_properties(hid_t kind);
/// Of texts of any length in UTF-8.
[[nodiscard]] Hdf5Handle text_type();

[[nodiscard]] Shape shape_of(const Hdf5Handle& space);
/// How many values a shape holds, and "[3, 4]".
[[nodiscard]] std::size_t count(const Shape& shape);
[[nodiscard]] std::string written(const Shape& shape);

}  // namespace condyle::hdf5
