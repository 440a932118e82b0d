/// Groups of a result as Python sees them, and columns as numpy arrays that look into them.

#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"

namespace condyle::python {
namespace {

struct Group {
  std::shared_ptr<const void> owner;
  const ColumnTree* tree;
  std::string place;  ///< "sweep/ligaments/aACL"
  long row;           ///< of columns with one for each pose; -1: all of them
  std::size_t poses;  ///< how many rows those columns have
};

/// Where the rows of a pose begin and end among those of all: the dataset `first` of a group, with one entry more than
/// there are poses.
const std::vector<int>* first_rows(const ColumnTree& tree) {
  const DataColumn* first = tree.column("first");
  return first == nullptr ? nullptr : std::get_if<std::vector<int>>(&first->values);
}

template <typename T>
py::object view(const std::shared_ptr<const void>& owner,
                const T* data,
                const std::vector<std::size_t>& shape) {
  const std::vector<py::ssize_t> sizes(shape.begin(), shape.end());
  auto* held = new std::shared_ptr<const void>(owner);
  const py::capsule base(
      held, [](void* pointer) { delete static_cast<std::shared_ptr<const void>*>(pointer); });
  py::array array(py::dtype::of<T>(), sizes, data, base);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::object texts(const std::vector<std::string>& all, std::size_t begin, std::size_t end) {
  py::tuple out(end - begin);
  for (std::size_t i = begin; i < end; ++i) out[i - begin] = py::str(all[i]);
  return out;
}

/// Values from row `begin` to `end`; of a single one that stays a row, without the first index.
py::object rows(const std::shared_ptr<const void>& owner,
                const DataColumn& column,
                std::size_t begin,
                std::size_t end,
                bool single) {
  std::vector<std::size_t> shape = column.shape;
  std::size_t width = 1;
  for (std::size_t k = 1; k < shape.size(); ++k) width *= shape[k];
  if (single)
    shape.erase(shape.begin());
  else if (!shape.empty())
    shape[0] = end - begin;
  return std::visit(
      [&](const auto& values) -> py::object {
        using T = typename std::decay_t<decltype(values)>::value_type;
        if constexpr (std::is_same_v<T, std::string>) {
          if (single) return py::str(values[begin]);
          return texts(values, begin, end);
        } else {
          const T* data = values.data() + begin * width;
          if (!shape.empty()) return view(owner, data, shape);
          if constexpr (std::is_same_v<T, double>)
            return py::float_(*data);
          else
            return py::int_(*data);
        }
      },
      column.values);
}

py::object whole(const Group& group, const DataColumn& column) {
  return rows(group.owner, column, 0, column.shape.empty() ? 1 : column.shape[0], false);
}

/// Of a column that has no row for each pose, all of it.
py::object row_of(const Group& group, const DataColumn& column) {
  const auto row = static_cast<std::size_t>(group.row);
  return column.shape[0] == group.poses && row < group.poses
             ? rows(group.owner, column, row, row + 1, true)
             : whole(group, column);
}

py::object column_of(const Group& group, const std::string& name, const DataColumn& column) {
  const bool of_parameters = name == "parameters" || name == "parameter_units";
  if (column.shape.empty() || group.row < 0 || of_parameters) return whole(group, column);
  const std::vector<int>* first = first_rows(*group.tree);
  if (first == nullptr || first->size() != group.poses + 1) return row_of(group, column);
  const auto row = static_cast<std::size_t>(group.row);
  if (name == "first") return py::int_(first->at(row));
  // Of a path its corners alone: touches have one row for each pose.
  const bool of_a_path = group.tree->column("touching") != nullptr;
  if (of_a_path && name != "points") return row_of(group, column);
  const long begin = first->at(row), end = first->at(row + 1);
  if (begin < 0 || end < begin || end > static_cast<long>(column.shape[0]))
    throw InputError(group.place + "/first: " + std::to_string(begin) + " to " +
                     std::to_string(end) + ", expected rows of " + name);
  return rows(group.owner, column, static_cast<std::size_t>(begin), static_cast<std::size_t>(end),
              false);
}

std::string inside(const std::string& place, const std::string& name) {
  return place.empty() ? name : place + "/" + name;
}

/// A null object where there is nothing of that name.
py::object find(const Group& group, const std::string& name) {
  if (const DataColumn* column = group.tree->column(name)) return column_of(group, name, *column);
  if (const ColumnTree* tree = group.tree->group(name)) {
    const std::string place = inside(group.place, name);
    const long row = place.ends_with("uncertainty/roughness") ? -1 : group.row;  // of surfaces
    return py::cast(Group{group.owner, tree, place, row, group.poses});
  }
  return {};
}

std::string none_such(const Group& group, const std::string& name) {
  if (name.starts_with("__")) return name;  // Python asks for many of its own
  return "\"" + name + "\" is not in " + (group.place.empty() ? "/" : group.place) +
         did_you_mean(name, group.tree->names);
}

py::object member_at(const Group& group, const std::string& place) {
  const std::size_t slash = place.find('/');
  const std::string name = place.substr(0, slash);
  if (name.empty() && slash != std::string::npos) return member_at(group, place.substr(1));
  py::object found = find(group, name);
  if (!found) throw py::key_error(none_such(group, name));
  if (slash == std::string::npos || slash + 1 == place.size()) return found;
  if (!py::isinstance<Group>(found))
    throw py::key_error("\"" + name + "\" is a dataset, expected a group");
  return member_at(py::cast<const Group&>(found), place.substr(slash + 1));
}

py::object attribute(const Group& group, const std::string& name) {
  py::object found = find(group, name);
  if (!found) throw py::attribute_error(none_such(group, name));
  return found;
}

py::list keys(const Group& group) {
  py::list names;
  for (const std::string& name : group.tree->names) names.append(name);
  return names;
}

py::list values(const Group& group) {
  py::list all;
  for (const std::string& name : group.tree->names) all.append(find(group, name));
  return all;
}

py::list items(const Group& group) {
  py::list all;
  for (const std::string& name : group.tree->names)
    all.append(py::make_tuple(name, find(group, name)));
  return all;
}

const DataColumn& dataset(const Group& group, const std::string& name) {
  const DataColumn* column = group.tree->column(name);
  if (column == nullptr) throw py::key_error(none_such(group, name));
  return *column;
}

py::tuple meaning(const Group& group, const std::string& name) {
  const DataColumn& column = dataset(group, name);
  const auto at = column.attributes.find("meaning");
  return at == column.attributes.end() ? py::tuple()
                                       : py::tuple(texts(at->second, 0, at->second.size()));
}

std::string group_repr(const Group& group) {
  std::string out = "<condyle.Group " + (group.place.empty() ? "/" : group.place) + ":";
  for (std::size_t i = 0; i < group.tree->names.size(); ++i)
    out += (i > 0 ? ", " : " ") + group.tree->names[i];
  return out + ">";
}

}  // namespace

py::object group_of(std::shared_ptr<const void> owner,
                    const ColumnTree& tree,
                    std::string place,
                    long row,
                    std::size_t poses) {
  return py::cast(Group{std::move(owner), &tree, std::move(place), row, poses});
}

py::object at_place(const std::shared_ptr<const void>& owner,
                    const ColumnTree& tree,
                    const std::string& place,
                    long row,
                    std::size_t poses) {
  return member_at(Group{owner, &tree, "", row, poses}, place);
}

void bind_columns(py::module_& m) {
  py::class_<Group> group(
      m, "Group",
      "A group of results, under the names of the HDF5 file (docs/results.md).\n\n"
      "Members are reached as group.force or group[\"force\"], those whose name is "
      "no word of Python by the\n"
      "latter: run.contacts[\"medial\"].force. A group within is a Group, numbers "
      "are numpy arrays, read-only and\n"
      "not copied, that keep the run alive; texts are tuples. Of a single pose, "
      "numbers are float or int.");
  only_returned(group);
  group.def("__getitem__", &member_at, py::arg("name"))
      .def("__getattr__", &attribute, py::arg("name"))
      .def("__contains__",
           [](const Group& g, const std::string& name) { return static_cast<bool>(find(g, name)); })
      .def("__len__", [](const Group& g) { return g.tree->names.size(); })
      .def("__iter__", [](const Group& g) { return py::iter(keys(g)); })
      .def("__dir__",
           [](const Group& g) {
             py::list names = keys(g);
             for (const char* own : {"keys", "values", "items", "units", "meaning"})
               names.append(own);
             return names;
           })
      .def("__repr__", &group_repr)
      .def("keys", &keys, "Names of its members.")
      .def("values", &values, "Its members.")
      .def("items", &items, "Pairs of a name and a member.")
      .def(
          "units", [](const Group& g, const std::string& name) { return dataset(g, name).units; },
          py::arg("name"), "The unit of a dataset: \"mm\", \"N\", \"deg\", \"1\".")
      .def("meaning", &meaning, py::arg("name"),
           "What the values 0, 1, 2 ... of a dataset mean; empty where they are numbers.");
}

}  // namespace condyle::python
