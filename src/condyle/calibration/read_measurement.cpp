#include "condyle/calibration/read_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "condyle/elements/joint_table.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/section.h"

namespace condyle {
namespace {

/// Beyond these no knee was measured: other units are meant.
constexpr double kMostAngle = M_PI * (1 + 1e-12), kMostLength = 200;  // [rad], [mm]
constexpr double kMostForce = 2e4, kMostMoment = 1e6;                 // [N], [N mm]
constexpr double kLeastSd = 1e-9;  // nearer poses are not solved [mm, rad, N, N mm]

const std::vector<std::string>& known_columns() {
  static const std::vector<std::string> names = {"specimen",   "test",  "flexion", "load", "level",
                                                 "coordinate", "value", "sd",      "use"};
  return names;
}

std::string with_advice(const std::string& expected,
                        const std::string& word,
                        const std::vector<std::string>& names) {
  const std::string meant = nearest(word, names);
  return meant.empty() ? expected : fmt::format("{}; did you mean \"{}\"?", expected, meant);
}

/// What a quantity is measured in: how much of the unit inside the table's is, and the most it can be.
struct Scale {
  double inside, most;
  std::string unit;  ///< as the table has it
};

Scale angle_scale(const Scene& scene) {
  return {scene.angle_to_rad, kMostAngle, scene.angle_to_rad == 1 ? "rad" : "deg"};
}

Scale length_scale(const Scene& scene) {
  const double to_mm = scene.length_to_mm;
  return {to_mm, kMostLength, to_mm == 1 ? "mm" : to_mm == 10 ? "cm" : "m"};
}

Scale force_scale(const Scene& scene) { return {scene.force_to_n, kMostForce, "N"}; }

Scale moment_scale(const Scene& scene) {
  const double to_nmm = scene.calibration->moment_to_nmm;
  return {to_nmm, kMostMoment, to_nmm == 1 ? "N mm" : to_nmm == 10 ? "N cm" : "N m"};
}

double sized(const CsvRow& row,
             const MeasurementColumns& columns,
             const std::string& column,
             const std::string& expected,
             const Scale& scale) {
  const double value = scale.inside * columns.number(row, column, expected);
  if (std::abs(value) > scale.most)
    columns.fail(row, column,
                 fmt::format("{} in {}, at most {:.6g} of a knee (suspect the units)", expected,
                             scale.unit, scale.most / scale.inside));
  return value;
}

Scale level_scale(const Measurement& measured, const Scene& scene) {
  if (const ConditionDescription* held = held_condition(measured.load, scene))
    return is_angle(held->kind) ? angle_scale(scene) : length_scale(scene);
  return is_moment(measured.load, scene) ? moment_scale(scene) : force_scale(scene);
}

void read_level(const CsvRow& row,
                const MeasurementColumns& columns,
                const Scene& scene,
                Measurement& measured) {
  const std::string name = columns.text(row, "load"), level = columns.text(row, "level");
  std::vector<std::string> names = {"none"};
  for (const CalibrationLoad& load : scene.calibration->loads) names.push_back(load.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    columns.fail(row, "load", with_advice("a [[calibrate.load]]: " + listed(names), name, names));
  measured.load = static_cast<int>(found - names.begin()) - 1;
  if (measured.load >= 0) {
    measured.level =
        sized(row, columns, "level", "the level of " + name, level_scale(measured, scene));
  } else if (!level.empty() && csv_number(level) != 0) {
    columns.fail(row, "level", "0, as there is no load (load = none)");
  }
}

std::size_t find_name(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void read_force(const CsvRow& row,
                const MeasurementColumns& columns,
                const Scene& scene,
                Measurement& measured) {
  const std::string name = columns.text(row, "coordinate");
  std::vector<std::string> ligaments, contacts, all = {"reaction"};
  for (const JointCoordinate& coordinate : kJointCoordinates) {
    all.emplace_back(coordinate.name);
    all.push_back(std::string(coordinate.name) + ".laxity");
  }
  for (const LigamentDescription& it : scene.ligaments) ligaments.push_back(it.name + ".force");
  for (const ContactDescription& it : scene.contacts) contacts.push_back(it.name + ".force");
  all.insert(all.end(), ligaments.begin(), ligaments.end());
  all.insert(all.end(), contacts.begin(), contacts.end());
  const std::size_t ligament = find_name(ligaments, name), contact = find_name(contacts, name);
  const bool is_ligament = ligament < ligaments.size(), is_contact = contact < contacts.size();
  if (is_ligament && is_contact)
    columns.fail(row, "coordinate", "a name that a ligament and a contact do not share");
  if (!is_ligament && !is_contact)
    columns.fail(
        row, "coordinate",
        with_advice(
            "a joint coordinate, one with .laxity, reaction, LIGAMENT.force or CONTACT.force", name,
            all));
  measured.kind = is_ligament ? MeasuredKind::kLigamentForce : MeasuredKind::kContactForce;
  measured.index = is_ligament ? ligament : contact;
}

bool holds_in_every_test(const ConditionDescription& condition, const Scene& scene) {
  for (int load = 0; load < std::ssize(scene.calibration->loads); ++load)
    if (held_condition(load, scene) == &condition) return false;
  return true;
}

/// Refuses what is prescribed in the test that is said to measure it.
void check_free(const CsvRow& row,
                const MeasurementColumns& columns,
                const Scene& scene,
                const Measurement& measured) {
  if (measured.kind != MeasuredKind::kJointCoordinate) return;
  const auto kind = static_cast<ConditionKind>(measured.index);
  if (kind == ConditionKind::kFlexion)
    columns.fail(row, "coordinate", "another coordinate: flexion is prescribed in every test");
  const ConditionDescription* held = held_condition(measured.load, scene);
  if (held != nullptr && held->kind == kind)
    columns.fail(row, "coordinate",
                 fmt::format("another coordinate, or reaction: load {} prescribes it",
                             columns.text(row, "load")));
  for (const ConditionDescription& condition : scene.conditions)
    if (condition.kind == kind && holds_in_every_test(condition, scene))
      columns.fail(
          row, "coordinate",
          fmt::format("another coordinate: condition \"{}\", which is of no [[calibrate.load]], "
                      "holds it in every test (or use = skip)",
                      condition.name));
  if (measured.laxity && !(measured.level > 0))
    columns.fail(row, "level", "a level > 0: a laxity is told at it and at the opposite one");
}

constexpr std::string_view kLaxity = ".laxity";

bool is_laxity(const std::string& name) {
  return name.size() > kLaxity.size() &&
         name.compare(name.size() - kLaxity.size(), kLaxity.size(), kLaxity) == 0;
}

void read_coordinate(const CsvRow& row,
                     const MeasurementColumns& columns,
                     const Scene& scene,
                     Measurement& measured) {
  const std::string name = columns.text(row, "coordinate");
  measured.laxity = is_laxity(name);
  const std::string coordinate =
      measured.laxity ? name.substr(0, name.size() - kLaxity.size()) : name;
  for (std::size_t i = 0; i < kJointCoordinates.size(); ++i) {
    if (coordinate != kJointCoordinates[i].name) continue;
    measured.index = i;
    return check_free(row, columns, scene, measured);
  }
  if (name != "reaction") return read_force(row, columns, scene, measured);
  const ConditionDescription* held = held_condition(measured.load, scene);
  if (held == nullptr)
    columns.fail(row, "coordinate",
                 "a coordinate: a reaction is of loads that are conditions, which hold one");
  measured.kind = MeasuredKind::kReaction;
  measured.index = static_cast<std::size_t>(held - scene.conditions.data());
}

Scale value_scale(const Measurement& measured, const Scene& scene) {
  switch (measured.kind) {
    case MeasuredKind::kJointCoordinate:
      return kJointCoordinates[measured.index].angle ? angle_scale(scene) : length_scale(scene);
    case MeasuredKind::kReaction:
      return is_angle(scene.conditions[measured.index].kind) ? moment_scale(scene)
                                                             : force_scale(scene);
    default:
      return force_scale(scene);
  }
}

}  // namespace

MeasurementColumns::MeasurementColumns(const CsvFile& csv)
    : file_(csv.file.string()), names_(csv.header.fields) {
  const auto refuse = [&](const std::string& message) {
    throw InputError(fmt::format("{}:{}: {}", file_, csv.header.line, message));
  };
  if (names_.size() == 1 && names_[0].find_first_of(";\t") != std::string::npos)
    refuse("columns parted by semicolons or tabs, expected commas (and points in numbers)");
  for (auto name = names_.begin(); name != names_.end(); ++name) {
    const std::vector<std::string>& known = known_columns();
    if (std::find(known.begin(), known.end(), *name) == known.end())
      refuse(fmt::format("unknown column \"{}\", expected {}", *name,
                         with_advice("one of " + listed(known), *name, known)));
    if (std::find(names_.begin(), name, *name) != name)
      refuse(fmt::format("column \"{}\" stands twice, expected once", *name));
  }
  for (const std::string& name : known_columns())
    if (name != "specimen" && name != "use" && !has(name))
      refuse(fmt::format("no column \"{}\", expected {} (specimen and use may be absent)", name,
                         listed(known_columns())));
}

int MeasurementColumns::find(const std::string& column) const {
  const auto found = std::find(names_.begin(), names_.end(), column);
  return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
}

std::string MeasurementColumns::text(const CsvRow& row, const std::string& column) const {
  const int index = find(column);
  return index < 0 ? "" : row.fields[static_cast<std::size_t>(index)];
}

double MeasurementColumns::number(const CsvRow& row,
                                  const std::string& column,
                                  const std::string& expected) const {
  const double number = csv_number(text(row, column));
  if (std::isnan(number)) fail(row, column, expected + ", a finite number");
  return number;
}

void MeasurementColumns::fail(const CsvRow& row,
                              const std::string& column,
                              const std::string& expected) const {
  const std::string value = text(row, column);
  throw InputError(fmt::format("{}:{}: {} {}, expected {}", file_, row.line, column,
                               value.empty() ? "is empty" : "= " + value, expected));
}

MeasuredUse use_of(const CsvRow& row, const MeasurementColumns& columns) {
  static const std::vector<std::string> words = {"fit", "test", "skip"};
  if (!columns.has("use")) return MeasuredUse::kFit;
  const std::string use = columns.text(row, "use");
  const std::size_t index = find_name(words, use);
  if (index == words.size()) columns.fail(row, "use", with_advice(listed(words), use, words));
  return static_cast<MeasuredUse>(index);
}

Measurement read_measurement(const CsvRow& row,
                             const MeasurementColumns& columns,
                             const Scene& scene) {
  Measurement measured;
  measured.line = row.line;
  measured.use = use_of(row, columns);
  measured.test = columns.text(row, "test");
  if (measured.test.empty()) columns.fail(row, "test", "the name of a curve");
  measured.flexion = sized(row, columns, "flexion", "an angle", angle_scale(scene));
  read_level(row, columns, scene, measured);
  read_coordinate(row, columns, scene, measured);
  const Scale scale = value_scale(measured, scene);
  measured.value = sized(row, columns, "value", "what was measured", scale);
  measured.sd = sized(row, columns, "sd", "a standard deviation > 0", scale);
  if (!(measured.sd > 0)) columns.fail(row, "sd", "a standard deviation > 0");
  if (measured.sd < kLeastSd)
    columns.fail(row, "sd",
                 fmt::format("a standard deviation of at least {:.3g} {}, as exact as poses are",
                             kLeastSd / scale.inside, scale.unit));
  return measured;
}

}  // namespace condyle
