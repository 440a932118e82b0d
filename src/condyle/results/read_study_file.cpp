#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include "condyle/input_error.h"
#include "condyle/results/format_number.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/study_file.h"
#include "condyle/results/study_groups.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {
namespace {

/// A whole number that is stored as a text.
std::uint64_t number_in(const Hdf5Group& group, const char* name) {
  const std::string text = group.read_attribute(name);
  const char* end = text.data() + text.size();
  std::uint64_t number = 0;
  const std::from_chars_result read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end)
    group.fail(fmt::format("{} = \"{}\", expected a whole number below 2^64", name, text));
  return number;
}

std::vector<StudyView::Parameter> read_parameters(const Hdf5Group& group) {
  const std::vector<std::string> names = group.read_texts("name"),
                                 units = group.read_texts("units"),
                                 spreads = group.read_texts("spread");
  const std::size_t d = names.size();
  if (units.size() != d || spreads.size() != d)
    group.fail("names, units and spreads differ in number");
  const std::vector<int> logarithmic = group.read_integers("logarithmic", {d});
  const std::vector<double> typical = group.read("typical", {d});
  std::vector<StudyView::Parameter> parameters;
  for (std::size_t i = 0; i < d; ++i)
    parameters.push_back({names[i], units[i], logarithmic[i] != 0, spreads[i], typical[i]});
  return parameters;
}

std::vector<StudyView::Output> read_outputs(const Hdf5Group& group) {
  std::vector<StudyView::Output> outputs;
  for (const std::string& name : group.names())
    if (name != "status") outputs.push_back({name, group.read_attribute(name, "units")});
  return outputs;
}

StudySummary read_summary(const Hdf5Group& group, const StudyView& view) {
  const std::size_t d = view.parameters.size(), poses = view.values.size();
  const Hdf5Group bands = group.open("bands"), indices = group.open("indices");
  StudySummary summary;
  for (const StudyView::Output& output : view.outputs) {
    summary.bands.push_back(read_band(bands, output.name, poses));
    const StudyEffects& effects =
        summary.effects.emplace_back(read_effects(indices, output.name, d, poses));
    if (effects.total.size() != summary.effects.front().total.size())
      indices.fail(output.name + " has no Sobol indices, or alone has some, expected all alike");
  }
  summary.failures = read_failures(group.open("failures"), d, poses);
  return summary;
}

void read_study_head(const Hdf5Group& root, StudyView& view) {
  view.title = root.read_attribute("title");
  view.text = root.read_attribute("study");
  view.design = root.read_attribute("design");
  view.seed = number_in(root, "seed");
  view.samples = static_cast<long>(number_in(root, "samples"));
  view.points = static_cast<long>(number_in(root, "points"));
  const Hdf5Group scenes = root.open("scenes"), provenance = root.open("provenance");
  view.knees = scenes.read_texts("knee");
  view.scenes = scenes.read_texts("text");
  const std::vector<std::string> files = scenes.read_texts("file");
  if (view.scenes.empty() || files.empty()) scenes.fail("holds no scene");
  view.swept = quantity_of_sweep(parse_scene(view.scenes.front(), files.front()));
  view.program = provenance.read_attribute("program");
  view.created = provenance.read_attribute("created");
}

}  // namespace

bool is_study_file(const std::filesystem::path& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return false;
  try {
    const Hdf5Reader reader(path);
    const Hdf5Group root = reader.root();
    return root.has_attribute("format") &&
           root.read_attribute("format").starts_with("condyle study ");
  } catch (const DamagedFile&) {
    throw;
  } catch (const InputError&) {
    return false;
  }
}

StudyView read_study_file(const std::filesystem::path& path, ReadBy by) {
  const Hdf5Reader reader(path, by);
  return read_study_in(reader.root());
}

StudyView read_study_in(const Hdf5Group& root) {
  const std::string format = root.read_attribute("format");
  const std::string later = later_format(format, kStudyFormat);
  if (!later.empty()) root.fail(later);
  if (format != kStudyFormat)
    root.fail(fmt::format("format = \"{}\", expected \"{}\"", format, kStudyFormat));
  StudyView view;
  read_study_head(root, view);
  view.values = root.open("sweep").read("value").values;
  view.parameters = read_parameters(root.open("samples").open("parameters"));
  view.outputs = read_outputs(root.open("outputs"));
  view.all = read_summary(root, view);
  if (!root.has("knees")) return view;
  const Hdf5Group knees = root.open("knees");
  for (const std::string& knee : view.knees)
    view.by_knee.push_back(read_summary(knees.open(knee), view));
  return view;
}

}  // namespace condyle
