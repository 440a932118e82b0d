#include "condyle/elements/bounded_path.h"

#include <typeinfo>

namespace condyle {
namespace {

/// A dynamic_cast, whose cost would be felt: one type of path is asked again and again.
const BoundedPath* as_bounded(const LinePath& path) {
  thread_local const std::type_info* last = nullptr;
  thread_local bool is_bounded = false;
  const std::type_info& type = typeid(path);
  if (&type != last) {
    is_bounded = dynamic_cast<const BoundedPath*>(&path) != nullptr;
    last = &type;
  }
  return is_bounded ? static_cast<const BoundedPath*>(&path) : nullptr;
}

}  // namespace

bool is_surely_slack(const LineElement& element, const RigidTransform& X_BA, const double* kept) {
  constexpr double kRoundOff = 1e-9;  // [mm]
  if (!element.path || kept == nullptr) return false;
  const double slack = slack_length(element.law);
  if (!(slack > 0)) return false;
  const BoundedPath* path = as_bounded(*element.path);
  return path != nullptr && path->at_most(ends_of(element, X_BA), X_BA, kept) < slack - kRoundOff;
}

}  // namespace condyle
