#include "condyle/results/calibration_parts.h"
#include "condyle/results/record_columns.h"
#include "condyle/results/run_layout.h"

namespace condyle {
namespace {

struct Move {
  int parameter = 0, what = 0, index = 0, body = 0, component = 0, held = 0;
  double factor = 1;
};

template <class Door>
void tell_move(const Door& door) {
  door("parameter", &Move::parameter);
  door("what", &Move::what);
  door("index", &Move::index);
  door("body", &Move::body);
  door("component", &Move::component);
  door("held", &Move::held);
  door("factor", &Move::factor);
}

/// FreeParameter without its lists, in told units.
struct ParameterRow {
  std::string name, units, test;
  int kind = 0, component = 0, coordinate = 0;
  bool logarithmic = false, at_bound = false;
  double prior_sd = 0, lower = 0, upper = 0, start = 0, mean = 0, sd = 0, sample_sd = kNoNumber;
};

template <class Door>
void tell_parameter(const Door& door) {
  door("name", &ParameterRow::name);
  door("units", &ParameterRow::units);
  door("kind", &ParameterRow::kind);
  door("logarithmic", &ParameterRow::logarithmic);
  door("test", &ParameterRow::test);
  door("component", &ParameterRow::component);
  door("coordinate", &ParameterRow::coordinate);
  door("start", &ParameterRow::start);
  door("prior_sd", &ParameterRow::prior_sd);
  door("lower", &ParameterRow::lower);
  door("upper", &ParameterRow::upper);
  door("mean", &ParameterRow::mean);
  door("sd", &ParameterRow::sd);
  door("sample_sd", &ParameterRow::sample_sd);
  door("at_bound", &ParameterRow::at_bound);
}

std::vector<ParameterRow> parameter_rows(const CalibrationResult& result) {
  std::vector<ParameterRow> rows;
  for (std::size_t j = 0; j < result.parameters.size(); ++j) {
    const FreeParameter& p = result.parameters[j];
    const auto at = static_cast<Eigen::Index>(j);
    const double unit = inside(told(p.units));
    ParameterRow row{p.name, told(p.units), p.test};
    row.kind = static_cast<int>(p.kind);
    row.component = p.component;
    row.coordinate = static_cast<int>(p.coordinate);
    row.logarithmic = p.logarithmic;
    row.at_bound = result.at_bound[j];
    row.prior_sd = p.prior_sd / unit;
    row.lower = p.bounds[0] / unit;
    row.upper = p.bounds[1] / unit;
    row.start = p.start;
    row.mean = result.fit.theta[at] / unit;
    row.sd = result.known.sd[at] / unit;
    if (at < result.sample_sd.size()) row.sample_sd = result.sample_sd[at] / unit;
    rows.push_back(row);
  }
  return rows;
}

std::vector<Move> moves_of(const std::vector<FreeParameter>& parameters) {
  std::vector<Move> moves;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    for (const auto& [number, factor] : parameters[j].moves)
      moves.push_back({static_cast<int>(j), static_cast<int>(number.kind),
                       static_cast<int>(number.index), static_cast<int>(number.body),
                       number.component, static_cast<int>(number.held), factor});
  return moves;
}

void check_parameter(const ParameterRow& row, const Hdf5Group& group) {
  const bool known = row.kind >= 0 && row.kind < 4 && row.component >= 0 && row.component < 6 &&
                     row.coordinate >= 0 && row.coordinate < static_cast<int>(kJointColumns.size());
  if (!known) group.fail("holds a parameter of an unknown kind");
}

FreeParameter parameter_of(const ParameterRow& row) {
  const double unit = inside(row.units);
  FreeParameter p;
  p.name = row.name;
  p.units = row.units == "deg" ? "rad" : row.units;
  p.kind = static_cast<FreeParameter::Kind>(row.kind);
  p.logarithmic = row.logarithmic;
  p.component = row.component;
  p.test = row.test;
  p.coordinate = static_cast<std::size_t>(row.coordinate);
  p.prior_sd = row.prior_sd * unit;
  p.bounds = {row.lower * unit, row.upper * unit};
  p.start = row.start;
  return p;
}

void read_moves(const Hdf5Group& group, std::vector<FreeParameter>& parameters) {
  std::vector<Move> moves(group.read("parameter").values.size());
  tell_move(RecordReader<Move>(group, moves));
  for (const Move& move : moves) {
    if (move.parameter < 0 || move.parameter >= static_cast<int>(parameters.size()))
      group.fail("names a parameter that is none");
    const bool known = move.what >= 0 &&
                       move.what <= static_cast<int>(ParameterKind::kLayerModulus) &&
                       move.index >= 0 && move.body >= 0 && move.body < 3 && move.component >= 0 &&
                       move.component < 3 && (move.held == 0 || move.held == 1);
    if (!known) group.fail("holds a number of an unknown kind");
    parameters[static_cast<std::size_t>(move.parameter)].moves.push_back(
        {{static_cast<ParameterKind>(move.what), static_cast<std::size_t>(move.index),
          static_cast<OfBody>(move.body), move.component, static_cast<Held>(move.held)},
         move.factor});
  }
}

}  // namespace

void write_parameters(const Hdf5Group& group, const CalibrationResult& result) {
  const std::vector<ParameterRow> rows = parameter_rows(result);
  tell_parameter(RecordWriter<ParameterRow>(group, rows));
  group.write_attribute("kind", "meaning",
                        {"number of the knee", "femur frame", "tibia frame", "curve offset"});
  const Hdf5Group numbers = group.create("moves");
  const std::vector<Move> moves = moves_of(result.parameters);
  tell_move(RecordWriter<Move>(numbers, moves));
}

void read_parameters(const Hdf5Group& group, CalibrationResult& result) {
  std::vector<ParameterRow> rows(group.read_texts("name").size());
  tell_parameter(RecordReader<ParameterRow>(group, rows));
  const auto n = static_cast<Eigen::Index>(rows.size());
  result.prior_sd.resize(n);
  result.fit.theta.resize(n);
  result.known.sd.resize(n);
  result.sample_sd.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const ParameterRow& row = rows[static_cast<std::size_t>(j)];
    check_parameter(row, group);
    result.parameters.push_back(parameter_of(row));
    const double unit = inside(row.units);
    result.prior_sd[j] = row.prior_sd * unit;
    result.fit.theta[j] = row.mean * unit;
    result.known.sd[j] = row.sd * unit;
    result.sample_sd[j] = row.sample_sd * unit;
    result.at_bound.push_back(row.at_bound);
  }
  if (result.sample_sd.array().isNaN().all()) result.sample_sd.resize(0);
  read_moves(group.open("moves"), result.parameters);
}

}  // namespace condyle
