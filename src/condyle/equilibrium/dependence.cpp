#include "condyle/equilibrium/dependence.h"

#include <algorithm>
#include <cmath>

#include "condyle/equilibrium/admissible_motions.h"
#include "condyle/equilibrium/motion_name.h"
#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

/// 'conditions "a" and "b" and contact "c"': each name once.
std::string name_constraints(const Linearization& at, const std::vector<std::size_t>& constraints) {
  std::vector<std::string> conditions, contacts;
  const std::size_t n = at.contacts().size();
  for (const std::size_t k : constraints) {
    if (k >= n) {
      conditions.push_back(quoted(at.model.condition_names[k - n]));
      continue;
    }
    const std::string contact = quoted(at.pair(k).name);
    if (std::find(contacts.begin(), contacts.end(), contact) == contacts.end())
      contacts.push_back(contact);
  }
  std::vector<std::string> words;
  const auto add = [&words](const char* one, const char* many,
                            const std::vector<std::string>& names) {
    if (!names.empty()) words.push_back((names.size() == 1 ? one : many) + joined(names));
  };
  add("condition ", "conditions ", conditions);
  add("contact ", "contacts ", contacts);
  return joined(words);
}

/// Signed distances by which the constraints are not met, contacts first [mm or rad, scaled as the
/// unit directions are].
double violation(const Linearization& at, std::size_t k) {
  const double L = at.model.length;
  const std::size_t n = at.contacts().size();
  if (k < n) {
    const ContactLinearization& contact = at.contacts()[k];
    return contact.gap() / std::hypot(1.0, contact.arm.norm() / L);
  }
  const ConditionDerivatives& condition = at.conditions()[k - n];
  return condition.k / std::hypot(condition.alpha.norm(), condition.eta.norm() / L);
}

}  // namespace

Dependence find_dependence(const Linearization& at) {
  constexpr double kExact = 1e-9, kNear = 1e-4, kShare = 1e-3, kUnmet = 1e-6;
  const std::size_t count = at.constraints();
  Eigen::MatrixXd columns(6, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k)
    columns.col(static_cast<Eigen::Index>(k)) = constraint_direction(at, k);
  if (count == 0 || !columns.allFinite()) return {};
  const SingularValues svd = singular_values(columns);
  // Constraints that cannot all be met end where they oppose each other, as closely as the descent
  // gets there.
  const bool unmet = at.system.largest_distance() > kUnmet * at.model.length;
  const double tolerance = (unmet ? kNear : kExact) * svd.values[0];
  Dependence dependence;
  for (Eigen::Index j = 0; j < svd.V.cols(); ++j) {
    if (j < svd.values.size() && svd.values[j] > tolerance) continue;
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double share = svd.V(static_cast<Eigen::Index>(k), j);
      sum += share * violation(at, k);
      if (std::abs(share) > kShare) dependence.culprits.push_back(k);
    }
    dependence.contradiction |= std::abs(sum) > kUnmet * at.model.length;
  }
  std::vector<std::size_t>& culprits = dependence.culprits;
  std::sort(culprits.begin(), culprits.end());
  culprits.erase(std::unique(culprits.begin(), culprits.end()), culprits.end());
  return dependence;
}

std::string in_words(const Linearization& at, const Dependence& dependence) {
  if (dependence.culprits.empty()) return {};
  const std::string names = name_constraints(at, dependence.culprits);
  if (dependence.culprits.size() == 1) return names + " prevents no motion here";
  const bool one_contact = names == name_constraints(at, {dependence.culprits.front()});
  return (one_contact ? "points of " : "") + names + " depend on each other" +
         (dependence.contradiction ? " and cannot all hold" : "");
}

std::string dependent_constraints(const Linearization& at) {
  return in_words(at, find_dependence(at));
}

}  // namespace condyle
