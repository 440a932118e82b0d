#pragma once

/// How this library was built, for whoever is told that it misbehaves.

#include <string>
#include <vector>

namespace condyle {

struct BuiltWith {
  std::string name;     ///< "HDF5"
  std::string version;  ///< of its headers, as CMake found them
};

struct BuildInfo {
  std::string version;     ///< "0.1.0", as CONDYLE_VERSION of version.h
  std::string made_by;     ///< "cmake", "Debian package" or "wheel"
  std::string build_type;  ///< CMake's: "Release"
  std::string compiler;    ///< name and version, as CMake tells them
  std::string processor;   ///< "x86_64"
  std::vector<BuiltWith> libraries;
};

BuildInfo build_info();

/// Two lines: "build: cmake, Release, GNU 12.2.0, x86_64" and "with: Eigen 3.4.0, ...".
std::string build_lines(const BuildInfo& info);

}  // namespace condyle
