#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/calibration/calibration.h"
#include "condyle/calibration/shown_numbers.h"
#include "condyle/pictures/plot_calibration.h"

namespace condyle {
namespace {

constexpr double kBandInterval =
    1.645;                           // 5 to 95 % of a normal distribution, in standard deviations
constexpr double kLeastForce = 0.5;  // what a ligament has to carry to be shown [N]
constexpr double kBandHeight = 200;  // [pixel]

/// Name of the force's ligament or contact; empty for coordinates.
std::string carrier(const Band& band) {
  const std::string end = ".force";
  return band.quantity.ends_with(end) ? band.quantity.substr(0, band.quantity.size() - end.size())
                                      : "";
}

bool has_ligament(const Scene& scene, const std::string& name) {
  return std::any_of(scene.ligaments.begin(), scene.ligaments.end(),
                     [&](const LigamentDescription& ligament) { return ligament.name == name; });
}

/// Of what pulls or pushes, only a contact that is held closed does the other.
bool may_pull(const Scene& scene, const std::string& name) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [&](const ContactDescription& contact) {
                       return contact.name == name && contact.state == ContactState::kClosed;
                     });
}

bool carries(const Band& band) {
  for (const auto& [mean, sd] :
       {std::pair{&band.before, &band.before_sd}, {&band.after, &band.after_sd}})
    for (std::size_t i = 0; i < mean->size() && i < sd->size(); ++i)
      if ((*mean)[i] + kBandInterval * (*sd)[i] > kLeastForce) return true;
  return false;
}

void add_band(PagePanel& panel,
              const std::vector<double>& x,
              const std::vector<double>& mean,
              const std::vector<double>& sd,
              const char* ink,
              bool never_negative) {
  Mark band{Mark::Kind::kBand, x, {}, {}, {}, ink}, line{Mark::Kind::kLine, x, mean, {}, {}, ink};
  for (std::size_t i = 0; i < mean.size() && i < sd.size(); ++i) {
    const double low = mean[i] - kBandInterval * sd[i], high = mean[i] + kBandInterval * sd[i];
    band.low.push_back(never_negative && low < 0 ? 0 : low);
    band.high.push_back(high);
  }
  panel.marks.insert(panel.marks.begin(), band);
  panel.marks.push_back(line);
}

PagePanel band_panel(const Scene& scene, const CalibrationResult& result, const Band& band) {
  std::vector<double> x;
  for (const double angle : result.band_flexions) x.push_back(angle * 180 / std::numbers::pi);
  PagePanel panel;
  const std::string of = carrier(band);
  panel.title = of.empty() ? band.quantity : !has_ligament(scene, of) ? of + " contact" : of;
  std::replace(panel.title.begin(), panel.title.end(), '_', ' ');
  panel.x_label = "Flexion [°]";
  panel.y_label = !of.empty()          ? "Force [N]"
                  : band.units == "mm" ? "Translation [mm]"
                                       : "Rotation [" + shown_unit(band.units) + "]";
  panel.from_zero = !of.empty();
  const bool never_negative = !of.empty() && !may_pull(scene, of);
  add_band(panel, x, band.after, band.after_sd, kAfterInk, never_negative);
  add_band(panel, x, band.before, band.before_sd, kBeforeInk, never_negative);
  std::rotate(panel.marks.rbegin(), panel.marks.rbegin() + 1, panel.marks.rend());
  return panel;
}

std::vector<KeyEntry> band_key() {
  const auto entry = [](const char* words, const char* ink) {
    const Mark line{Mark::Kind::kLine, {}, {}, {}, {}, ink};
    return KeyEntry{words, {Mark{Mark::Kind::kBand, {}, {}, {}, {}, ink}, line}};
  };
  return {entry("prior, 5 to 95 %", kBeforeInk), entry("posterior, 5 to 95 %", kAfterInk)};
}

}  // namespace

std::vector<NamedPage> band_pages(const Scene& scene, const CalibrationResult& result) {
  ChartPage joint{scene.title, "joint and contacts, before and after the fit"},
      ligaments{scene.title, "ligament forces, before and after the fit"};
  joint.key = ligaments.key = band_key();
  for (const Band& band : result.bands) {
    const std::string of = carrier(band);
    if (of.empty() || !has_ligament(scene, of))
      joint.panels.push_back(band_panel(scene, result, band));
    else if (carries(band))
      ligaments.panels.push_back(band_panel(scene, result, band));
  }
  return divided({{"calibration_bands", joint}, {"calibration_ligament_bands", ligaments}},
                 kMostPanels, kPanelColumns, kBandHeight);
}

}  // namespace condyle
