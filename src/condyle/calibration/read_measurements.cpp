/// The table as a whole (measurement_table.h).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

#include "condyle/calibration/csv_file.h"
#include "condyle/calibration/measurement_table.h"
#include "condyle/calibration/read_measurement.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/scene_words.h"
#include "condyle/scene_file/section.h"

namespace condyle {
namespace {

std::vector<std::string> specimens_of(const CsvFile& csv, const MeasurementColumns& columns) {
  std::vector<std::string> names;
  for (const CsvRow& row : csv.rows) {
    const std::string name = columns.text(row, "specimen");
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// The one that is meant: [calibrate] specimen, or the only one.
std::string specimen_of(const CsvFile& csv,
                        const MeasurementColumns& columns,
                        const std::string& wanted) {
  const std::string file = csv.file.string();
  const std::vector<std::string> names = specimens_of(csv, columns);
  if (!wanted.empty() && !columns.has("specimen"))
    throw InputError(
        fmt::format("{}:{}: no column \"specimen\", expected rows of \"{}\" "
                    "([calibrate] specimen)",
                    file, csv.header.line, wanted));
  if (wanted.empty() && names.size() > 1)
    throw InputError(fmt::format("{}: rows of {}, expected [calibrate] specimen to say which", file,
                                 listed(names)));
  if (!wanted.empty() && std::find(names.begin(), names.end(), wanted) == names.end()) {
    const std::string meant = nearest(wanted, names);
    throw InputError(fmt::format("{}: no row of specimen \"{}\", expected {}{}", file, wanted,
                                 names.empty() ? "one" : listed(names),
                                 meant.empty() ? "" : "; did you mean \"" + meant + "\"?"));
  }
  return !wanted.empty() || names.empty() ? wanted : names.front();
}

/// Words for units of one quantity, and that of the scene among them.
struct UnitWords {
  std::vector<std::string> all;
  std::string own, key;  ///< key: where the scene says it
};

std::vector<UnitWords> lengths_and_angles(const Scene& scene) {
  return {{{"mm", "cm", "m"}, unit_name(scene.length_to_mm), "[units]"},
          {{"deg", "rad"}, scene.angle_to_rad == 1 ? "rad" : "deg", "[units]"}};
}

std::vector<UnitWords> moments(const Scene& scene) {
  const double to_nmm = scene.calibration->moment_to_nmm;
  return {{{"N mm", "N cm", "N m"}, "N " + unit_name(to_nmm), "[calibrate] moment"}};
}

/// A comment "units: mm, deg, N m; ..." says what the numbers are in, which are read in the units of the scene; other words
/// are none of ours.
void check_units(const CsvFile& csv, const Scene& scene, const std::vector<UnitWords>& known) {
  constexpr std::string_view kUnits = "units:";
  for (const CsvComment& comment : csv.comments) {
    if (!comment.text.starts_with(kUnits)) continue;
    std::istringstream list(
        comment.text.substr(kUnits.size(), comment.text.find(';') - kUnits.size()));
    for (std::string word; std::getline(list >> std::ws, word, ',');) {
      word.erase(word.find_last_not_of(" \t") + 1);
      for (const UnitWords& unit : known)
        if (word != unit.own && std::find(unit.all.begin(), unit.all.end(), word) != unit.all.end())
          throw InputError(fmt::format("{}:{}: its numbers are in {}, expected {} as {} of {}",
                                       csv.file.string(), comment.line, word, unit.own, unit.key,
                                       scene.file.string()));
    }
  }
}

/// Its level is a moment, or what it measures.
bool has_moment(const Measurement& row, const Scene& scene) {
  const ConditionDescription* held = held_condition(row.load, scene);
  const bool reaction = held && row.kind == MeasuredKind::kReaction && is_angle(held->kind);
  return reaction || is_moment(row.load, scene);
}

/// Rows that measure the same have the same: a level of 0 is no load, but of what holds a coordinate.
using RowKey = std::tuple<std::string, double, int, double, MeasuredKind, bool, std::size_t>;

bool is_unloaded(const Measurement& row, const Scene& scene) {
  if (row.load < 0) return true;
  const auto load = static_cast<std::size_t>(row.load);
  return row.level == 0 && !scene.calibration->loads[load].displacement_control;
}

RowKey key_of(const Measurement& row, const Scene& scene) {
  const int load = is_unloaded(row, scene) ? -1 : row.load;
  return {row.test, row.flexion, load, row.level, row.kind, row.laxity, row.index};
}

void check_relative(const Scene& scene, const MeasurementTable& table) {
  const std::vector<std::string>& relative = scene.calibration->relative;
  std::vector<std::string> curves;
  for (const Measurement& row : table.rows)
    if (std::find(curves.begin(), curves.end(), row.test) == curves.end())
      curves.push_back(row.test);
  for (const std::string& name : relative) {
    if (std::find(curves.begin(), curves.end(), name) != curves.end()) continue;
    const std::string meant = nearest(name, curves);
    throw InputError(
        fmt::format("{}: [calibrate] relative = \"{}\" names no curve of {}, expected {}{}",
                    scene.file.string(), name, table.file.string(), listed(curves),
                    meant.empty() ? "" : "; did you mean \"" + meant + "\"?"));
  }
}

bool is_relative(const Scene& scene, const std::string& test) {
  const std::vector<std::string>& relative = scene.calibration->relative;
  return std::find(relative.begin(), relative.end(), test) != relative.end();
}

bool is_told(const Measurement& row, const Scene& scene) {
  return is_relative(scene, row.test) && row.kind == MeasuredKind::kJointCoordinate && !row.laxity;
}

bool same_curve(const Measurement& a, const Measurement& b) {
  return a.test == b.test && a.index == b.index;
}

/// What is fitted is told from what is fitted: a row that is held out says nothing there.
bool may_tell(const Measurement& zero, const Measurement& row) {
  return row.use != MeasuredUse::kFit || zero.use == MeasuredUse::kFit;
}

constexpr const char* kNoUnloadedRow =
    ": its curve is told from its unloaded pose (relative), and has no unloaded row within "
    "2 degrees of this one (of a row to fit: one to fit): it is taken as it stands, and so are "
    "others like it";

/// The unloaded row of the same curve and coordinate whose flexion is nearest to that of a row; null
/// where none is near: a robot holds a flexion to a degree or so. Of two as near it is that of less flexion.
const Measurement* unloaded_of(const Measurement& row, const std::vector<Measurement>& unloaded) {
  constexpr double kNear = 2 * M_PI / 180, kSame = 1e-9;
  const Measurement* nearest = nullptr;
  double least = kNear;
  for (const Measurement& other : unloaded) {
    const double away = std::abs(other.flexion - row.flexion);
    if (!same_curve(row, other) || away > kNear || !may_tell(other, row)) continue;
    const bool as_near = nearest != nullptr && std::abs(away - least) < kSame;
    if (as_near ? other.flexion >= nearest->flexion : away >= least && nearest != nullptr) continue;
    nearest = &other;
    least = away;
  }
  return nearest;
}

/// Coordinates of relative curves less what their unloaded rows say, whose variance adds to theirs; as
/// they are where there is none. Unloaded rows then say nothing more and are left out.
void tell_from_unloaded(const Scene& scene, MeasurementTable& table) {
  std::vector<Measurement> unloaded;
  std::erase_if(table.rows, [&](const Measurement& row) {
    if (!is_told(row, scene) || !is_unloaded(row, scene)) return false;
    unloaded.push_back(row);
    return true;
  });
  std::set<std::pair<std::string, std::size_t>> warned;
  for (Measurement& row : table.rows) {
    if (!is_told(row, scene)) continue;
    const Measurement* zero = unloaded_of(row, unloaded);
    if (zero == nullptr) {
      const auto is_of_curve = [&](const Measurement& other) { return same_curve(row, other); };
      if (std::any_of(unloaded.begin(), unloaded.end(), is_of_curve) &&
          warned.emplace(row.test, row.index).second)
        table.warnings.push_back(name_of(row, table, scene) + kNoUnloadedRow);
      continue;
    }
    row.value -= zero->value;
    row.sd = std::hypot(row.sd, zero->sd);
    row.zero_flexion = zero->flexion;
  }
}

}  // namespace

MeasurementTable read_measurements(const Scene& scene) {
  if (!scene.calibration)
    throw InputError(scene.file.string() +
                     ": no table [calibrate], expected one that names measurements");
  const CsvFile csv = read_csv(scene.calibration->measurements, "a table of measurements (CSV)");
  check_units(csv, scene, lengths_and_angles(scene));
  const MeasurementColumns columns(csv);
  MeasurementTable table;
  table.file = csv.file;
  table.specimen = specimen_of(csv, columns, scene.calibration->specimen);
  std::map<RowKey, int> seen;
  for (const CsvRow& row : csv.rows) {
    if (columns.text(row, "specimen") != table.specimen && columns.has("specimen")) continue;
    if (use_of(row, columns) == MeasuredUse::kSkip) continue;
    const Measurement measured = read_measurement(row, columns, scene);
    const auto [first, fresh] = seen.try_emplace(key_of(measured, scene), measured.line);
    if (!fresh)
      columns.fail(row, "coordinate",
                   fmt::format("a row that stands once: line {} measures the same", first->second));
    table.rows.push_back(measured);
  }
  if (std::any_of(table.rows.begin(), table.rows.end(),
                  [&](const Measurement& row) { return has_moment(row, scene); }))
    check_units(csv, scene, moments(scene));
  check_relative(scene, table);
  tell_from_unloaded(scene, table);
  if (std::none_of(table.rows.begin(), table.rows.end(),
                   [](const Measurement& row) { return row.use == MeasuredUse::kFit; }))
    throw InputError(
        fmt::format("{}: no row to fit, expected one with use = fit", csv.file.string()));
  return table;
}

}  // namespace condyle
