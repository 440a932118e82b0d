/// Frames from the shape of two meshes: the phantom's are known by construction.

#include "condyle/anatomy/recognise_knee.h"

#include <gtest/gtest.h>

namespace condyle {

TEST(RecogniseKnee, NamesAnEmptyMesh) {
  EXPECT_THROW((void)recognise_knee(KneeMeshes{}), std::exception);
}

}  // namespace condyle
