/// [[vary]]: which numbers vary, and how far.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_numbers.h"
#include "condyle/scene_file/read_sections.h"
#include "condyle/scene_file/read_study_parts.h"

namespace condyle {
namespace {

constexpr const char* kRoughness = "roughness";

bool is_roughness(const Section& section) {
  return section.value("what", "what varies").text == kRoughness;
}

bool has_mesh(const Scene& scene) {
  for (const SurfaceDescription& surface : scene.surfaces)
    if (surface.kind == SurfaceKind::kPatch) return true;
  return false;
}

void read_roughness(const Section& section, ReadStudy& read) {
  if (read.study.roughness) section.fail("what", "one roughness");
  for (const Scene& scene : read.scenes)
    if (!has_mesh(scene))
      section.fail("what",
                   fmt::format("scenes with surfaces that are fitted to a mesh: {} has none",
                               scene.file.string()));
  const double unit = read.scenes.front().length_to_mm;
  VariedRoughness roughness;
  roughness.rms = unit * section.number("rms", "a length", Range::kPositive);
  roughness.correlation = unit * section.number("correlation", "a length", Range::kPositive);
  read.study.roughness = roughness;
  section.finish();
}

/// Of a table nothing need be said: it holds the numbers.
void read_spread(const Section& section, const Scene& scene, bool table, VariedNumber& varied) {
  const bool range = section.has("range");
  if (range && (section.has("sd") || section.has("bounds") || section.has("normal_sd")))
    section.fail("range", "either range, or sd with bounds");
  if (range) varied.range = read_range(section, scene, varied.number);
  if (!range && (section.has("sd") || !table))
    read_deviation(section, scene, "sd", "a standard deviation (or range in its place)",
                   varied.number);
  if (!range) read_bounds(section, scene, varied.number);
}

/// The numbers of one scene.
std::vector<VariedNumber> numbers_of(const std::vector<Section>& sections,
                                     const Scene& scene,
                                     bool table) {
  std::vector<VariedNumber> numbers;
  NamedNumbers named;
  for (const Section& section : sections) {
    if (is_roughness(section)) continue;
    VariedNumber& varied = numbers.emplace_back();
    varied.number = read_named_numbers(section, scene, named, {kRoughness});
    read_spread(section, scene, table, varied);
    section.finish();
  }
  return numbers;
}

/// What is free in [calibrate] of the first scene, found in another one.
std::vector<VariedNumber> fitted_numbers(const Scene& first, const Scene& scene) {
  const Source source{first.file.string(), first.file.parent_path()};
  const Value document = parse_document(first.text, source.file);
  const Section root(document, source, "");
  std::vector<VariedNumber> numbers;
  for (const CalibrationParameter& parameter :
       read_fitted_numbers(root.table("calibrate", "a table"), scene))
    numbers.push_back({parameter, std::nullopt});
  return numbers;
}

/// Messages about numbers of a scene other than the first name that scene.
template <typename Read>
std::vector<VariedNumber> of_scene(const Scene& scene, bool first, const Read& numbers) {
  try {
    return numbers(scene);
  } catch (const InputError& error) {
    if (first) throw;
    throw InputError(fmt::format("{}, in {}", error.what(), scene.file.string()));
  }
}

std::vector<std::string> names_in(const Scene& scene, const CalibrationParameter& parameter) {
  const std::vector<std::string> names = parameter.what == ParameterKind::kLoadScale
                                             ? names_of(scene.loads)
                                             : names_of(scene.ligaments);
  std::vector<std::string> chosen;
  for (const int index : parameter.of) chosen.push_back(names[static_cast<std::size_t>(index)]);
  return chosen;
}

/// Columns of a study are the same for all knees.
void expect_same_names(const Section& root, const ReadStudy& read) {
  for (std::size_t i = 1; i < read.scenes.size(); ++i)
    for (std::size_t j = 0; j < read.varied.front().size(); ++j) {
      const Scene &first = read.scenes.front(), &scene = read.scenes[i];
      if (names_in(scene, read.varied[i][j].number) ==
          names_in(first, read.varied.front()[j].number))
        continue;
      root.fail("specimens",
                fmt::format("scenes in which the same vary: number {} that varies is of others in "
                            "{} than in {}",
                            j + 1, scene.file.string(), first.file.string()));
    }
}

/// A range is read in the units of each scene.
void expect_same_ranges(const std::vector<Section>& sections, const ReadStudy& read) {
  std::size_t j = 0;
  for (const Section& section : sections) {
    if (is_roughness(section)) continue;
    const std::optional<std::array<double, 2>>& first = read.varied.front()[j].range;
    for (std::size_t i = 1; first && i < read.scenes.size(); ++i) {
      const std::array<double, 2>& own = *read.varied[i][j].range;
      const auto same = [&](std::size_t end) {
        return std::abs(own[end] - (*first)[end]) <= 1e-12 * std::abs((*first)[end]);
      };
      if (same(0) && same(1)) continue;
      section.fail(
          "range",
          fmt::format(
              "one that is the same in all scenes, which have one unit of length: {:.6g} to "
              "{:.6g} mm in {} are {:.6g} to {:.6g} mm in {}",
              (*first)[0], (*first)[1], read.scenes.front().file.string(), own[0], own[1],
              read.scenes[i].file.string()));
    }
    ++j;
  }
}

}  // namespace

void read_varied_numbers(const Section& root, ReadStudy& read) {
  const bool table = read.study.design == DesignKind::kTable;
  const std::vector<Section> sections = root.sections("vary");
  const Scene& first = read.scenes.front();
  if (sections.empty() && !(table && first.calibration))
    root.fail_with(fmt::format(
        "[[vary]] is missing, expected one or more{}",
        table ? ", or a first scene with [calibrate] whose numbers the table holds" : ""));
  for (const Section& section : sections)
    if (is_roughness(section)) read_roughness(section, read);
  for (const Scene& scene : read.scenes)
    read.varied.push_back(of_scene(scene, &scene == &first, [&](const Scene& knee) {
      return sections.empty() ? fitted_numbers(first, knee) : numbers_of(sections, knee, table);
    }));
  expect_same_names(root, read);
  if (!table) expect_same_ranges(sections, read);
}

}  // namespace condyle
