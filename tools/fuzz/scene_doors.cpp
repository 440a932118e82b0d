/// Scenes and studies as text, and scenes that a grammar makes up.

#include <stdexcept>

#include "condyle/equilibrium/build_model.h"
#include "condyle/results/run_identity.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/describe.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/scene_file/read_study.h"
#include "condyle/specimen/fit_surfaces.h"
#include "fuzz/door_list.h"
#include "fuzz/memory_file.h"
#include "fuzz/refusal.h"
#include "fuzz/scene_grammar.h"

namespace condyle::fuzz {
namespace {

bool needs_meshes(const Scene& scene) {
  for (const SurfaceDescription& surface : scene.surfaces)
    if (surface.kind == SurfaceKind::kPatch) return true;
  return false;
}

void use(const std::string& text) {
  const Scene scene = parse_scene(text, "scene.toml");
  if (describe(scene).empty()) throw std::logic_error("nothing is said of a scene");
  if (!start_pose(scene).R.allFinite()) throw std::logic_error("a start pose is not finite");
  // A model takes a hundred times as long as its scene: one in sixteen, by a number that no mutation aims at.
  if (needs_meshes(scene) || hash_bytes(text) % 16 != 0) return;
  const Model model = build_model(scene, fit_surfaces(scene, {}, {}, 1));
  if (!(model.length > 0)) throw std::logic_error("a model without a length");
}

}  // namespace

void open_scene(Bytes bytes) {
  const std::string text = text_of(bytes);
  taken([&] { use(text); });
}

void open_made_scene(Bytes bytes) {
  Choices choices(bytes);
  const Temper temper = choices.once_in(8) ? Temper::kTame : Temper::kWild;
  const std::string text = made_scene(choices, temper);
  taken([&] { use(text); });
}

void open_study(Bytes bytes) {
  static const bool there = [] {
    const std::uint8_t plain[] = {7, 0, 2, 0, 0};
    Choices choices{Bytes(plain)};
    write_scratch("knee.toml", made_scene(choices, Temper::kTame));
    write_scratch("table.csv", "tie 0.stiffness\n0.1\n");
    return true;
  }();
  (void)there;
  write_scratch("study.toml", text_of(bytes));
  taken([&] { (void)read_study(scratch() / "study.toml"); });
}

}  // namespace condyle::fuzz
