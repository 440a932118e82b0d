#include "condyle/exchange/vtk_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <iterator>

#include "condyle/results/digest.h"

namespace condyle {
namespace {

/// The numbers behind their length in bytes, which is how VTK stores an array.
template <typename T>
std::string packed(const std::vector<T>& values) {
  const auto length = static_cast<std::uint32_t>(values.size() * sizeof(T));
  std::string bytes(sizeof length + length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  if (length > 0) std::memcpy(bytes.data() + sizeof length, values.data(), length);
  return base64(bytes);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string numbers(const std::string& name, std::size_t width, const std::vector<double>& values) {
  return fmt::format(
      "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}"
      "</DataArray>\n",
      escaped(name), width, packed(values));
}

std::string integers(const std::string& name, const std::vector<std::int32_t>& values) {
  return fmt::format("<DataArray type=\"Int32\" Name=\"{}\" format=\"binary\">{}</DataArray>\n",
                     name, packed(values));
}

/// Texts are codes of their bytes, each text ended by a zero.
std::string texts(const std::string& name, const std::vector<std::string>& values) {
  std::string out =
      fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">",
                  name, values.size());
  for (const std::string& value : values) {
    for (const char c : value)
      fmt::format_to(std::back_inserter(out), "{} ", static_cast<unsigned char>(c));
    out += "0 ";
  }
  return out + "</Array>\n";
}

std::string points(const std::vector<Eigen::Vector3d>& list) {
  std::vector<double> values;
  values.reserve(3 * list.size());
  for (const Eigen::Vector3d& p : list) values.insert(values.end(), p.data(), p.data() + 3);
  return "<Points>\n" + numbers("Points", 3, values) + "</Points>\n";
}

template <std::size_t N>
std::string cells(const std::string& kind, const std::vector<std::array<int, N>>& list) {
  std::vector<std::int32_t> connectivity, offsets;
  for (const auto& cell : list) {
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  return fmt::format("<{0}>\n{1}{2}</{0}>\n", kind, integers("connectivity", connectivity),
                     integers("offsets", offsets));
}

std::vector<std::array<int, 1>> each_point(std::size_t count) {
  std::vector<std::array<int, 1>> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back({static_cast<int>(i)});
  return list;
}

}  // namespace

std::string vtp_bytes(const VtkPolyData& data) {
  const bool bare = data.triangles.empty() && data.lines.empty();
  const std::size_t verts = bare ? data.points.size() : 0;
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<PolyData>\n<Piece "
      "NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      data.points.size(), verts, data.lines.size(), data.triangles.size());
  out += points(data.points);
  if (bare) out += cells("Verts", each_point(verts));
  if (!data.lines.empty()) out += cells("Lines", data.lines);
  if (!data.triangles.empty()) out += cells("Polys", data.triangles);
  out += "<PointData>\n";
  for (const VtkArray& array : data.point_data)
    out += numbers(array.name, array.width, array.values);
  out += "</PointData>\n<CellData>\n";
  for (const VtkArray& array : data.cell_data)
    out += numbers(array.name, array.width, array.values);
  if (!data.cell_names.empty()) out += texts("name", data.cell_names);
  return out + "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string pvd_bytes(const std::vector<VtkStep>& steps) {
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const VtkStep& step : steps) {
    fmt::format_to(std::back_inserter(out),
                   "<DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", step.time,
                   step.part, escaped(step.file));
  }
  return out + "</Collection>\n</VTKFile>\n";
}

}  // namespace condyle
