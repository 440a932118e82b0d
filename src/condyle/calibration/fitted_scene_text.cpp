/// The scene's text with fitted numbers (calibration_words.h).

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "condyle/calibration/calibration_words.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/moved_paths.h"
#include "condyle/scene_file/scene_words.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

/// A table of the file whose numbers change.
class EditedTable {
 public:
  EditedTable(const Scene& scene, const Value& table, std::string label, std::vector<TextEdit>& out)
      : scene_(scene), table_(table), label_(std::move(label)), out_(out) {}

  [[nodiscard]] bool has(const char* key) const { return table_.find(key) != nullptr; }
  [[nodiscard]] double number(const char* key) const { return place(table_.find(key), key).number; }

  void set(const char* key, double inside, double unit) const {
    out_.push_back(edit_of(place(table_.find(key), key), number_text(inside, unit)));
  }
  void set(const Value* vector,
           const std::string& key,
           const Eigen::Vector3d& inside,
           double unit) const {
    for (std::size_t c = 0; c < 3; ++c) {
      const bool there = vector != nullptr && c < vector->items.size();
      const Value& number = place(there ? &vector->items[c] : nullptr, key);
      out_.push_back(edit_of(number, number_text(inside[static_cast<Eigen::Index>(c)], unit)));
    }
  }
  [[nodiscard]] const Value* find(const char* key) const { return table_.find(key); }

 private:
  const Value& place(const Value* value, const std::string& key) const {
    if (value == nullptr || !value->is_number() || value->column <= 0 || value->end <= 0)
      throw InputError(fmt::format(
          "{}:{}: {}: {} is fitted, but no number of the text says it, expected one to change",
          scene_.file.string(), table_.line, label_, key));
    return *value;
  }

  const Scene& scene_;
  const Value& table_;
  std::string label_;
  std::vector<TextEdit>& out_;
};

/// Whether two numbers are the same but for rounding; of size about 1 for strains.
bool same(double a, double b) {
  constexpr double kRounding = 1e-14;
  return std::abs(a - b) <= kRounding * std::max(1.0, std::abs(a));
}

void set_slack(const EditedTable& table, const Scene& scene, const LigamentDescription& fitted) {
  const double slack = slack_length(fitted.law);
  if (!table.has("reference_strain")) {
    table.set("slack_length", slack, scene.length_to_mm);
  } else if (table.has("reference_length")) {
    const double length = scene.length_to_mm * table.number("reference_length");
    table.set("reference_strain", length / slack - 1, 1);
  }
}

double stiffness_of(const ForceLaw& law) {
  if (const auto* toe_linear = std::get_if<ToeLinearLaw>(&law)) return toe_linear->stiffness;
  const auto* quadratic = std::get_if<QuadraticLaw>(&law);
  return quadratic != nullptr ? quadratic->stiffness : 0;
}

void set_law(const EditedTable& table,
             const Scene& scene,
             const LigamentDescription& was,
             const LigamentDescription& fitted) {
  if (stiffness_of(fitted.law) != stiffness_of(was.law)) {
    const bool quadratic = std::holds_alternative<QuadraticLaw>(was.law);
    const double area = quadratic ? scene.length_to_mm * scene.length_to_mm : 1;
    table.set("stiffness", stiffness_of(fitted.law), scene.force_to_n / area);
  }
  const auto *toe_was = std::get_if<ToeLinearLaw>(&was.law),
             *toe_fitted = std::get_if<ToeLinearLaw>(&fitted.law);
  if (toe_was != nullptr && toe_was->transition_strain != toe_fitted->transition_strain)
    table.set("transition_strain", toe_fitted->transition_strain, 1);
  // A strain at the start pose keeps its meaning where insertions have moved.
  if (fitted.reference_strain) {
    if (!same(*fitted.reference_strain, table.number("reference_strain")))
      table.set("reference_strain", *fitted.reference_strain, 1);
  } else if (slack_length(fitted.law) != slack_length(was.law)) {
    set_slack(table, scene, fitted);
  }
}

void set_ends(const EditedTable& table,
              const Scene& scene,
              const LigamentDescription& was,
              const LigamentDescription& fitted) {
  const Value* ends = table.find("ends");
  for (std::size_t k = 0; k < 2; ++k) {
    if (was.ends[k].at == fitted.ends[k].at) continue;
    const bool there = ends != nullptr && k < ends->items.size();
    const Value* at = there ? ends->items[k].find("at") : nullptr;
    table.set(at, fmt::format("at of ends[{}]", k), fitted.ends[k].at, scene.length_to_mm);
  }
}

const Value& table_at(const Value& document, const char* key, std::size_t index) {
  const Value* list = document.find(key);
  static const Value none;
  return list != nullptr && index < list->items.size() ? list->items[index] : none;
}

void set_loads(const Value& document,
               const Scene& scene,
               const Scene& fitted,
               std::vector<TextEdit>& edits) {
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const LoadDescription& load = fitted.loads[i];
    if (load.vector == scene.loads[i].vector) continue;
    const EditedTable table(scene, table_at(document, "load", i),
                            fmt::format("[[load]] \"{}\"", load.name), edits);
    const double unit = scene.force_to_n * (load.moment ? scene.length_to_mm : 1);
    table.set(table.find("vector"), "vector", load.vector, unit);
  }
}

std::string first_line(const CalibrationResult& result) {
  const MeasurementTable& table = result.table;
  const std::string specimen =
      table.specimen.empty() ? "" : fmt::format(", specimen {}", table.specimen);
  return scene_comment(fmt::format(
             "Fitted by condyle calibrate to {}{}: {} numbers of {} rows{}",
             table.file.filename().string(), specimen, result.fit.theta.size(), result.fitted.rows,
             result.stopped && !result.fit.converged ? "; stopped before the least" : "")) +
         "\n";
}

}  // namespace

std::string fitted_scene_text(const Scene& scene,
                              const CalibrationResult& result,
                              const fs::path& file) {
  const Value document = parse_document(scene.text, scene.file.string());
  const Eigen::VectorXd& theta = result.fit.theta;
  const Scene fitted = scene_with(scene, result.parameters, {theta.begin(), theta.end()});
  std::vector<TextEdit> edits;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDescription &was = scene.ligaments[i], &now = fitted.ligaments[i];
    const EditedTable table(scene, table_at(document, "ligament", i),
                            fmt::format("[[ligament]] \"{}\"", was.name), edits);
    set_ends(table, scene, was, now);
    set_law(table, scene, was, now);
  }
  set_loads(document, scene, fitted, edits);
  if (!file.empty())
    for (TextEdit& edit : moved_paths(document, scene.file, file)) edits.push_back(std::move(edit));
  std::string text = edited(scene.text, edits);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a byte-order mark may only come first
  return first_line(result) + text;
}

}  // namespace condyle
