#pragma once

#include "condyle/network/integrate.h"

namespace condyle {

inline IntegrationOptions options(double end, double interval, double tolerance) {
  IntegrationOptions o;
  o.end = end;
  o.interval = interval;
  o.tolerance = tolerance;
  return o;
}

}  // namespace condyle
