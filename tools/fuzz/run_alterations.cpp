#include "fuzz/run_alterations.h"

#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <vector>

namespace condyle::fuzz {
namespace {

/// Closes what it holds.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

const std::vector<std::string>& whole_results() {
  static const std::vector<std::string> all = [] {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path folder =
        std::filesystem::path(CONDYLE_SOURCE_DIR) / "tests/fuzz/whole_results";
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> bytes;
    for (const std::filesystem::path& file : files) {
      std::ifstream stream(file, std::ios::binary);
      bytes.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    if (bytes.empty()) throw std::runtime_error("no results to alter");
    return bytes;
  }();
  return all;
}

/// Paths of all groups and datasets, the root first.
std::vector<std::string> objects(hid_t file) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5O_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, add, &names, H5O_INFO_BASIC);
  return names;
}

constexpr double kNumbers[] = {0,      1,      -1,  2,    3,   0.5,          1e300,
                               -1e300, 1e-300, 1e9, -1e9, 255, 2147483647.0, 1e19};

double number(Choices& choices) {
  const std::size_t which = choices.below(std::size(kNumbers) + 3);
  if (which < std::size(kNumbers)) return kNumbers[which];
  if (which == std::size(kNumbers)) return std::numeric_limits<double>::quiet_NaN();
  return which == std::size(kNumbers) + 1 ? std::numeric_limits<double>::infinity()
                                          : choices.byte() / 16.0;
}

const char* word(Choices& choices) {
  static const char* const kWords[] = {"",
                                       "condyle 1",
                                       "condyle study 1",
                                       "tie 0",
                                       "x",
                                       "\x1b[31m\nred",
                                       "\xff\xfe",
                                       "<script>alert(1)</script>",
                                       "99999999999999999999",
                                       "-1",
                                       "[sweep]",
                                       "../../etc/passwd"};
  return choices.of(kWords);
}

Id variable_text() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return {type, H5Tclose};
}

/// Some of the numbers of a dataset.
void change_numbers(hid_t dataset, Choices& choices) {
  const Id space(H5Dget_space(dataset), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count <= 0 || count > 100000) return;  // more of them in small chunks take HDF5 20 s
  std::vector<double> values(static_cast<std::size_t>(count));
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) return;
  const bool all = choices.once_in(3);
  const double value = number(choices);
  if (all) std::fill(values.begin(), values.end(), value);
  values[(choices.byte() * 256 + choices.byte()) % values.size()] = value;
  H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

void change_texts(hid_t dataset, Choices& choices) {
  const Id space(H5Dget_space(dataset), H5Sclose), type = variable_text();
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count <= 0 || count > 10000) return;
  const std::vector<const char*> words(static_cast<std::size_t>(count), word(choices));
  H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, words.data());
}

/// Another dataset under the same name: of another type, shape, or both; its attributes are lost but units.
void replace_dataset(hid_t file, const std::string& name, Choices& choices) {
  std::vector<hsize_t> shape;
  {
    const Id old(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Id space(H5Dget_space(old), H5Sclose);
    shape.resize(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  }
  constexpr hsize_t kSizes[] = {0,
                                1,
                                2,
                                3,
                                4,
                                1000,
                                100000,
                                hsize_t{1} << 31,
                                hsize_t{1} << 32,
                                hsize_t{1} << 61,
                                (hsize_t{1} << 61) + 1,
                                hsize_t{1} << 62};
  switch (choices.below(5)) {
    case 0:
      break;
    case 1:
      shape.push_back(choices.of(kSizes));
      break;
    case 2:
      if (!shape.empty()) shape.pop_back();
      break;
    default:
      if (!shape.empty()) shape[choices.below(shape.size())] = choices.of(kSizes);
  }
  const Id text = variable_text(), fixed(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(fixed, 7);
  const Id pair(H5Tcreate(H5T_COMPOUND, 16), H5Tclose);
  H5Tinsert(pair, "a", 0, H5T_NATIVE_DOUBLE);
  const Id list(H5Tvlen_create(H5T_NATIVE_DOUBLE), H5Tclose);
  const hid_t types[] = {H5T_IEEE_F64LE, H5T_STD_I32LE, H5T_STD_U64BE, H5T_IEEE_F32BE, text,
                         fixed,          pair,          list,          H5T_STD_REF_OBJ};
  const hid_t type = choices.of(types);
  const Id space(shape.empty()
                     ? H5Screate(H5S_SCALAR)
                     : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                 H5Sclose);
  const Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (!shape.empty() && choices.once_in(2)) {  // in pieces, of which none need be there
    const std::vector<hsize_t> piece(shape.size(), 1);
    H5Pset_chunk(properties, static_cast<int>(piece.size()), piece.data());
  }
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const Id made(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                H5Dclose);
}

void change_attribute(hid_t object, Choices& choices) {
  H5O_info_t info;
  if (H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS) < 0 || info.num_attrs == 0) return;
  char name[64] = "";
  const hsize_t index = choices.below(static_cast<std::size_t>(info.num_attrs));
  H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, index, name, sizeof name,
                     H5P_DEFAULT);
  const std::size_t kind = choices.below(4);
  const Id text = variable_text(), scalar(H5Screate(H5S_SCALAR), H5Sclose);
  if (kind == 0) {
    H5Adelete(object, name);
    return;
  }
  if (kind == 1) {
    const Id attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
    const Id space(H5Aget_space(attribute), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const std::vector<const char*> words(static_cast<std::size_t>(std::max<hssize_t>(count, 0)),
                                         word(choices));
    if (!words.empty()) H5Awrite(attribute, text, words.data());
    return;
  }
  H5Adelete(object, name);
  if (kind == 2) {
    const Id made(H5Acreate2(object, name, H5T_IEEE_F64LE, scalar, H5P_DEFAULT, H5P_DEFAULT),
                  H5Aclose);
    return;
  }
  const hsize_t three = 3;
  const Id row(H5Screate_simple(1, &three, nullptr), H5Sclose);
  const Id made(H5Acreate2(object, name, text, row, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
}

void alter_one(hid_t file, Choices& choices) {
  const std::vector<std::string> names = objects(file);
  const std::string& name = names[(choices.byte() * 256 + choices.byte()) % names.size()];
  const Id object(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
  const bool dataset = H5Iget_type(object) == H5I_DATASET;
  switch (choices.below(8)) {
    case 0:
      if (name != ".") H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      return;
    case 1: {
      const std::string& other = names[choices.byte() % names.size()];
      if (name == "." || other == ".") return;
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);  // and a link to something else in its place
      H5Lcreate_hard(file, other.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      return;
    }
    case 2:
      change_attribute(object, choices);
      return;
    case 3:
    case 4:
      if (dataset) replace_dataset(file, name, choices);
      return;
    default:
      if (!dataset) return;
      change_numbers(object, choices);
      if (choices.once_in(2)) change_texts(object, choices);
  }
}

}  // namespace

std::string altered_run(Choices& choices) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::string bytes = whole_results()[choices.below(whole_results().size())];
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 16, false);
  H5Pset_file_image(access, bytes.data(), bytes.size());
  const Id file(H5Fopen("altered.h5", H5F_ACC_RDWR, access), H5Fclose);
  if (file < 0) throw std::runtime_error("a whole result cannot be opened");
  for (std::size_t i = 1 + choices.below(3); i > 0; --i) alter_one(file, choices);
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  bytes.resize(static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0)));
  H5Fget_file_image(file, bytes.data(), bytes.size());
  return bytes;
}

}  // namespace condyle::fuzz
