#include <array>

#include "condyle/elements/joint_table.h"
#include "condyle/results/calibration_parts.h"
#include "condyle/results/record_columns.h"
#include "condyle/results/run_layout.h"

namespace condyle {
namespace {

/// A row of the table and its predictions in told units.
struct RowRecord {
  int line = 0, kind = 0, index = 0, use = 0, load_index = -1;
  bool laxity = false;
  std::string test, load, coordinate, units, level_units;
  double flexion = 0, level = 0, value = 0, sd = 0;
  double before = 0, after = 0, prior_sd = 0, after_sd = 0, whole_sd = 0;
};

template <class Door>
void tell_row(const Door& door) {
  door("line", &RowRecord::line);
  door("test", &RowRecord::test);
  door("flexion", &RowRecord::flexion, "deg");
  door("load", &RowRecord::load);
  door("load_index", &RowRecord::load_index);
  door("level", &RowRecord::level, "as level_units");
  door("level_units", &RowRecord::level_units);
  door("coordinate", &RowRecord::coordinate);
  door("kind", &RowRecord::kind);
  door("index", &RowRecord::index);
  door("laxity", &RowRecord::laxity);
  door("units", &RowRecord::units);
  door("value", &RowRecord::value, "as units");
  door("sd", &RowRecord::sd, "as units");
  door("use", &RowRecord::use);
  door("before", &RowRecord::before, "as units");
  door("after", &RowRecord::after, "as units");
  door("prior_sd", &RowRecord::prior_sd, "as units");
  door("after_sd", &RowRecord::after_sd, "as units");
  door("whole_sd", &RowRecord::whole_sd, "as units");
}

const CalibrationLoad* load_of(const Scene& scene, int load) {
  return load < 0 || !scene.calibration
             ? nullptr
             : &scene.calibration->loads.at(static_cast<std::size_t>(load));
}

std::string level_units(const Scene& scene, const CalibrationLoad* load) {
  if (load == nullptr) return "1";
  const auto index = static_cast<std::size_t>(load->index);
  if (!load->displacement_control) return scene.loads.at(index).moment ? "N mm" : "N";
  return is_angle(scene.conditions.at(index).kind) ? "deg" : "mm";
}

std::string coordinate_of(const Scene& scene, const Measurement& m) {
  switch (m.kind) {
    case MeasuredKind::kReaction:
      return "reaction";
    case MeasuredKind::kLigamentForce:
      return scene.ligaments.at(m.index).name + ".force";
    case MeasuredKind::kContactForce:
      return scene.contacts.at(m.index).name + ".force";
    case MeasuredKind::kJointCoordinate:
      break;
  }
  return kJointCoordinates.at(m.index).name + std::string(m.laxity ? ".laxity" : "");
}

std::string units_of(const Scene& scene, const Measurement& m) {
  if (m.kind == MeasuredKind::kJointCoordinate)
    return kJointCoordinates.at(m.index).angle ? "deg" : "mm";
  const bool moment =
      m.kind == MeasuredKind::kReaction && is_angle(scene.conditions.at(m.index).kind);
  return moment ? "N mm" : "N";
}

RowRecord record_of(const Scene& scene, const Measurement& m, const CalibratedRow& row) {
  const CalibrationLoad* load = load_of(scene, m.load);
  RowRecord record;
  record.line = m.line;
  record.kind = static_cast<int>(m.kind);
  record.index = static_cast<int>(m.index);
  record.use = static_cast<int>(m.use);
  record.load_index = m.load;
  record.laxity = m.laxity;
  record.test = m.test;
  record.load = load == nullptr ? "none" : load->name;
  record.coordinate = coordinate_of(scene, m);
  record.level_units = level_units(scene, load);
  record.units = units_of(scene, m);
  const double unit = inside(record.units);
  record.flexion = m.flexion / kDegree;
  record.level = m.level / inside(record.level_units);
  record.value = m.value / unit;
  record.sd = m.sd / unit;
  record.before = row.before / unit;
  record.after = row.after / unit;
  record.prior_sd = row.prior_sd / unit;
  record.after_sd = row.after_sd / unit;
  record.whole_sd = row.sd / unit;
  return record;
}

}  // namespace

void write_rows(const Hdf5Group& group, const Scene& scene, const CalibrationResult& result) {
  std::vector<RowRecord> records;
  for (std::size_t i = 0; i < result.table.rows.size(); ++i)
    records.push_back(record_of(scene, result.table.rows[i], result.rows.at(i)));
  tell_row(RecordWriter<RowRecord>(group, records));
  group.write_attribute("use", "meaning", {"fit", "test", "skip"});
  group.write_attribute("kind", "meaning",
                        {"joint coordinate", "reaction", "ligament force", "contact force"});
}

namespace {

/// Throws for a row about what the scene does not have.
void check_row(const RowRecord& row, const Scene& scene, const Hdf5Group& group) {
  const std::array<std::size_t, 4> counts = {kJointColumns.size(), scene.conditions.size(),
                                             scene.ligaments.size(), scene.contacts.size()};
  const bool known =
      row.kind >= 0 && row.kind < 4 && row.index >= 0 &&
      static_cast<std::size_t>(row.index) < counts.at(row.kind) && row.use >= 0 && row.use < 3 &&
      row.load_index >= -1 &&
      (!scene.calibration || row.load_index < static_cast<int>(scene.calibration->loads.size()));
  if (!known) group.fail("holds a row about what the scene does not have");
}

}  // namespace

void read_rows(const Hdf5Group& group, const Scene& scene, CalibrationResult& result) {
  std::vector<RowRecord> records(group.read_texts("test").size());
  tell_row(RecordReader<RowRecord>(group, records));
  for (const RowRecord& r : records) {
    check_row(r, scene, group);
    const double unit = inside(r.units);
    Measurement& m = result.table.rows.emplace_back();
    m.line = r.line;
    m.test = r.test;
    m.flexion = r.flexion * kDegree;
    m.load = r.load_index;
    m.level = r.level * inside(r.level_units);
    m.kind = static_cast<MeasuredKind>(r.kind);
    m.index = static_cast<std::size_t>(r.index);
    m.laxity = r.laxity;
    m.value = r.value * unit;
    m.sd = r.sd * unit;
    m.use = static_cast<MeasuredUse>(r.use);
    result.rows.push_back(
        {r.before * unit, r.after * unit, r.prior_sd * unit, r.after_sd * unit, r.whole_sd * unit});
  }
}

}  // namespace condyle
