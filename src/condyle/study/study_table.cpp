#include "condyle/study/study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/calibration/csv_file.h"
#include "condyle/elements/force_law.h"
#include "condyle/input_error.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {
namespace {

std::size_t column_of(const std::string& name, const CsvFile& csv) {
  const std::vector<std::string>& names = csv.header.fields;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(
        fmt::format("{}:{}: no column \"{}\", expected one for each number that varies",
                    csv.file.string(), csv.header.line, name));
  if (std::count(found, names.end(), name) > 1)
    throw InputError(fmt::format("{}:{}: two columns \"{}\", expected one", csv.file.string(),
                                 csv.header.line, name));
  return static_cast<std::size_t>(found - names.begin());
}

/// What the number of a scene is multiplied by to be the one inside.
double unit_of(const Scene& scene, const ModelParameter& number) {
  switch (number.kind) {
    case ParameterKind::kSlackLength:
    case ParameterKind::kInsertion:
      return scene.length_to_mm;
    case ParameterKind::kStiffness: {
      const bool quadratic =
          std::holds_alternative<QuadraticLaw>(scene.ligaments[number.index].law);
      return scene.force_to_n / (quadratic ? scene.length_to_mm * scene.length_to_mm : 1);
    }
    default:
      return 1;
  }
}

/// The strain at the start pose of one that a scene tells at another length: of as much slack length.
double strain_at_start(double strain, const FreeParameter& parameter, const Scene& scene) {
  const ModelParameter& moved = parameter.moves.front().first;
  if (moved.kind != ParameterKind::kReferenceStrain) return strain;
  const LigamentDescription& ligament = scene.ligaments[moved.index];
  if (!ligament.reference_length) return strain;
  const double start_length = slack_length(ligament.law) * (1 + parameter.start);
  return start_length * (1 + strain) / *ligament.reference_length - 1;
}

/// θ of a number that a table holds itself, in the scene's units; NaN where there is none.
double theta_of(double number, const FreeParameter& parameter, const Scene& scene) {
  const ModelParameter& moved = parameter.moves.front().first;
  const double inside = unit_of(scene, moved) * number;
  if (!parameter.logarithmic) return strain_at_start(inside, parameter, scene) - parameter.start;
  const bool load = moved.kind == ParameterKind::kLoadScale;
  const double nominal = load ? scene.loads[moved.index].scale : parameter.start;
  return inside / nominal > 0 ? std::log(inside / nominal) : std::nan("");
}

/// What several numbers have in common is a change and no value, and what is swept has a value of the sweep.
void expect_own_values(const CsvFile& csv,
                       const std::vector<FreeParameter>& numbers,
                       const Scene& scene) {
  const int swept = quantity_of_sweep(scene).load;
  for (const FreeParameter& number : numbers) {
    const ModelParameter& moved = number.moves.front().first;
    if (moved.kind == ParameterKind::kLoadScale && static_cast<int>(moved.index) == swept)
      throw InputError(
          fmt::format("{}:{}: {}, a load that is swept and has no value of its own, expected a "
                      "table of \"changes\"",
                      csv.file.string(), csv.header.line, number.name));
    if (number.together)
      throw InputError(fmt::format(
          "{}:{}: {}, a change that several numbers have in common, expected a table of "
          "\"changes\", or together = false",
          csv.file.string(), csv.header.line, number.name));
  }
}

}  // namespace

std::vector<std::vector<double>> read_study_table(const StudyDescription& study,
                                                  const std::vector<std::string>& names,
                                                  const std::vector<FreeParameter>& numbers,
                                                  const Scene& scene) {
  const CsvFile csv = read_csv(study.table, "a table of points (CSV)");
  const std::string file = study.table.string();
  if (study.table_holds_values) expect_own_values(csv, numbers, scene);
  std::vector<std::size_t> columns;
  for (const std::string& name : names) columns.push_back(column_of(name, csv));
  std::vector<std::vector<double>> points;
  for (const CsvRow& row : csv.rows) {
    if (study.samples > 0 && points.size() == static_cast<std::size_t>(study.samples)) break;
    std::vector<double>& theta = points.emplace_back();
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const std::string& field = row.fields[columns[j]];
      double value = csv_number(field);
      const bool itself = study.table_holds_values && j < numbers.size();
      if (itself && std::isfinite(value)) value = theta_of(value, numbers[j], scene);
      if (!std::isfinite(value))
        throw InputError(
            fmt::format("{}:{}: {} = {}, expected {}", file, row.line, names[j], field,
                        itself && numbers[j].logarithmic ? "a number > 0" : "a number"));
      theta.push_back(value);
    }
  }
  if (points.empty()) throw InputError(fmt::format("{}: no rows, expected a point in each", file));
  if (study.samples > 0 && points.size() < static_cast<std::size_t>(study.samples))
    throw InputError(fmt::format("{}: {} rows, expected {} (samples = {})", file, points.size(),
                                 study.samples, study.samples));
  return points;
}

}  // namespace condyle
