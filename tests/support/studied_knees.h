#pragma once

/// Knees whose derivatives are checked: springs on exact surfaces, right and left, either body moving,
/// a body that hangs on wrapped lines, and elastic layers.

#include <filesystem>
#include <numbers>
#include <utility>

#include "condyle/equilibrium/build_model.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/layered_pairs.h"
#include "support/quadric_knee.h"
#include "support/sensitivity_check.h"
#include "support/wrapped_scenes.h"

namespace condyle::test {

inline Studied nominal(Model model) {
  Drive drive = drive_of(model);
  return {std::move(model), std::move(drive)};
}

inline Studied wismans_type(double flexion) {
  const Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/knee.toml");
  Studied knee = nominal(build_model(scene, fit_surfaces(scene)));
  knee.drive.values[0] = flexion * std::numbers::pi / 180;
  return knee;
}

/// With a ligament of another law, a dead force and a dead moment, at 25 degrees.
inline Model loaded(Model model) {
  model.elements[7].law = QuadraticLaw{4, slack_length(model.elements[7].law)};
  Load force, moment;
  force.vector = {4, -9, 12};
  force.at = {2, -5, -40};
  moment.moment = true;
  moment.vector = {90, 150, -200};
  model.loads.push_back(force);
  model.loads.push_back(moment);
  model.load_names.insert(model.load_names.end(), {"force", "moment"});
  model.conditions[0].value = 25 * std::numbers::pi / 180;
  return model;
}

inline Studied quadric(bool left = false, bool femur_moves = false) {
  QuadricKneeView view;
  view.left = left;
  view.femur_moves = femur_moves;
  return nominal(loaded(quadric_knee(view)));
}

inline Studied hanging_body(double push) {
  Studied body = nominal(build_model(parse_scene(kHangingBody, "knee.toml"), {}));
  body.drive.scales[1] = push;
  return body;
}

/// Unlike layers on both surfaces of each pair.
inline Studied layered(Model model, PressureLaw pressure) {
  Studied knee = nominal(std::move(model));
  knee.layer.pressure = pressure;
  knee.model = on_layers(knee.model, 10, knee.layer);
  for (ContactPair& pair : knee.model.pairs) pair.elastic_A = ElasticSurface{6, 0.4, 2};
  return knee;
}

}  // namespace condyle::test
