#include "condyle/results/uncertainty_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "condyle/math/no_number.h"

namespace condyle {
namespace {

/// Makes or enters the groups of "contacts/medial/force" down to its dataset.
Hdf5Group group_of(const Hdf5Group& group, const std::string& place, std::string& dataset) {
  const std::size_t slash = place.find('/');
  dataset = place.substr(slash + 1);
  const std::string first = place.substr(0, slash);
  Hdf5Group inner = group.has(first) ? group.open(first) : group.create(first);
  if (dataset.find('/') == std::string::npos) return inner;
  return group_of(inner, std::string(dataset), dataset);
}

void write_numbers(const Hdf5Group& group,
                   const std::vector<SensitivityOutput>& outputs,
                   const std::vector<std::vector<double>>& numbers) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    std::vector<double> shown;
    for (const double value : numbers[i]) shown.push_back(value / outputs[i].unit.factor);
    std::string dataset;
    const Hdf5Group inner = group_of(group, outputs[i].place, dataset);
    inner.write(dataset, shown, {shown.size()}, outputs[i].unit.name);
  }
}

std::vector<std::vector<double>> read_numbers(const Hdf5Group& group,
                                              const std::vector<SensitivityOutput>& outputs,
                                              std::size_t poses) {
  std::vector<std::vector<double>> numbers;
  for (const SensitivityOutput& output : outputs) {
    std::string dataset;
    const Hdf5Group inner = group_of(group, output.place, dataset);
    std::vector<double> values = inner.read(dataset, {poses});
    for (double& value : values) value *= output.unit.factor;
    numbers.push_back(std::move(values));
  }
  return numbers;
}

void write_surfaces(const Hdf5Group& group, const std::vector<RoughSurface>& surfaces) {
  std::vector<std::string> names;
  std::vector<double> rms, correlation, left;
  for (const RoughSurface& surface : surfaces) {
    names.push_back(surface.surface);
    rms.push_back(surface.texture.rms);
    correlation.push_back(surface.texture.correlation);
    left.push_back(surface.texture.left);
  }
  group.write("surface", names);
  group.write("rms", rms, {rms.size()}, "mm");
  group.write("correlation", correlation, {rms.size()}, "mm");
  group.write("left", left, {rms.size()}, "mm");
}

std::vector<RoughSurface> read_surfaces(const Hdf5Group& group) {
  std::vector<RoughSurface> surfaces;
  const std::vector<std::string> names = group.read_texts("surface");
  const std::vector<double> rms = group.read("rms", {names.size()}),
                            correlation = group.read("correlation", {names.size()}),
                            left = group.read("left", {names.size()});
  for (std::size_t i = 0; i < names.size(); ++i)
    surfaces.push_back({names[i], {rms[i], correlation[i], left[i]}});
  return surfaces;
}

/// Greatest standard deviation of the outputs whose place begins so and whose unit is that.
double greatest_sd(const MeshUncertainty& all, const char* begin, const char* unit) {
  double greatest = kNoNumber;
  for (std::size_t i = 0; i < all.outputs.size(); ++i) {
    const SensitivityOutput& output = all.outputs[i];
    if (output.place.rfind(begin, 0) != 0 || output.unit.name != unit) continue;
    for (const double sd : all.sd[i])
      if (std::isfinite(sd)) greatest = std::fmax(greatest, sd / output.unit.factor);
  }
  return greatest;
}

/// "-" for none.
std::string two_digits(double number) {
  return std::isfinite(number) ? fmt::format("{:.2g}", number) : "-";
}

}  // namespace

void write_uncertainty(const Hdf5Group& group, const MeshUncertainty& uncertainty) {
  group.write("sweeps", std::vector<int>{uncertainty.sweeps}, {}, "1");
  group.write("failed_fits", std::vector<int>{uncertainty.failed_fits}, {}, "1");
  group.write("converged", uncertainty.converged, {uncertainty.converged.size()}, "1");
  write_surfaces(group.create("roughness"), uncertainty.surfaces);
  write_numbers(group.create("sd"), uncertainty.outputs, uncertainty.sd);
  write_numbers(group.create("shift"), uncertainty.outputs, uncertainty.shift);
}

std::shared_ptr<const MeshUncertainty> read_uncertainty(const Hdf5Group& group,
                                                        const Scene& scene,
                                                        std::size_t poses) {
  const auto read = std::make_shared<MeshUncertainty>();
  read->outputs = uncertain_outputs(scene);
  read->sweeps = group.read_integers("sweeps", {}).front();
  read->failed_fits = group.read_integers("failed_fits", {}).front();
  read->converged = group.read_integers("converged", {poses});
  read->surfaces = read_surfaces(group.open("roughness"));
  read->sd = read_numbers(group.open("sd"), read->outputs, poses);
  read->shift = read_numbers(group.open("shift"), read->outputs, poses);
  return read;
}

const std::vector<double>* inside_sd(const MeshUncertainty& uncertainty, const std::string& place) {
  for (std::size_t i = 0; i < uncertainty.outputs.size(); ++i)
    if (uncertainty.outputs[i].place == place) return &uncertainty.sd[i];
  return nullptr;
}

double interval_of(int sweeps) {
  constexpr double kOfTwo = 12.706;  // too far from the normal one
  if (sweeps <= 2) return kOfTwo;
  // Cornish and Fisher's expansion of Student's t about the normal quantile, [Abramowitz 26.7.5].
  const double z = 1.959964, n = sweeps - 1;
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

std::string uncertainty_words(const MeshUncertainty& uncertainty) {
  std::string noise, broad;
  for (const RoughSurface& surface : uncertainty.surfaces) {
    noise += fmt::format("{}{:.2f}", noise.empty() ? "" : ", ", surface.texture.rms);
    if (is_broad(surface.texture))
      broad += fmt::format("{}\"{}\"", broad.empty() ? "" : ", ", surface.surface);
  }
  const auto greatest = [&](const char* begin, const char* unit) {
    return two_digits(greatest_sd(uncertainty, begin, unit));
  };
  int solved = 0;
  for (const int count : uncertainty.converged) solved += count;
  const std::size_t poses =
      uncertainty.converged.size() * static_cast<std::size_t>(uncertainty.sweeps);
  return fmt::format(
      "mesh noise of {} mm rms: in {} sweeps a standard deviation of up to {} deg, {} mm, "
      "contact forces {} N, ligament forces {} N; {} of {} poses solved{}{}",
      noise, uncertainty.sweeps, greatest("joint/", "deg"), greatest("joint/", "mm"),
      greatest("contacts/", "N"), greatest("ligaments/", "N"), solved, poses,
      uncertainty.failed_fits > 0 ? fmt::format(", fits that failed: {}", uncertainty.failed_fits)
                                  : std::string(),
      broad.empty() ? std::string()
                    : "; at most so much: what is left beside " + broad +
                          " is as broad as the smoothing, so that the bone's own shape is in it");
}

}  // namespace condyle
