#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

enum class LawKind { kToeLinear, kQuadratic, kPolynomial, kTable };

// The slack length, given as such or by a strain at a known length.
double read_slack_length(const Section& section,
                         const Scene& scene,
                         double start_length,
                         LigamentDescription& ligament) {
  if (!section.has("reference_strain")) {
    if (section.has("reference_length"))
      section.fail("reference_length", "a reference_strain beside it");
    return scene.length_to_mm * section.number("slack_length",
                                               "a length (or reference_strain in its place)",
                                               Range::kPositive);
  }
  if (section.has("slack_length"))
    section.fail("slack_length", "either slack_length or reference_strain, not both");
  const double strain = section.number("reference_strain", "a strain");
  if (strain <= -1) section.fail("reference_strain", "a strain > -1");
  if (section.has("reference_length")) {
    ligament.reference_length =
        scene.length_to_mm * section.number("reference_length", "a length", Range::kPositive);
    return *ligament.reference_length / (1 + strain);
  }
  ligament.reference_strain = strain;
  return start_length / (1 + strain);
}

ForceLaw read_polynomial_law(const Section& section, const Scene& scene) {
  PolynomialLaw law;
  law.coefficients = section.numbers("coefficients", "numbers [c0, c1, c2, ...]");
  double power = 1;
  for (double& coefficient : law.coefficients) {
    coefficient *= scene.force_to_n / power;
    power *= scene.length_to_mm;
  }
  law.tension_only = section.has("tension_only") && section.boolean("tension_only");
  return law;
}

ForceLaw read_table_law(const Section& section, const Scene& scene) {
  std::vector<double> lengths = section.numbers("lengths", "increasing lengths [l1, l2, ...]");
  std::vector<double> forces = section.numbers("forces", "a force for each length [f1, f2, ...]");
  if (lengths.size() < 2) section.fail("lengths", "at least two lengths");
  if (std::adjacent_find(lengths.begin(), lengths.end(), std::greater_equal<>()) != lengths.end()) {
    section.fail("lengths", "lengths that increase strictly");
  }
  if (lengths.front() < 0) section.fail("lengths", "lengths >= 0");
  if (forces.size() != lengths.size()) {
    section.fail("forces", fmt::format("as many forces as lengths ({})", lengths.size()));
  }
  for (double& length : lengths) length *= scene.length_to_mm;
  for (double& force : forces) force *= scene.force_to_n;
  return make_table_law(std::move(lengths), std::move(forces));
}

ForceLaw read_law(const Section& section,
                  const Scene& scene,
                  double start_length,
                  LigamentDescription& ligament) {
  static const Choices<LawKind> laws = {{"toe-linear", LawKind::kToeLinear},
                                        {"quadratic", LawKind::kQuadratic},
                                        {"polynomial", LawKind::kPolynomial},
                                        {"table", LawKind::kTable}};
  const auto stiffness = [&](const std::string& expected) {
    return scene.force_to_n * section.number("stiffness", expected, Range::kNotNegative);
  };
  switch (section.choice("law", laws)) {
    case LawKind::kToeLinear:
      return ToeLinearLaw{
          .stiffness = stiffness("a force per unit strain"),
          .transition_strain =
              section.number_or("transition_strain", 0.06, "a strain", Range::kPositive),
          .slack_length = read_slack_length(section, scene, start_length, ligament)};
    case LawKind::kQuadratic:
      return QuadraticLaw{
          .stiffness =
              stiffness("a force per length squared") / (scene.length_to_mm * scene.length_to_mm),
          .slack_length = read_slack_length(section, scene, start_length, ligament)};
    case LawKind::kPolynomial:
      return read_polynomial_law(section, scene);
    case LawKind::kTable:
      break;
  }
  return read_table_law(section, scene);
}

// The declared length unit, by its name and by what the numbers look like.
std::string suspicion(const Scene& scene, double start_length) {
  constexpr double kShort = 5, kUsual = 40, kLong = 300;  // ligaments of a knee [mm]
  const std::string* declared = nullptr;
  const std::string* likely = nullptr;
  const double number = start_length / scene.length_to_mm;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [name, to_mm] : length_units()) {
    const double length = number * to_mm, off = std::abs(std::log(length / kUsual));
    if (to_mm == scene.length_to_mm)
      declared = &name;
    else if (length > kShort && length < kLong && off < least)
      likely = &name, least = off;
  }
  return fmt::format(
      ", expected between 0.5 and 2000 mm; suspect the units: [units] length = \"{}\"{}", *declared,
      likely == nullptr ? "" : fmt::format(", but the coordinates look like {}", *likely));
}

// A factor of 1000 in the coordinates or in a slack length is nearly always a mistaken unit.
void check_sizes(const Section& section,
                 const Scene& scene,
                 const LigamentDescription& ligament,
                 double start_length) {
  constexpr double kLongest = 2000, kMostStretch = 100;  // [mm], [-]
  if (start_length > kLongest) {
    section.fail_with(fmt::format("the ends lie {:.6g} mm apart at the start pose{}", start_length,
                                  suspicion(scene, start_length)));
  }
  if (const auto* table = std::get_if<TableLaw>(&ligament.law)) {
    const double shortest = table->lengths.front(), longest = table->lengths.back();
    if (start_length > kMostStretch * longest || shortest > kMostStretch * start_length)
      section.fail("lengths",
                   fmt::format("lengths like that at the start pose, {:.6g} (suspect the units)",
                               start_length / scene.length_to_mm));
  }
  const double slack = slack_length(ligament.law);
  const std::string key = section.has("slack_length") ? "slack_length" : "reference_length";
  const bool given = section.has("slack_length") || section.has("reference_length");
  if (given && slack > 0 &&
      (start_length > kMostStretch * slack || slack > kMostStretch * start_length)) {
    section.fail(key,
                 fmt::format("a length like that at the start pose, {:.6g} (suspect the units)",
                             start_length / scene.length_to_mm));
  }
}

LigamentDescription read_ligament(const Section& section,
                                  const Scene& scene,
                                  double& start_length) {
  LigamentDescription ligament;
  ligament.name = read_name(section, names_of(scene.ligaments));
  ligament.line = section.line();
  ligament.ends = read_ends(section, scene);
  constexpr double kLeast = 1e-9;  // [mm]
  if (!(distance_between(scene, ligament.ends, start_pose(scene)) > kLeast))
    section.fail("ends", "ends that lie apart at the start pose (their distance is 0)");
  read_path(section, scene, ligament);
  start_length = start_length_of(section, scene, ligament);
  ligament.law = read_law(section, scene, start_length, ligament);
  section.finish();
  if (ligament.reference_strain && has_known_path(scene, ligament)) {
    const std::string objection = start_path_objection(scene, ligament);
    if (!objection.empty())
      section.fail("reference_strain", "slack_length in its place: at the start pose " + objection);
  }
  check_sizes(section, scene, ligament, start_length);
  return ligament;
}

}  // namespace

void read_ligaments(const Section& root, Scene& scene) {
  const std::vector<Section> sections = root.sections("ligament");
  double longest = 0;
  for (const Section& section : sections) {
    double start_length = 0;
    scene.ligaments.push_back(read_ligament(section, scene, start_length));
    longest = std::max(longest, start_length);
  }
  check_wraps_used(root, scene);
  constexpr double kShortest = 0.5;  // [mm]
  if (!sections.empty() && longest < kShortest) {
    sections.front().fail_with(
        fmt::format("no ligament is longer than {:.6g} mm at the start pose{}", longest,
                    suspicion(scene, longest)));
  }
}

}  // namespace condyle
