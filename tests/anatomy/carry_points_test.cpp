/// Points carried from one bone to another: exactly where the other is the same bone elsewhere.

#include "condyle/anatomy/carry_points.h"

#include <gtest/gtest.h>
