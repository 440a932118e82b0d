#pragma once

/// --degree and --strain: how the reference model is made from a scene.

#include <CLI/CLI.hpp>

#include "condyle/compare/compare.h"

namespace condyle {

inline void add_reference_options(CLI::App& command, CompareOptions& options) {
  command.add_option("--degree", options.degree, "total degree of the polynomials")
      ->check(CLI::Range(kLowestDegree, kHighestDegree))
      ->capture_default_str();
  command
      .add_option("--strain", options.strain,
                  "strain at which quadratic springs have the force of toe-linear bundles")
      ->check(CLI::Range(0.001, 1.0))
      ->capture_default_str();
}

}  // namespace condyle
