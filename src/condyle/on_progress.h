#pragma once

/// How a long computation tells how far it is: `done` of `total` parts. Called from one thread at a
/// time, though not always the same.

#include <functional>

namespace condyle {

using OnProgress = std::function<void(int done, int total)>;

}  // namespace condyle
