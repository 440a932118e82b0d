#include "condyle/app/range_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "condyle/input_error.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {
namespace {

/// What the scene says, and the options in its place. A list of values has no step of its own.
WrittenRange range_of(const std::string& file,
                      const RangeOptions& options,
                      const SweepDescription& sweep) {
  const bool whole = options.from && options.to && (options.step || *options.from == *options.to);
  if (!sweep.range && !whole)
    throw InputError(
        file + ": [sweep] lists values, expected --from, --to and --step to stand in for them");
  WrittenRange range = sweep.range.value_or(WrittenRange{});
  range.from = options.from.value_or(range.from);
  range.to = options.to.value_or(range.to);
  range.step = options.step.value_or(range.step);
  return range;
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
  const double unit = quantity_of_sweep(scene).declared.factor;
  const WrittenRange range = range_of(file, options, *scene.sweep);
  std::vector<double>& values = scene.sweep->values;
  try {
    values = range_values(range);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--from, --to, --step: {}", error.what()));
  }
  scene.sweep->range = range;
  for (double& value : values) value *= unit;
  if (const std::string fault = fault_of_values(scene); !fault.empty())
    throw InputError("--from, --to, --step: " + fault);
}

}  // namespace condyle
