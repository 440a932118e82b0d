#include "app/make_run.h"

#include <utility>

namespace condyle {
namespace {

std::vector<RunPatch> patches_of(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  std::vector<RunPatch> patches;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto* patch = dynamic_cast<const Patch*>(surfaces[i].surface.get());
    if (patch == nullptr) continue;
    const SurfaceDescription& description = scene.surfaces[i];
    patches.push_back({description.name, description.body, patch->data(),
                       surfaces[i].report.value_or(FitReport{})});
  }
  return patches;
}

}  // namespace

Run make_run(const Scene& scene, const std::vector<FittedSurface>& surfaces, SweepResult sweep) {
  Run run{scene, std::move(sweep), patches_of(scene, surfaces), {}};
  for (const BodyDescription& body : scene.bodies) {
    if (body.mesh) run.bodies.push_back({body.name, load_body_mesh(body)});
  }
  return run;
}

}  // namespace condyle
