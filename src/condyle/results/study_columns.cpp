#include "condyle/results/study_columns.h"

#include <algorithm>

#include "condyle/input_error.h"
#include "condyle/results/study_groups.h"

namespace condyle {

StudyColumns::StudyColumns(const std::filesystem::path& path, ReadBy by)
    : path_(std::filesystem::absolute(path)),
      state_(file_state(path)),
      reader_(path, by),
      view_(read_study_in(reader_.root())),
      outputs_(reader_.root().open("outputs")) {
  const Hdf5Group root = reader_.root();
  for (const std::string& name : root.names()) {
    if (name == "outputs")
      columns_.make_group(name).names = outputs_.names();
    else if (root.is_group(name))
      columns_.make_group(name) = read_columns(root.open(name));
    else
      columns_.add(name, read_column(root, name));
  }
}

void StudyColumns::read_output(const std::string& name) {
  ColumnTree& outputs = columns_.make_group("outputs");
  const bool there =
      std::find(outputs.names.begin(), outputs.names.end(), name) != outputs.names.end();
  if (!there || outputs.column(name) != nullptr) return;
  expect_unchanged();
  outputs.columns[name] = read_column(outputs_, name);
}

void StudyColumns::expect_unchanged() const {
  if (is_written_into(state_, file_state(path_)))
    throw InputError(path_.string() +
                     ": has been written into since it was opened, expected it as it was");
}

const ColumnTree& StudyColumns::tree_at(const std::string& place) {
  const std::string group = "outputs";
  if (place == group || place == group + "/")
    for (const std::string& name : columns_.group(group)->names) read_output(name);
  else if (place.starts_with(group + "/"))
    read_output(place.substr(group.size() + 1));
  return columns_;
}

std::shared_ptr<StudyColumns> open_study(const std::filesystem::path& path, ReadBy by) {
  return std::shared_ptr<StudyColumns>(new StudyColumns(path, by));
}

}  // namespace condyle
