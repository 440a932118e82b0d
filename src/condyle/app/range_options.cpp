#include "condyle/app/range_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "condyle/input_error.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {
namespace {

// Without the last digits, which the way from degrees to radians and back has left.
double rounded(double number) {
  return std::strtod(fmt::format("{:.12g}", number).c_str(), nullptr);
}

}  // namespace

void add_range_options(CLI::App& command, RangeOptions& options) {
  command.add_option("--from", options.from, "first value, in the unit of the scene");
  command.add_option("--to", options.to, "last value");
  command.add_option("--step", options.step, "step between values");
}

void override_range(const std::string& file, const RangeOptions& options, Scene& scene) {
  if (!scene.sweep)
    throw InputError(file + ": [sweep] is missing, expected what to vary and how far");
  if (!options.from && !options.to && !options.step) return;
  std::vector<double>& values = scene.sweep->values;
  const double unit = quantity_of_sweep(scene).declared.factor;
  const double from = rounded(values.front() / unit), to = rounded(values.back() / unit);
  const double step = values.size() > 1 ? rounded((values[1] - values[0]) / unit) : 1;
  try {
    values = range_values(options.from.value_or(from), options.to.value_or(to),
                          options.step.value_or(step));
  } catch (const InputError& error) {
    throw InputError(fmt::format("--from, --to, --step: {}", error.what()));
  }
  for (double& value : values) value *= unit;
}

}  // namespace condyle
