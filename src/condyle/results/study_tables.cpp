#include "condyle/results/study_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/calibration/csv_text.h"
#include "condyle/input_error.h"
#include "condyle/results/output_file.h"
#include "condyle/results/study_reduction.h"

namespace condyle {
namespace {

std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

/// What is swept, or an output: "flexion deg".
template <class Quantity>
std::string column_of(const Quantity& quantity) {
  return quantity.unit.name == "1" ? quantity.name
                                   : fmt::format("{} {}", quantity.name, quantity.unit.name);
}

/// Calls `tell` with what is told of all knees, and of each where that is told.
template <class Tell>
void for_each_summary(const StudyView& view, const Tell& tell) {
  tell("all", view.all);
  for (std::size_t k = 0; k < view.by_knee.size(); ++k) tell(view.knees[k], view.by_knee[k]);
}

std::string cells(const std::vector<std::vector<IndexEstimate>>& estimates,
                  std::size_t parameter,
                  std::size_t pose) {
  if (estimates.empty()) return ",,";
  const IndexEstimate& e = estimates[parameter][pose];
  return fmt::format("{},{},{}", cell(e.value), cell(e.lower), cell(e.upper));
}

/// What is swept may vary, too, or be told as an output: then its column has another name than theirs.
std::string head_of_samples(const StudyPlan& plan, const SweptQuantity& swept) {
  std::vector<std::string> parameters, outputs;
  for (const StudyParameter& parameter : plan.parameters) parameters.push_back(parameter.name);
  for (const StudyOutput& output : plan.outputs) outputs.push_back(column_of(output));
  std::string of_sweep = column_of(swept);
  for (const std::vector<std::string>* taken : {&parameters, &outputs})
    if (std::find(taken->begin(), taken->end(), of_sweep) != taken->end()) {
      of_sweep.insert(0, "swept ");
      break;
    }
  std::string head = "sample,knee";
  for (const std::string& name : parameters) head.append(",").append(csv_text(name));
  head += fmt::format(",{},status", csv_text(of_sweep));
  for (const std::string& name : outputs) head.append(",").append(csv_text(name));
  return head + "\n";
}

}  // namespace

std::string bands_csv(const StudyView& view) {
  std::string csv = fmt::format("knee,output,unit,{},samples,nominal,mean,sd,p5,p25,p50,p75,p95\n",
                                csv_text(column_of(view.swept)));
  for_each_summary(view, [&](const std::string& knee, const StudySummary& summary) {
    for (std::size_t o = 0; o < view.outputs.size(); ++o) {
      const StudyBand& band = summary.bands[o];
      for (std::size_t p = 0; p < view.values.size(); ++p) {
        csv +=
            fmt::format("{},{},{},{},{},{},{},{}", csv_text(knee), csv_text(view.outputs[o].name),
                        csv_text(view.outputs[o].units), view.values[p], band.samples[p],
                        cell(band.nominal[p]), cell(band.mean[p]), cell(band.sd[p]));
        for (const std::vector<double>& quantile : band.quantiles)
          csv.append(",").append(cell(quantile[p]));
        csv += "\n";
      }
    }
  });
  return csv;
}

std::string indices_csv(const StudyView& view) {
  std::string csv = fmt::format(
      "knee,output,{},parameter,first,first_lower,first_upper,total,total_lower,total_upper,rank\n",
      csv_text(column_of(view.swept)));
  for_each_summary(view, [&](const std::string& knee, const StudySummary& summary) {
    for (std::size_t o = 0; o < view.outputs.size(); ++o) {
      const StudyEffects& effects = summary.effects[o];
      for (std::size_t p = 0; p < view.values.size(); ++p)
        for (std::size_t i = 0; i < view.parameters.size(); ++i)
          csv += fmt::format(
              "{},{},{},{},{},{},{}\n", csv_text(knee), csv_text(view.outputs[o].name),
              view.values[p], csv_text(view.parameters[i].name), cells(effects.first, i, p),
              cells(effects.total, i, p), effects.rank.empty() ? "" : cell(effects.rank[i][p]));
    }
  });
  return csv;
}

void write_sample_table(const std::filesystem::path& path,
                        const StudyPlan& plan,
                        const StudyJournals& journals) {
  const SweptQuantity swept = quantity_of_sweep(plan.knees.front().scene);
  const std::vector<std::string> knees = knee_names(plan);
  OutputFile file(path);
  std::string rows = head_of_samples(plan, swept);
  std::vector<double> theta;
  for (std::uint64_t c = 0; c < chunk_count(plan); ++c) {
    const StudyChunk chunk = journals.read(c);
    const double* value = chunk.values.data();
    const std::uint8_t* status = chunk.status.data();
    for (std::uint64_t i = 0; i < chunk.samples; ++i) {
      const std::uint64_t sample = c * kChunkSamples + i;
      plan.theta(sample, theta);
      std::string begin = fmt::format("{},{}", sample, csv_text(knees[plan.knee_of(sample)]));
      for (const double number : theta) begin.append(",").append(cell(number));
      for (const double swept_value : plan.values) {
        std::string row =
            fmt::format("{},{},{}", begin, swept.shown(swept_value),
                        csv_text(std::string(name(static_cast<PoseStatus>(*status++)))));
        for (std::size_t o = 0; o < plan.outputs.size(); ++o)
          row.append(",").append(cell(*value++));
        rows.append(row).append("\n");
      }
    }
    file.append(rows);
    rows.clear();
  }
  file.keep();
}

}  // namespace condyle
