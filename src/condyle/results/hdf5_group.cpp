#include "condyle/results/hdf5_group.h"

#include <fmt/format.h>

#include <new>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/results/hdf5_calls.h"
#include "condyle/results/hdf5_own_data.h"
#include "condyle/results/hdf5_process.h"

namespace condyle {

Hdf5Answer Hdf5Group::ask(Hdf5Asked kind,
                          const std::string& name,
                          const std::string& attribute) const {
  return process_->ask({kind, number_, name, attribute});
}

std::string Hdf5Group::ask_text(Hdf5Asked kind,
                                const std::string& name,
                                const std::string& attribute) const {
  Hdf5Answer answer = ask(kind, name, attribute);
  return answer.texts.empty() ? "" : std::move(answer.texts.front());
}

void Hdf5Group::fail(const std::string& message) const {
  if (!process_ && hdf5::lacked_memory()) throw std::bad_alloc();
  throw InputError(fmt::format("{}: {}", place_, message));
}

Hdf5Handle Hdf5Group::checked(std::int64_t id,
                              Hdf5Handle::Close close,
                              const std::string& what) const {
  if (id < 0) fail(what);
  return {id, close};
}

void Hdf5Group::check(int status, const std::string& what) const {
  if (status < 0) fail(what);
}

bool Hdf5Group::has(const std::string& name) const {
  if (process_) return ask(Hdf5Asked::kHas, name).number != 0;
  if (memory_ != nullptr)
    return memory_->group(name) != nullptr || memory_->column(name) != nullptr;
  return H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5Group::has_attribute(const std::string& name) const {
  if (process_) return ask(Hdf5Asked::kHasAttribute, "", name).number != 0;
  return H5Aexists(handle_.id(), name.c_str()) > 0;
}

void Hdf5Group::check_link(const char* what, const std::string& name) const {
  if (!has(name)) fail(fmt::format("{} {} is missing", what, name));
  const std::string foreign = foreign_link(handle_.id(), name);
  if (!foreign.empty()) fail(fmt::format("{} {}", name, foreign));
}

bool Hdf5Group::is_group(const std::string& name) const {
  if (process_) return ask(Hdf5Asked::kIsGroup, name).number != 0;
  check_link("group", name);
  const Hdf5Handle object(H5Oopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Oclose);
  return H5Iget_type(object.id()) == H5I_GROUP;
}

std::vector<std::string> Hdf5Group::names() const {
  if (process_) return ask(Hdf5Asked::kNames, "").texts;
  std::vector<std::string> out;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Literate(handle_.id(), H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add, &out) >= 0)
    return out;
  out.clear();  // written by a program that keeps no order of creation
  check(H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &out),
        "cannot be listed");
  return out;
}

Hdf5Group Hdf5Group::create(const std::string& name) const {
  if (memory_ != nullptr) return {memory_->make_group(name), place_ + name + "/"};
  const Hdf5Handle properties = hdf5::ordered_group_properties(H5P_GROUP_CREATE);
  const hid_t id =
      H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT);
  return {checked(id, H5Gclose, fmt::format("group {} cannot be made", name)), place_ + name + "/"};
}

Hdf5Group Hdf5Group::open(const std::string& name) const {
  if (memory_ != nullptr) return {memory_->make_group(name), place_ + name + "/"};
  if (process_) return {process_, ask(Hdf5Asked::kOpen, name).number, place_ + name + "/"};
  check_link("group", name);
  const hid_t id = H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT);
  Hdf5Handle group = checked(id, H5Gclose, fmt::format("{} is no group", name));
  if (links_to(group.id()) != 1)
    fail(fmt::format("{} stands in the file at several places, expected a group of its own", name));
  return {std::move(group), place_ + name + "/"};
}

}  // namespace condyle
