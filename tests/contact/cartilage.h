#pragma once

#include "condyle/contact/contact_pair.h"

namespace condyle {

/// 3 mm thick.
inline constexpr ElasticSurface kCartilage{10, 0.45, 3};

}  // namespace condyle
