#include "condyle/results/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

double largest_gap(const SweepResult& sweep) {
  double largest = 0;
  for (const PoseResult& pose : sweep.poses) {
    if (!pose.converged()) continue;
    for (const ContactResult& contact : pose.contacts) {
      if (!contact.closed || contact.layer) continue;  // layers overlap
      for (const ContactPointResult& point : contact.points)
        largest = std::max(largest, std::abs(point.gap));
    }
  }
  return largest;
}

/// Two, or up to six where values lie closer.
int decimals_of(const std::vector<double>& values, const Unit& unit) {
  constexpr int kFewest = 2, kMost = 6;
  double least = INFINITY;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (const double step = std::abs(values[i] - values[i - 1]) / unit.factor; step > 0)
      least = std::min(least, step);
  int decimals = kFewest;
  while (decimals < kMost && least * std::pow(10, decimals) < 1 - 1e-6) ++decimals;
  return decimals;
}

}  // namespace

SweepTable::SweepTable(const Scene& scene,
                       const SweptQuantity& swept,
                       const std::vector<double>& values)
    : unit_(swept.unit) {
  cells_.push_back({swept.name, unit_.name, decimals_of(values, unit_),
                    [](const SweepTable& t, const PoseResult& p, std::size_t) {
                      return p.value / t.unit_.factor;
                    }});
  add_coordinates(scene.joint.has_value(), swept.flexion);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    cells_.push_back({scene.contacts[i].name, "N", 1,
                      [](const SweepTable&, const PoseResult& p, std::size_t k) {
                        return p.contacts.at(k).force;
                      },
                      i});
  }
  std::vector<std::string> names;
  for (const LigamentDescription& ligament : scene.ligaments) names.push_back(ligament.name);
  ligaments_ = ligament_columns(names);
  for (std::size_t i = 0; i < ligaments_.size(); ++i) {
    cells_.push_back({ligaments_[i].name, "N", 1,
                      [](const SweepTable& t, const PoseResult& p, std::size_t k) {
                        double sum = 0;
                        for (const std::size_t member : t.ligaments_[k].members)
                          sum += p.ligaments.at(member).force;
                        return sum;
                      },
                      i});
  }
  cells_.push_back({"iter", "", 0, [](const SweepTable&, const PoseResult& p, std::size_t) {
                      return static_cast<double>(p.iterations);
                    }});
  cells_.push_back({"time", "us", 0, [](const SweepTable&, const PoseResult& p, std::size_t) {
                      return 1e6 * p.seconds;
                    }});
}

// Joint coordinates where the scene has a joint, else the pose: place of O_A and rotation vector.
void SweepTable::add_coordinates(bool joint, bool flexion_is_swept) {
  static constexpr std::array<const char*, 6> kPose = {"x", "y", "z", "rot x", "rot y", "rot z"};
  for (std::size_t i = joint && flexion_is_swept ? 1 : 0; i < 6; ++i) {
    if (joint) {
      cells_.push_back({kJointCoordinates[i].column, kJointColumns[i].units, 2,
                        [](const SweepTable&, const PoseResult& p, std::size_t k) {
                          return p.joint.*kJointColumns[k].member / kJointColumns[k].unit;
                        },
                        i});
    } else {
      cells_.push_back({kPose[i], i < 3 ? "mm" : "deg", 2,
                        [](const SweepTable&, const PoseResult& p, std::size_t k) {
                          return k < 3 ? p.X_BA.p[static_cast<Eigen::Index>(k)]
                                       : log_rotation(p.X_BA.R)[static_cast<Eigen::Index>(k - 3)] /
                                             kDegree;
                        },
                        i});
    }
  }
}

int SweepTable::width(const Cell& cell) {
  const std::size_t least =
      cell.decimals == 0 ? 6 : 8 + static_cast<std::size_t>(std::max(0, cell.decimals - 2));
  return static_cast<int>(std::max(least, cell.name.size() + 1));
}

std::string SweepTable::head() const {
  std::string names, units;
  for (const Cell& cell : cells_) {
    names += fmt::format("{:>{}}", cell.name, width(cell));
    units += fmt::format("{:>{}}", cell.units, width(cell));
  }
  return names + "\n" + units + "\n";
}

std::string SweepTable::row(const PoseResult& pose) const {
  std::string line;
  for (const Cell& cell : cells_) {
    const std::string number =
        fmt::format("{:.{}f}", cell.value(*this, pose, cell.index), cell.decimals);
    line += fmt::format(" {:>{}}", number, width(cell) - 1);
    if (!pose.solved()) break;
  }
  if (!pose.converged())
    return line + "  " + name(pose.status) + (pose.reason.empty() ? "" : ": " + pose.reason) + "\n";
  return line + (pose.remark.empty() ? "" : "  " + pose.remark) + "\n";
}

std::string summary(const SweepResult& sweep) {
  double residual = 0, seconds = 0, on_events = 0;
  for (const PoseResult& pose : sweep.poses) {
    seconds += pose.seconds;
    on_events += pose.event_seconds;
    if (pose.converged()) residual = std::max(residual, pose.residual);
  }
  const auto n = sweep.poses.size();
  return fmt::format(
      "{} of {} poses converged, largest residual {:.2g} N, largest gap {:.2g} mm, {} ({} a "
      "pose){}",
      sweep.count_converged(), n, residual, largest_gap(sweep), short_time(seconds, "us"),
      short_time(seconds / static_cast<double>(std::max<std::size_t>(n, 1)), "us"),
      on_events > 0 ? fmt::format(" and {} for events", short_time(on_events, "us")) : "");
}

std::vector<std::string> event_lines(const Scene& scene,
                                     const SweptQuantity& swept,
                                     const SweepResult& sweep) {
  std::vector<std::string> lines;
  for (const Event& event : sweep.events) {
    const std::string subject = event_subject(scene, event);
    lines.push_back(fmt::format("{}{}{} at {:.6f}{}", subject, subject.empty() ? "" : ": ",
                                name(event.kind), swept.shown(event.value),
                                swept.unit_after_number()));
  }
  return lines;
}

std::vector<std::string> failures(const SweptQuantity& swept, const SweepResult& sweep) {
  std::vector<std::string> lines;
  for (const PoseResult& pose : sweep.poses) {
    if (pose.converged()) continue;
    lines.push_back(fmt::format("{} = {:.6g}{}: {}{}", swept.name, swept.shown(pose.value),
                                swept.unit_after_number(), name(pose.status),
                                pose.reason.empty() ? "" : ": " + pose.reason));
  }
  return lines;
}

}  // namespace condyle
