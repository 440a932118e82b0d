#pragma once

/// Contacts and conditions that prevent the same motion: their directions (n, s x n/L) and
/// (α, η/L) are linearly dependent [Dortmans 1986, 2.163 and App. F].

#include <string>
#include <vector>

#include "condyle/equilibrium/newton.h"

namespace condyle {

struct Dependence {
  std::vector<std::size_t> culprits;  ///< constraints, contacts first; empty: all are independent
  bool contradiction = false;         ///< they cannot all hold
};

/// At the state where `system` was assembled.
[[nodiscard]] Dependence find_dependence(const Model& model, const NewtonSystem& system);

/// 'condition "x" and contact "medial" depend on each other', and that they cannot all hold; empty
/// where all are independent.
[[nodiscard]] std::string in_words(const Model& model,
                                   const NewtonSystem& system,
                                   const Dependence& dependence);

[[nodiscard]] std::string dependent_constraints(const Model& model, const NewtonSystem& system);

}  // namespace condyle
