/// Two scenes of one knee, in the same frames of the same meshes: how far the joint's frames and the
/// insertions of ligaments of one lie from the other's. One row of figures:
///
///   condyle_compare_scenes GIVEN MADE
///   femur: axes deg, origin mm; tibia: axes deg, origin mm; insertions: number, rms mm, worst mm, name of the worst

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "condyle/scene_file/read_scene.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// The bundle that a strand belongs to: those of the Lenhart and Clouthier knees by their names without
/// numbers, those of the phantom by the names that these have.
std::string bundle(const std::string& name) {
  static const std::map<std::string, std::string> phantom = {
      {"aACL", "ACL"},  {"pACL", "ACL"},  {"aPCL", "PCL"},   {"pPCL", "PCL"},  {"aMCL", "MCLs"},
      {"iMCL", "MCLs"}, {"pMCL", "MCLs"}, {"aDMCL", "MCLd"}, {"pDMCL", "MCLd"}};
  const auto known = phantom.find(name);
  if (known != phantom.end()) return known->second;
  std::string text = name;
  while (!text.empty() && std::isdigit(static_cast<unsigned char>(text.back()))) text.pop_back();
  if (text == "ACLam" || text == "ACLpl") return "ACL";
  if (text == "PCLal" || text == "PCLpm") return "PCL";
  return text;
}

/// Ends by strand, or by bundle as the mean of its strands: femur first.
using Ends = std::map<std::string, std::array<Vector3d, 2>>;

Ends ends_of(const Scene& scene, bool bundles) {
  Ends sums;
  std::map<std::string, int> counts;
  for (const LigamentDescription& ligament : scene.ligaments) {
    const std::string name = bundles ? bundle(ligament.name) : ligament.name;
    std::array<Vector3d, 2>& sum =
        sums.try_emplace(name, std::array<Vector3d, 2>{Vector3d::Zero(), Vector3d::Zero()})
            .first->second;
    for (const Attachment& end : ligament.ends)
      sum[end.body == scene.joint->femur.body ? 0 : 1] += end.at;
    ++counts[name];
  }
  for (auto& [name, ends] : sums)
    for (Vector3d& end : ends) end /= counts[name];
  return sums;
}

double largest_angle(const AnatomicalFrame& a, const AnatomicalFrame& b) {
  double largest = 0;
  for (const auto& [u, v] :
       {std::pair{a.lateral, b.lateral}, {a.anterior, b.anterior}, {a.proximal, b.proximal}})
    largest = std::max(largest, std::atan2(u.cross(v).norm(), u.dot(v)));
  return largest * 180 / M_PI;
}

std::string insertion_errors(const Scene& given, const Scene& made) {
  const auto shared = [](const Ends& a, const Ends& b) {
    return std::count_if(a.begin(), a.end(),
                         [&](const auto& entry) { return b.count(entry.first) > 0; });
  };
  const bool bundles = 2 * shared(ends_of(given, false), ends_of(made, false)) <
                       static_cast<long>(std::min(given.ligaments.size(), made.ligaments.size()));
  const Ends truth = ends_of(given, bundles), found = ends_of(made, bundles);
  double squares = 0, worst = 0;
  int count = 0;
  std::string name;
  for (const auto& [strand, ends] : truth) {
    const auto other = found.find(strand);
    if (other == found.end()) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      const double error = (ends[k] - other->second[k]).norm();
      squares += error * error;
      ++count;
      if (error > worst) worst = error, name = strand + (k == 0 ? " femur" : " tibia");
    }
  }
  if (count == 0) return "0 - - -";
  return fmt::format("{} {:.2f} {:.2f} {}", count, std::sqrt(squares / count), worst, name);
}

int run(const char* given_file, const char* made_file) {
  const Scene given = read_scene(given_file), made = read_scene(made_file);
  if (!given.joint || !made.joint) throw std::runtime_error("expected scenes with [joint]");
  for (const auto& [a, b] :
       {std::pair{given.joint->femur, made.joint->femur}, {given.joint->tibia, made.joint->tibia}})
    fmt::print("{:.1f} {:.1f} ", largest_angle(a, b), (a.origin - b.origin).norm());
  fmt::print("{}\n", insertion_errors(given, made));
  return 0;
}

}  // namespace
}  // namespace condyle

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: condyle_compare_scenes GIVEN MADE\n", stderr);
    return 1;
  }
  try {
    return condyle::run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "condyle_compare_scenes: %s\n", error.what());
    return 1;
  }
}
