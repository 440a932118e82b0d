/// Tables of a calibration for other programs (calibration_words.h).

#include <fmt/format.h>

#include <cmath>

#include "condyle/calibration/calibration_words.h"
#include "condyle/calibration/csv_text.h"
#include "condyle/calibration/told_parameter.h"
#include "condyle/calibration/told_units.h"

namespace condyle {
namespace {

/// Empty for a number that is none.
std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

std::string latex_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '\\':
        escaped += "\\textbackslash{}";
        break;
      case '^':
      case '~':
        escaped += fmt::format("\\{}{{}}", c);
        break;
      case '[':  // after the end of a row these two would be part of it
      case '*':
        escaped += fmt::format("{{{}}}", c);
        break;
      case '{':
      case '}':
      case '$':
      case '&':
      case '#':
      case '_':
      case '%':
        escaped += '\\';
        [[fallthrough]];
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string latex_number(double value) {
  return std::isnan(value) ? "--" : fmt::format("${:.3g}$", value);
}

}  // namespace

std::string parameter_csv(const CalibrationResult& result) {
  std::string csv = "parameter,unit,scene,prior_sd,mean,sd,sample_sd,shrinkage,at_bound\n";
  for (const ToldParameter& p : told_parameters(result))
    csv +=
        fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_text(p.name), p.unit, csv_number(p.scene),
                    csv_number(p.prior_sd), csv_number(p.mean), csv_number(p.sd),
                    csv_number(p.sample_sd), csv_number(p.shrinkage), p.at_bound ? "yes" : "no");
  return csv;
}

std::string parameter_latex(const CalibrationResult& result) {
  std::string latex =
      "\\begin{tabular}{llrrrrr}\n\\hline\n"
      "parameter & unit & scene & prior sd & mean & sd & sd/prior sd \\\\\n\\hline\n";
  for (const ToldParameter& p : told_parameters(result)) {
    latex += fmt::format("{} & {} & {} & {} & {} & ", latex_text(p.name), latex_text(p.unit),
                         latex_number(p.scene), latex_number(p.prior_sd), latex_number(p.mean));
    latex += p.at_bound ? "at its bound & --"
                        : latex_number(p.best_sd()) + " & " + latex_number(p.shrinkage);
    latex += " \\\\\n";
  }
  return latex + "\\hline\n\\end{tabular}\n";
}

std::string samples_csv(const CalibrationResult& result) {
  std::string csv;
  for (std::size_t j = 0; j < result.parameters.size(); ++j) {
    if (j > 0) csv += ',';
    csv += csv_text(result.parameters[j].name);
  }
  csv += '\n';
  for (Eigen::Index i = 0; i < result.samples.rows(); ++i) {
    for (Eigen::Index j = 0; j < result.samples.cols(); ++j) {
      const double unit = unit_of_theta(result.parameters[static_cast<std::size_t>(j)]).factor;
      csv += fmt::format("{}{}", j > 0 ? "," : "", result.samples(i, j) / unit);
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace condyle
