#include "condyle/results/study_shown.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "condyle/calibration/shown_numbers.h"
#include "condyle/input_error.h"
#include "condyle/results/study_words.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {
namespace {

constexpr double kLeastForce = 0.5;  // what has to be carried to be shown [N]

std::set<std::string> ligaments_of(const StudyView& study) {
  std::set<std::string> names;
  if (study.scenes.empty() || study.scenes.front().empty()) return names;
  try {
    for (const LigamentDescription& ligament : parse_scene(study.scenes.front(), "").ligaments)
      names.insert(ligament.name);
  } catch (const InputError&) {
    // Of a newer program: nothing is known of it but its words.
  }
  return names;
}

std::string quantity_of(const std::string& units, const std::string& word) {
  const std::string unit = " [" + shown_unit(units) + "]";
  if (word == "force") return "Force" + unit;
  if (word == "strain") return "Strain" + unit;
  if (word == "length") return "Length" + unit;
  if (word.rfind("point", 0) == 0) return "Place" + unit;
  return (units == "deg" ? "Rotation" : "Translation") + unit;
}

std::string after_number(const std::string& units) {
  if (units == "1") return {};
  return units == "deg" ? "°" : " " + units;
}

/// "aACL.force", "medial.point.x", "anterior_drawer".
ShownOutput shown_output(const StudyView::Output& output, const std::set<std::string>& ligaments) {
  ShownOutput shown;
  std::string of = output.name, word;
  for (const char* known : {".force", ".strain", ".length", ".point.x", ".point.y", ".point.z"})
    if (output.name.ends_with(known)) {
      of = output.name.substr(0, output.name.size() - std::string(known).size());
      word = std::string(known).substr(1);
    }
  const bool ligament = ligaments.contains(of) || word == "strain" || word == "length";
  shown.force = word == "force";
  shown.group = word.empty() ? StudyGroup::kJoint
                : ligament   ? StudyGroup::kLigament
                             : StudyGroup::kContact;
  if (word.empty()) std::replace(of.begin(), of.end(), '_', ' ');
  shown.name = of + (shown.group == StudyGroup::kContact ? " contact" : "");
  std::replace(word.begin(), word.end(), '.', ' ');
  if (!word.empty() && !shown.force) shown.name += " " + word;
  shown.quantity = quantity_of(output.units, word);
  shown.unit = after_number(output.units);
  return shown;
}

double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
  const std::size_t n = std::min(count, most);
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < n; ++k) chosen.push_back(n == 1 ? 0 : k * (count - 1) / (n - 1));
  return chosen;
}

std::vector<std::size_t> at_angles(const std::vector<double>& degrees) {
  constexpr double kNear = 5.1;
  std::vector<std::size_t> found;
  for (const double angle : {0.0, 30.0, 60.0, 90.0}) {
    const auto nearer = [&](double a, double b) {
      return std::abs(a - angle) < std::abs(b - angle);
    };
    const auto at = std::min_element(degrees.begin(), degrees.end(), nearer);
    const auto index = static_cast<std::size_t>(at - degrees.begin());
    if (at == degrees.end() || std::abs(*at - angle) > kNear) continue;
    if (std::find(found.begin(), found.end(), index) == found.end()) found.push_back(index);
  }
  return found;
}

/// Mean over the poses, each with its weight.
class Weighted {
 public:
  void add(double value, double weight) {
    if (!std::isfinite(value) || !(weight > 0)) return;
    sum_ += weight * value;
    weights_ += weight;
  }
  [[nodiscard]] double mean() const { return weights_ > 0 ? sum_ / weights_ : std::nan(""); }

 private:
  double sum_ = 0, weights_ = 0;
};

}  // namespace

std::vector<ShownOutput> shown_outputs(const StudyView& study) {
  const std::set<std::string> ligaments = ligaments_of(study);
  std::vector<ShownOutput> shown;
  for (std::size_t i = 0; i < study.outputs.size(); ++i) {
    shown.push_back(shown_output(study.outputs[i], ligaments));
    shown.back().index = i;
  }
  return shown;
}

bool carries(const StudyBand& band, const ShownOutput& output) {
  return greatest(band.quantiles.back()) > (output.force ? kLeastForce : 0) ||
         greatest(band.nominal) > (output.force ? kLeastForce : 0);
}

std::vector<ShownOutput> main_outputs(const StudyView& study, std::size_t ligaments) {
  std::vector<ShownOutput> all = shown_outputs(study);
  std::vector<double> spread;
  for (const ShownOutput& output : all)
    if (output.group == StudyGroup::kLigament)
      spread.push_back(greatest(study.all.bands.at(output.index).sd));
  std::sort(spread.begin(), spread.end(), std::greater<>());
  const double least = spread.size() > ligaments ? spread[ligaments] : 0;
  std::erase_if(all, [&](const ShownOutput& output) {
    const double sd = greatest(study.all.bands.at(output.index).sd);
    return !(sd > (output.group == StudyGroup::kLigament ? least : 0));
  });
  return all;
}

std::vector<std::size_t> shown_poses(const StudyView& study) {
  if (study.swept.flexion) {
    std::vector<std::size_t> usual = at_angles(study.values);
    if (usual.size() >= 2) return usual;
  }
  return evenly(study.values.size(), 4);
}

std::string shown_pose(const StudyView& study, std::size_t pose) {
  return with_unit(study.swept, study.values.at(pose) * study.swept.unit.factor);
}

std::vector<double> shown_values(const StudyView& study) {
  std::vector<double> values;
  for (const double value : study.values)
    values.push_back(value * study.swept.unit.factor * study.swept.axis_per_inside);
  return values;
}

std::vector<std::string> shown_parameters(const StudyView& study) {
  std::vector<std::string> names;
  for (const StudyView::Parameter& parameter : study.parameters)
    names.push_back(shown_name(parameter.name));
  return names;
}

bool has_indices(const StudyView& study) {
  return std::any_of(study.all.effects.begin(), study.all.effects.end(),
                     [](const StudyEffects& effects) { return !effects.total.empty(); });
}

SweepEffects sweep_effects(const StudyView& study, std::size_t output) {
  const StudyBand& band = study.all.bands.at(output);
  const std::vector<double>& sd = band.sd;
  const StudyEffects& effects = study.all.effects.at(output);
  const bool indices = !effects.total.empty();
  SweepEffects of;
  for (std::size_t j = 0; j < study.parameters.size(); ++j) {
    Weighted first, total;
    for (std::size_t pose = 0; pose < sd.size(); ++pose) {
      const double weight = sd[pose] * sd[pose];
      const double rank = effects.rank.empty() ? std::nan("") : effects.rank.at(j).at(pose);
      const bool chance = std::isnan(known_rank(rank, independent_samples(study, band, pose)));
      const double square = chance ? 0 * rank : rank * rank;
      first.add(indices ? known_value(effects.first.at(j).at(pose)) : square, weight);
      total.add(indices ? known_value(effects.total.at(j).at(pose)) : square, weight);
    }
    of.first.push_back(first.mean());
    of.total.push_back(total.mean());
  }
  return of;
}

std::vector<std::size_t> greatest_first(const std::vector<double>& by) {
  std::vector<std::size_t> order(by.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto size = [&](std::size_t j) { return std::isfinite(by[j]) ? by[j] : -1e300; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  return order;
}

}  // namespace condyle
