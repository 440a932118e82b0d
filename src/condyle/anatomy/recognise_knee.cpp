#include "condyle/anatomy/recognise_knee.h"

#include "condyle/input_error.h"

namespace condyle {

RecognisedKnee recognise_knee(const KneeMeshes& meshes, const RecogniseOptions&) {
  if (meshes.femur.triangles.empty()) throw InputError("the femur has no triangles");
  return {};
}

}  // namespace condyle
