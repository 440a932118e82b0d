#include "condyle/calibration/calibration_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/calibration/told_parameter.h"
#include "condyle/calibration/words_of_agreement.h"

namespace condyle {
namespace {

void add(Lines& lines, const Lines& more) { lines.insert(lines.end(), more.begin(), more.end()); }

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

std::string head_line(const CalibrationResult& result) {
  const auto nuisance = std::count_if(result.parameters.begin(), result.parameters.end(),
                                      [](const FreeParameter& p) { return p.nuisance(); });
  const std::string& specimen = result.table.specimen;
  return fmt::format("{} numbers of the knee{} fitted to {} rows of {}{}, {} rows unseen",
                     result.parameters.size() - static_cast<std::size_t>(nuisance),
                     nuisance > 0 ? fmt::format(" and {} of the measurement", nuisance) : "",
                     result.fitted.rows, result.table.file.filename().string(),
                     specimen.empty() ? "" : ", specimen " + specimen, result.unseen.rows);
}

Lines direction_lines(const CalibrationResult& result) {
  constexpr int kMost = 5;
  const Eigen::VectorXd& s = result.known.singular_values;
  const Eigen::Index free = free_directions(result);
  if (free == 0) return {};
  Lines lines = {fmt::format(
      "{} of {} directions are determined by the data (singular values {:.3g} ... {:.3g}, above 1: "
      "the data say more than the prior)",
      result.known.determined, free, s.head(free).maxCoeff(), s.head(free).minCoeff())};
  const Lines weak = weak_directions(result, kMost);
  if (weak.empty()) return lines;
  lines.emplace_back("Weakest directions, known from the prior above all:");
  for (const std::string& line : weak) lines.push_back("  " + line);
  return lines;
}

std::string remark_on(const ToldParameter& told) {
  if (told.at_bound) return "  at its bound";
  return told.parts ? fmt::format("  sd of samples; delta method {}", number(told.sd)) : "";
}

Lines parameter_lines(const CalibrationResult& result) {
  std::size_t width = 10;
  const std::vector<ToldParameter> all = told_parameters(result);
  for (const ToldParameter& told : all) width = std::max(width, told.name.size() + 2);
  Lines lines = {fmt::format("{:<{}}{:<8}{:>10}{:>10}{:>12}{:>10}{:>11}", "number", width, "unit",
                             "scene", "prior sd", "fitted", "sd", "sd/prior")};
  for (const ToldParameter& told : all)
    lines.push_back(fmt::format("{:<{}}{:<8}{:>10}{:>10}{:>12}{:>10}{:>11}{}", told.name, width,
                                told.unit, number(told.scene), number(told.prior_sd),
                                number(told.mean), told.at_bound ? "-" : number(told.best_sd()),
                                told.at_bound ? "-" : number(told.shrinkage), remark_on(told)));
  if (std::any_of(all.begin(), all.end(), [](const auto& told) { return told.unit == "factor"; }))
    lines.emplace_back("(sd of a factor: of its logarithm)");
  return lines;
}

std::string names(const std::vector<std::string>& of) {
  return fmt::format("{}", fmt::join(of, ", "));
}

Lines bound_and_silence_lines(const CalibrationResult& result) {
  Lines lines;
  std::vector<std::string> at_bound, parting;
  for (const ToldParameter& told : told_parameters(result)) {
    if (told.at_bound) at_bound.push_back(told.name);
    if (told.parts) parting.push_back(told.name);
  }
  if (!at_bound.empty())
    lines.push_back("At a bound, held there by it and not by the data: " + names(at_bound));
  if (!result.silent.empty())
    lines.push_back("Carry nothing in any fitted test, known from the prior alone: " +
                    names(result.silent));
  if (!parting.empty())
    lines.push_back("Samples and delta method part by more than 10 %, the samples' sd is told: " +
                    names(parting));
  return lines;
}

/// Tests of fitted rows whose derivatives jump at the least, each once.
Lines kink_lines(const Scene& scene, const CalibrationResult& result) {
  if (result.fit.one_sided.empty()) return {};
  std::vector<const Measurement*> fitted;
  for (const Measurement& row : result.table.rows)
    if (row.use == MeasuredUse::kFit) fitted.push_back(&row);
  std::vector<std::string> tests;
  for (const Eigen::Index i : result.fit.one_sided) {
    const std::string name = name_of(*fitted.at(static_cast<std::size_t>(i)), result.table, scene);
    if (std::find(tests.begin(), tests.end(), name) == tests.end()) tests.push_back(name);
  }
  constexpr std::size_t kMost = 3;
  const std::size_t more = tests.size() > kMost ? tests.size() - kMost : 0;
  tests.resize(tests.size() - more);
  return {fmt::format(
      "The least lies where a contact opens or closes: deviations hold on one side of it ({}{})",
      fmt::join(tests, "; "), more > 0 ? fmt::format(" and {} more", more) : "")};
}

}  // namespace

Eigen::Index free_directions(const CalibrationResult& result) {
  const auto bound = std::count(result.at_bound.begin(), result.at_bound.end(), true);
  return std::max<Eigen::Index>(result.known.singular_values.size() - bound, 0);
}

std::vector<std::string> weak_directions(const CalibrationResult& result, int most) {
  constexpr double kShare = 0.3;
  const Identifiability& known = result.known;
  Lines lines;
  for (Eigen::Index k = free_directions(result) - 1; k >= 0; --k) {
    if (!(known.singular_values[k] < 1) || static_cast<int>(lines.size()) >= most) break;
    std::vector<std::pair<double, std::string>> shares;
    for (Eigen::Index j = 0; j < known.directions.rows(); ++j)
      if (std::abs(known.directions(j, k)) > kShare)
        shares.emplace_back(known.directions(j, k),
                            result.parameters[static_cast<std::size_t>(j)].name);
    std::stable_sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
      return std::abs(a.first) > std::abs(b.first);
    });
    std::vector<std::string> words;
    const double sign = !shares.empty() && shares.front().first < 0 ? -1 : 1;
    for (const auto& [share, name] : shares)
      words.push_back(fmt::format("{}: {:.2f}", name, sign * share));
    lines.push_back(fmt::format("{:<8.2g} {}", known.singular_values[k],
                                words.empty() ? "many numbers together" : names(words)));
  }
  return lines;
}

std::vector<std::string> calibration_remarks(const Scene& scene, const CalibrationResult& result) {
  Lines lines = {head_line(result)};
  for (const Lines& more :
       {fit_lines(result), start_lines(result), caution_lines(result), kink_lines(scene, result),
        direction_lines(result), bound_and_silence_lines(result), chi_square_lines(result)})
    add(lines, more);
  return lines;
}

std::vector<std::string> calibration_lines(const Scene& scene, const CalibrationResult& result) {
  Lines lines = {head_line(result)};
  add(lines, fit_lines(result));
  add(lines, start_lines(result));
  add(lines, caution_lines(result));
  add(lines, kink_lines(scene, result));
  const auto part = [&](const Lines& more) {
    if (more.empty()) return;
    lines.emplace_back();
    add(lines, more);
  };
  part(direction_lines(result));
  part(parameter_lines(result));
  part(bound_and_silence_lines(result));
  part(chi_square_lines(result));
  part(agreement_lines(result));
  part(suggestion_lines(scene, result));
  return lines;
}

}  // namespace condyle
