#pragma once

/// Scenes made up of choices (choices.h): every table and key of docs/scene.md. Tame ones are scenes as
/// people write them, of two bodies with exact surfaces, mostly well-posed; in wild ones any line may be
/// left out, doubled, misspelt, or hold a value of another kind or size.

#include <string>

#include "fuzz/scene_lines.h"

namespace condyle::fuzz {

/// Text of a scene (TOML); tame ones have a sweep of at most five values.
[[nodiscard]] std::string made_scene(Choices& choices, Temper temper);

}  // namespace condyle::fuzz
