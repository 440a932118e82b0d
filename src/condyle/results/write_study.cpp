#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <limits>

#include "condyle/contact/pose_status.h"
#include "condyle/input_error.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/output_file.h"
#include "condyle/results/study_file.h"
#include "condyle/results/study_groups.h"
#include "condyle/results/study_reduction.h"
#include "condyle/version.h"

namespace condyle {
namespace {

/// Numbers that are held before they are written.
constexpr std::size_t kHeldNumbers = std::size_t{1} << 20;

std::string design_word(DesignKind kind) {
  switch (kind) {
    case DesignKind::kMonteCarlo:
      return "monte-carlo";
    case DesignKind::kLatinHypercube:
      return "latin-hypercube";
    case DesignKind::kSobol:
      return "sobol";
    case DesignKind::kSaltelli:
      return "saltelli";
    case DesignKind::kGrid:
      return "grid";
    case DesignKind::kTable:
      break;
  }
  return "table";
}

/// Ends of a factor are told as factors, its deviation as that of its logarithm.
std::string spread_in_words(const StudyParameter& parameter) {
  constexpr double kNoBound = 1e299;
  const Spread& spread = parameter.spread;
  const auto [low, high] = spread.bounds;
  const auto told = [&](double end) {
    return fmt::format("{:.6g}", parameter.logarithmic ? std::exp(end) : end);
  };
  const char* log = parameter.logarithmic ? "log-" : "";
  if (spread.kind == Spread::Kind::kBits) return "seed";
  if (spread.kind == Spread::Kind::kUniform)
    return fmt::format("{}uniform, {} to {}", log, told(low), told(high));
  std::string words = fmt::format("{}normal, sd {:.6g}", log, spread.sd);
  if (low > -kNoBound && high < kNoBound)
    words += fmt::format(", cut at {} and {}", told(low), told(high));
  else if (low > -kNoBound || high < kNoBound)
    words += low > -kNoBound ? ", cut below " + told(low) : ", cut above " + told(high);
  return words;
}

void write_study_head(const Hdf5Group& root, const StudyPlan& plan) {
  const StudyDescription& study = plan.study;
  root.write_attribute("title", study.title);
  root.write_attribute("format", kStudyFormat);
  root.write_attribute("study", study.text);
  root.write_attribute("study_file", study.file.filename().string());
  root.write_attribute("design", design_word(study.design));
  root.write_attribute("seed", fmt::format("{}", study.seed));
  root.write_attribute("samples", fmt::format("{}", plan.samples()));
  root.write_attribute("points", fmt::format("{}", plan.points));
  std::vector<std::string> files, texts;
  for (const StudyKnee& knee : plan.knees) {
    files.push_back(knee.scene.file.filename().string());
    texts.push_back(knee.scene.text);
  }
  root.write("identity", std::vector<std::string>{head_of(study_identity(plan))});
  const Hdf5Group scenes = root.create("scenes");
  scenes.write("knee", knee_names(plan));
  scenes.write("file", files);
  scenes.write("text", texts);
  const SweptQuantity swept = quantity_of_sweep(plan.knees.front().scene);
  const Hdf5Group sweep = root.create("sweep");
  sweep.write_attribute("quantity", swept.name);
  std::vector<double> values;
  for (const double value : plan.values) values.push_back(swept.shown(value));
  sweep.write("value", values, {values.size()}, swept.unit.name);
}

double deviation(const std::vector<double>& numbers) {
  double mean = 0, sum = 0;
  for (const double number : numbers) mean += number;
  mean /= static_cast<double>(numbers.size());
  for (const double number : numbers) sum += (number - mean) * (number - mean);
  return std::sqrt(sum / std::max(1.0, static_cast<double>(numbers.size()) - 1));
}

void write_parameters(const Hdf5Group& samples,
                      const StudyPlan& plan,
                      const std::vector<std::vector<double>>& theta) {
  std::vector<std::string> names, units, spreads;
  std::vector<int> logarithmic;
  std::vector<double> typical;
  for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
    const StudyParameter& parameter = plan.parameters[i];
    names.push_back(parameter.name);
    units.push_back(parameter.units);
    spreads.push_back(plan.study.design == DesignKind::kTable ? "table"
                                                              : spread_in_words(parameter));
    logarithmic.push_back(parameter.logarithmic ? 1 : 0);
    typical.push_back(deviation(theta[i]));
  }
  const Hdf5Group group = samples.create("parameters");
  group.write("name", names);
  group.write("units", units);
  group.write("spread", spreads);
  group.write("logarithmic", logarithmic, {logarithmic.size()}, "1");
  group.write("typical", typical, {typical.size()}, "parameter");
  samples.write_attribute("theta", "names", names);
}

/// Returns θ by parameters, then samples.
std::vector<std::vector<double>> write_samples(const Hdf5Group& root, const StudyPlan& plan) {
  const std::size_t n = plan.samples(), d = plan.parameters.size();
  const Hdf5Group samples = root.create("samples");
  std::vector<std::vector<double>> theta(d, std::vector<double>(n));
  std::vector<double> row, rows, knees;
  {
    Hdf5Rows of_theta = samples.create_rows("theta", StoredAs::kFloat64, {n, d}, "parameter");
    Hdf5Rows of_knees = samples.create_rows("knee", StoredAs::kInt32, {n}, "1");
    for (std::size_t k = 0; k < n; ++k) {
      plan.theta(k, row);
      for (std::size_t i = 0; i < d; ++i) theta[i][k] = row[i];
      rows.insert(rows.end(), row.begin(), row.end());
      knees.push_back(static_cast<double>(plan.knee_of(k)));
      if (rows.size() + knees.size() < kHeldNumbers && k + 1 < n) continue;
      of_theta.append(rows);
      of_knees.append(knees);
      rows.clear();
      knees.clear();
    }
  }
  write_parameters(samples, plan, theta);
  return theta;
}

/// The datasets of /outputs, filled in the order of samples.
class OutputRows {
 public:
  OutputRows(const Hdf5Group& group, const StudyPlan& plan)
      : poses_(plan.values.size()), columns_(plan.outputs.size()) {
    const Shape shape = {plan.samples(), poses_};
    const StoredAs type = plan.study.single_precision ? StoredAs::kFloat32 : StoredAs::kFloat64;
    for (const StudyOutput& output : plan.outputs)
      rows_.push_back(group.create_rows(output.name, type, shape, output.unit.name));
    rows_.push_back(group.create_rows("status", StoredAs::kUint8, shape, "1"));
  }

  void add(const StudyChunk& chunk) {
    const std::size_t outputs = columns_.size();
    for (std::size_t o = 0; o < outputs; ++o)
      for (std::size_t i = o; i < chunk.values.size(); i += outputs)
        columns_[o].push_back(chunk.values[i]);
    status_.insert(status_.end(), chunk.status.begin(), chunk.status.end());
    if (status_.size() * (outputs + 1) >= kHeldNumbers) flush();
  }

  void flush() {
    for (std::size_t o = 0; o < columns_.size(); ++o) {
      rows_[o].append(columns_[o]);
      columns_[o].clear();
    }
    rows_.back().append(status_);
    status_.clear();
  }

 private:
  std::size_t poses_;
  std::vector<Hdf5Rows> rows_;
  std::vector<std::vector<double>> columns_;
  std::vector<double> status_;
};

void write_outputs(const Hdf5Group& root, const StudyPlan& plan, const StudyJournals& journals) {
  const Hdf5Group group = root.create("outputs");
  {
    OutputRows rows(group, plan);
    for (std::uint64_t c = 0; c < chunk_count(plan); ++c) rows.add(journals.read(c));
    rows.flush();
  }
  std::vector<std::string> meanings;
  for (int i = 0; i < kPoseStatusCount; ++i)
    meanings.emplace_back(name(static_cast<PoseStatus>(i)));
  group.write_attribute("status", "meaning", meanings);
}

void write_provenance(const Hdf5Group& root, const StudyProvenance& provenance) {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  char created[32];
  std::strftime(created, sizeof created, "%Y-%m-%dT%H:%M:%SZ", &utc);
  const Hdf5Group group = root.create("provenance");
  group.write_attribute("program", "condyle " CONDYLE_VERSION);
  group.write_attribute("created", created);
  group.write("seconds", std::vector<double>{provenance.seconds}, {1}, "s");
  group.write("threads", std::vector<int>{provenance.threads}, {1}, "1");
  group.write("processes", std::vector<int>{provenance.processes}, {1}, "1");
}

}  // namespace

bool holds_study(const std::filesystem::path& path, const StudyPlan& plan) {
  try {
    if (!is_study_file(path)) return false;
  } catch (const InputError&) {  // a damaged one
    return false;
  }
  const Hdf5Reader file(path);
  const Hdf5Group root = file.root();
  return root.has("identity") &&
         root.read_texts("identity") == std::vector<std::string>{head_of(study_identity(plan))};
}

StudySummary write_study(const std::filesystem::path& path,
                         const StudyPlan& plan,
                         const StudyJournals& journals,
                         const std::vector<const SweepResult*>& nominal,
                         const StudyProvenance& provenance,
                         const OnProgress& on_output) {
  check_output_file(path);
  if (journals.count() < chunk_count(plan))
    throw InputError(fmt::format("{}: {} of {} chunks are missing, expected all of them",
                                 StudyJournals::folder(path).string(),
                                 chunk_count(plan) - journals.count(), chunk_count(plan)));
  FileBeside file(path);
  Hdf5DiskFile hdf5(file.name(), path.string());
  StudySummary summary;
  {
    const Hdf5Group root = hdf5.root();
    write_study_head(root, plan);
    const std::vector<std::vector<double>> theta = write_samples(root, plan);
    write_outputs(root, plan, journals);
    // The other processes of a team are done: all cores of this machine are free.
    const int threads = provenance.processes > 1 ? 0 : provenance.threads;
    summary = write_summaries(root, plan, theta, nominal, threads, on_output);
    write_provenance(root, provenance);
  }
  hdf5.close();
  file.keep();
  return summary;
}

}  // namespace condyle
