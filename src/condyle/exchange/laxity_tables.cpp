#include "condyle/exchange/laxity_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "condyle/calibration/csv_file.h"
#include "condyle/control_characters.h"
#include "condyle/elements/joint_table.h"
#include "condyle/exchange/jcs_heading.h"
#include "condyle/exchange/jcs_offsets.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

/// A file whose fields are numbers: column by column.
struct Wide {
  CsvFile csv;
  std::vector<std::vector<double>> columns;
  JcsDriven driven = JcsDriven::kForce;
};

[[noreturn]] void refuse_heading(const Wide& wide, std::size_t i, const char* expected) {
  throw InputError(fmt::format("{}:{}: unknown column \"{}\", expected {}", wide.csv.file.string(),
                               wide.csv.header.line, wide.csv.header.fields[i], expected));
}

Wide read_wide(const fs::path& file) {
  Wide wide;
  wide.csv = read_csv(file, "kinematics or kinetics of a test (CSV)");
  const auto driven = driven_of_heading(wide.csv.header.fields[0]);
  if (!driven)
    refuse_heading(wide, 0,
                   "\"Applied Load (N)\", \"Applied Load (Nm)\" or \"Flexion Angle (deg)\"");
  wide.driven = *driven;
  wide.columns.resize(wide.csv.header.fields.size());
  for (const CsvRow& row : wide.csv.rows)
    for (std::size_t i = 0; i < row.fields.size(); ++i) {
      const double number = csv_number(row.fields[i]);
      if (std::isnan(number))
        throw InputError(fmt::format("{}:{}: {} = {}, expected a finite number", file.string(),
                                     row.line, wide.csv.header.fields[i], row.fields[i]));
      wide.columns[i].push_back(number);
    }
  if (wide.csv.rows.empty()) throw InputError(file.string() + ": no row, expected one or more");
  return wide;
}

struct TestFiles {
  std::optional<fs::path> kinematics, kinetics;
};

/// "Laxity_60deg_AP1" of "Laxity_60deg_AP1_TibiaKinetics_in_TibiaCS": up to the word, and which it is.
std::pair<std::string, bool> test_of(const fs::path& file) {
  std::string name = file.stem().string(), small = name;
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::size_t kinematics = small.find("kinematics"), kinetics = small.find("kinetics");
  const std::size_t at = std::min(kinematics, kinetics);
  const std::size_t end = at == std::string::npos ? at : name.rfind('_', at);
  if (end == std::string::npos || end == 0)
    throw InputError(file.string() +
                     ": unknown file, expected TEST_kinematics... or TEST_kinetics....csv");
  return {name.substr(0, end), kinematics < kinetics};
}

std::map<std::string, TestFiles> tests_of(const std::vector<fs::path>& files) {
  std::map<std::string, TestFiles> tests;
  for (const fs::path& file : files) {
    const auto [test, is_kinematics] = test_of(file);
    std::optional<fs::path>& place = is_kinematics ? tests[test].kinematics : tests[test].kinetics;
    if (place)
      throw InputError(fmt::format("{}: {} of test {} are {} already", file.string(),
                                   is_kinematics ? "kinematics" : "kinetics", test,
                                   place->string()));
    place = file;
  }
  return tests;
}

/// First and last row of each step.
std::vector<std::pair<std::size_t, std::size_t>> steps_of(const std::vector<double>& driven,
                                                          double held) {
  std::vector<std::pair<std::size_t, std::size_t>> steps;
  for (std::size_t i = 0; i < driven.size(); ++i) {
    const bool same =
        held > 0 && !steps.empty() && std::abs(driven[i] - driven[steps.back().first]) <= held;
    if (same)
      steps.back().second = i;
    else
      steps.emplace_back(i, i);
  }
  return steps;
}

double value_of(const std::vector<double>& column,
                const std::pair<std::size_t, std::size_t>& step,
                bool mean) {
  if (!mean) return column[step.second];
  double sum = 0;
  for (std::size_t i = step.first; i <= step.second; ++i) sum += column[i];
  return sum / static_cast<double>(step.second - step.first + 1);
}

/// The six joint coordinates by column, -1 for those that are not told.
std::array<int, 6> columns_of(const Wide& kinematics, std::array<double, 6>& signs) {
  std::array<int, 6> columns;
  columns.fill(-1);
  for (std::size_t i = 1; i < kinematics.columns.size(); ++i) {
    const auto motion = motion_of_heading(kinematics.csv.header.fields[i]);
    if (!motion || columns[motion->coordinate] >= 0)
      refuse_heading(
          kinematics, i,
          "\"Knee JCS \" with Medial, Posterior, Superior [mm], Flexion, Valgus, Internal "
          "Rotation [deg] or their opposites, each once");
    columns[motion->coordinate] = static_cast<int>(i);
    signs[motion->coordinate] = motion->sign;
  }
  if (columns[0] < 0)
    throw InputError(fmt::format("{}:{}: no column \"Knee JCS Flexion [deg]\", expected one",
                                 kinematics.csv.file.string(), kinematics.csv.header.line));
  return columns;
}

/// The load of the kinetics whose column is the one that is applied; others are noted.
JcsLoad applied_load(const std::string& test,
                     const Wide& kinematics,
                     const Wide& kinetics,
                     std::vector<std::string>& notes) {
  constexpr double kRounding = 1e-6;  // of the largest load
  const std::string file = kinetics.csv.file.string();
  const std::vector<double>& driven = kinematics.columns[0];
  if (kinetics.driven != kinematics.driven || kinetics.columns[0].size() != driven.size())
    throw InputError(fmt::format("{}: {} rows over \"{}\", expected {} over \"{}\" as {} has", file,
                                 kinetics.columns[0].size(), kinetics.csv.header.fields[0],
                                 driven.size(), kinematics.csv.header.fields[0],
                                 kinematics.csv.file.string()));
  std::optional<JcsLoad> applied;
  std::string others;
  for (std::size_t i = 1; i < kinetics.columns.size(); ++i) {
    const auto load = load_of_heading(kinetics.csv.header.fields[i]);
    if (!load)
      refuse_heading(
          kinetics, i,
          "\"JCS Load \" with Lateral Drawer, Anterior Drawer, Distraction [N], Extension, "
          "Varus, External Rotation Torque [Nm] or their opposites");
    double size = 0, difference = 0;
    const auto [least, most] =
        std::minmax_element(kinetics.columns[i].begin(), kinetics.columns[i].end());
    for (std::size_t k = 0; k < driven.size(); ++k) {
      size = std::max(size, std::abs(kinetics.columns[i][k]));
      difference = std::max(difference, std::abs(kinetics.columns[i][k] - driven[k]));
    }
    const bool moment = kinematics.driven == JcsDriven::kMoment;
    if (load->moment == moment && size > 0 && difference <= kRounding * size && !applied)
      applied = load;
    else if (size > 0)
      others += fmt::format("{} {} from {:.3g} to {:.3g} {}", others.empty() ? "" : ",", load->name,
                            *least, *most, load->moment ? "N m" : "N");
  }
  if (!applied)
    throw InputError(
        fmt::format("{}: no column is the applied load of {}, expected one of the same "
                    "numbers",
                    file, kinematics.csv.file.string()));
  if (!others.empty())
    notes.push_back(fmt::format("{}: loads beside {}:{}", test, applied->name, others));
  return *applied;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

void write_test(const std::string& test,
                const TestFiles& files,
                const std::array<double, 6>& offsets,
                const LaxityTableOptions& options,
                LaxityTable& table) {
  if (!files.kinematics)
    throw InputError(files.kinetics->string() + ": kinetics alone, expected " + test +
                     "_kinematics... beside it");
  const Wide kinematics = read_wide(*files.kinematics);
  const bool passive = kinematics.driven == JcsDriven::kFlexion;
  if (!passive && !files.kinetics)
    throw InputError(
        fmt::format("{}: kinematics alone, expected {}_kinetics... beside it, which "
                    "says what load is applied in which sense",
                    files.kinematics->string(), test));
  JcsLoad load{"none", false};
  if (!passive) load = applied_load(test, kinematics, read_wide(*files.kinetics), table.notes);
  std::array<double, 6> signs{};
  const std::array<int, 6> columns = columns_of(kinematics, signs);
  // A passive path holds no load: each of its rows is a pose.
  std::set<std::string> seen;
  int repeated = 0;
  for (const auto& step : steps_of(kinematics.columns[0], passive ? 0 : options.held)) {
    const auto coordinate = [&](std::size_t c) {
      const auto& column = kinematics.columns[static_cast<std::size_t>(columns[c])];
      return signs[c] * value_of(column, step, options.mean) + offsets[c];
    };
    const double level = passive ? 0 : value_of(kinematics.columns[0], step, options.mean);
    // -0 is 0, as it is where the table is read.
    const std::string at =
        fmt::format("{:.6g},{},{:.6g}", coordinate(0) + 0.0, load.name, level + 0.0);
    const bool fresh = seen.insert(at).second;
    repeated += fresh ? 0 : 1;
    for (std::size_t c = 1; c < 6; ++c) {
      if (columns[c] < 0) continue;
      table.text += fmt::format("{},{},{},{},{:.6g},{:.6g},{}\n", quoted(options.specimen),
                                quoted(test), at, kJointCoordinates[c].name, coordinate(c),
                                kJointCoordinates[c].angle ? options.sd_angle : options.sd_length,
                                fresh ? "fit" : "skip");
    }
  }
  if (repeated > 0)
    table.notes.push_back(
        fmt::format("{}: {} steps repeat a flexion and a level: use = skip", test, repeated));
}

}  // namespace

LaxityTable laxity_table(const std::vector<fs::path>& files, const LaxityTableOptions& options) {
  if (has_control_characters(options.specimen))
    throw InputError("--specimen = \"" + options.specimen +
                     "\", expected a name without control characters: it stands in each line");
  LaxityTable table;
  const std::array<double, 6> offsets =
      options.offsets ? read_jcs_offsets(*options.offsets) : std::array<double, 6>{};
  table.text = fmt::format(
      "# units: mm, deg, N, N m; offsets: {}\n"
      "specimen,test,flexion,load,level,coordinate,value,sd,use\n",
      options.offsets ? options.offsets->filename().string() : "none added");
  for (const auto& [test, pair] : tests_of(files)) write_test(test, pair, offsets, options, table);
  if (!options.offsets) table.notes.emplace_back("no offsets were added (--offsets)");
  return table;
}

}  // namespace condyle
