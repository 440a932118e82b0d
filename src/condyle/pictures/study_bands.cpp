/// Bands of a study over the sweep, of all samples and of the knees of a population.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/gnuplot_page.h"
#include "condyle/pictures/plot_study.h"
#include "condyle/results/study_shown.h"

namespace condyle {
namespace {

constexpr double kStudyPanel = 200;     // height of a panel [pixel]
constexpr std::size_t kMostBands = 4;   // of knees in one panel; more have medians alone
constexpr std::size_t kMostColors = 7;  // of knees; more are lines of one colour
constexpr std::size_t kLigamentsOfKnees = 6;
constexpr std::size_t kLowest = 0, kLower = 1, kMedian = 2, kUpper = 3, kHighest = 4;

PagePanel quantity_panel(const StudyView& study, const ShownOutput& output) {
  PagePanel panel;
  panel.title = output.name;
  panel.x_label = study.swept.axis;
  panel.y_label = output.quantity;
  panel.from_zero = output.force;
  return panel;
}

Mark band_mark(const std::vector<double>& x,
               const StudyBand& band,
               std::size_t low,
               std::size_t high,
               const char* ink) {
  return {Mark::Kind::kBand, x, {}, band.quantiles[low], band.quantiles[high], ink};
}

Mark line_mark(const std::vector<double>& x, const std::vector<double>& y, const char* ink) {
  return {Mark::Kind::kLine, x, y, {}, {}, ink};
}

Mark nominal_mark(const std::vector<double>& x, const std::vector<double>& y) {
  Mark mark = line_mark(x, y, kMeasuredInk);
  mark.dashed = true;
  mark.size = 1.4;
  return mark;
}

PagePanel band_panel_of(const StudyView& study, const ShownOutput& output) {
  const std::vector<double> x = shown_values(study);
  const StudyBand& band = study.all.bands.at(output.index);
  PagePanel panel = quantity_panel(study, output);
  panel.marks = {band_mark(x, band, kLowest, kHighest, kAfterInk),
                 band_mark(x, band, kLower, kUpper, kAfterInk),
                 line_mark(x, band.quantiles[kMedian], kAfterInk), nominal_mark(x, band.nominal)};
  return panel;
}

std::vector<KeyEntry> key_of_bands() {
  const Mark wide{Mark::Kind::kBand, {}, {}, {}, {}, kAfterInk};
  return {{"5 to 95 %", {wide}},
          {"25 to 75 %", {wide, wide}},
          {"median", {line_mark({}, {}, kAfterInk)}},
          {"the scene's own numbers", {nominal_mark({}, {})}}};
}

std::string of_samples(const StudyView& study) {
  return fmt::format("{} samples", study.samples) +
         (study.knees.size() > 1 ? fmt::format(" of {} knees", study.knees.size()) : "");
}

/// Bands first, so that they do not lie over the medians: of the knees where they are few, else of all.
PagePanel knees_panel(const StudyView& study, const ShownOutput& output) {
  const std::vector<double> x = shown_values(study);
  PagePanel panel = quantity_panel(study, output);
  const std::size_t knees = study.by_knee.size();
  const bool many = knees > kMostColors;
  const StudyBand& all = study.all.bands.at(output.index);
  if (many) panel.marks.push_back(band_mark(x, all, kLowest, kHighest, kAfterInk));
  for (std::size_t k = 0; knees <= kMostBands && k < knees; ++k)
    panel.marks.push_back(
        band_mark(x, study.by_knee[k].bands.at(output.index), kLowest, kHighest, kColors[k]));
  for (std::size_t k = 0; k < knees; ++k) {
    const StudyBand& band = study.by_knee[k].bands.at(output.index);
    panel.marks.push_back(line_mark(x, band.quantiles[kMedian], many ? kBeforeInk : kColors[k]));
    if (many) panel.marks.back().size = 1;
  }
  if (many) panel.marks.push_back(line_mark(x, all.quantiles[kMedian], kAfterInk));
  return panel;
}

std::vector<KeyEntry> key_of_knees(const StudyView& study) {
  const std::size_t knees = study.by_knee.size();
  std::vector<KeyEntry> key;
  if (knees > kMostColors) {
    const Mark all{Mark::Kind::kBand, {}, {}, {}, {}, kAfterInk};
    Mark each = line_mark({}, {}, kBeforeInk);
    each.size = 1;
    return {{"median of each knee", {each}},
            {"all knees: median, 5 to 95 %", {all, line_mark({}, {}, kAfterInk)}}};
  }
  for (std::size_t k = 0; k < knees; ++k) {
    KeyEntry& entry = key.emplace_back();
    entry.words = shortened(study.knees.at(k), 40);
    if (knees <= kMostBands)
      entry.samples.push_back({Mark::Kind::kBand, {}, {}, {}, {}, kColors[k]});
    entry.samples.push_back(line_mark({}, {}, kColors[k]));
  }
  return key;
}

}  // namespace

std::vector<NamedPage> study_band_pages(const StudyView& study) {
  ChartPage joint{study.title, "joint, " + of_samples(study)},
      contacts{study.title, "contacts, " + of_samples(study)},
      ligaments{study.title, "ligaments, " + of_samples(study)};
  joint.key = contacts.key = ligaments.key = key_of_bands();
  for (const ShownOutput& output : shown_outputs(study)) {
    if (!carries(study.all.bands.at(output.index), output)) continue;
    ChartPage& page = output.group == StudyGroup::kJoint     ? joint
                      : output.group == StudyGroup::kContact ? contacts
                                                             : ligaments;
    page.panels.push_back(band_panel_of(study, output));
  }
  return divided(
      {{"study_joint", joint}, {"study_contacts", contacts}, {"study_ligaments", ligaments}},
      kMostPanels, kPanelColumns, kStudyPanel);
}

std::vector<NamedPage> study_knee_pages(const StudyView& study) {
  if (study.by_knee.size() < 2) return {};
  ChartPage page{study.title, study.by_knee.size() > kMostBands
                                  ? "medians of the knees"
                                  : "the knees, median and 5 to 95 %"};
  page.key = key_of_knees(study);
  for (const ShownOutput& output : main_outputs(study, kLigamentsOfKnees))
    page.panels.push_back(knees_panel(study, output));
  return divided({{"study_knees", page}}, kMostPanels, kPanelColumns, kStudyPanel);
}

}  // namespace condyle
