#include "condyle/equilibrium/work.h"

#include "condyle/wrapping/geodesic.h"

namespace condyle {

long points_until_now(const std::vector<ContactSearch>& searches, const ContactPotentials& laws) {
  constexpr long kStep = 8;  // points in the time of a step along a geodesic
  return points_looked_at(searches) + laws.looked_at() + kStep * geodesic_steps();
}

}  // namespace condyle
