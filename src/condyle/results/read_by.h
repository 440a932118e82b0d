#pragma once

namespace condyle {

/// Which process has HDF5 read a file: only of one that HDF5 has just written it may be this one (hdf5_process.h).
enum class ReadBy { kProcessOfItsOwn, kThisProcess };

}  // namespace condyle
