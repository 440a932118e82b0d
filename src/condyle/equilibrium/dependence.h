#pragma once

/// Contacts and conditions that prevent the same motion: their directions (n, s x n/L) and
/// (α, η/L) are linearly dependent [Dortmans 1986, 2.163 and App. F].

#include <string>
#include <vector>

#include "condyle/equilibrium/linearization.h"

namespace condyle {

struct Dependence {
  std::vector<std::size_t> culprits;  ///< constraints, contacts first; empty: all are independent
  bool contradiction = false;         ///< they cannot all hold
};

[[nodiscard]] Dependence find_dependence(const Linearization& at);

/// 'condition "x" and contact "medial" depend on each other', and that they cannot all hold; empty
/// where all are independent.
[[nodiscard]] std::string in_words(const Linearization& at, const Dependence& dependence);

[[nodiscard]] std::string dependent_constraints(const Linearization& at);

}  // namespace condyle
