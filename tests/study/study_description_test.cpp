#include "condyle/scene/study_description.h"

#include <gtest/gtest.h>

namespace condyle {
namespace {

TEST(StudyDescription, KeepsOutputsInFullUnlessAskedOtherwise) {
  EXPECT_FALSE(StudyDescription{}.single_precision);
  EXPECT_EQ(StudyDescription{}.design, DesignKind::kMonteCarlo);
}

}  // namespace
}  // namespace condyle
