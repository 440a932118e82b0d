#include "condyle/results/run_identity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "condyle/input_error.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

template <typename T>
std::uint64_t hash_numbers(const std::vector<T>& numbers, std::uint64_t hash) {
  const auto* bytes = reinterpret_cast<const char*>(numbers.data());
  return hash_bytes({bytes, numbers.size() * sizeof(T)}, hash);
}

std::uint64_t hash_patch(const PatchData& data, std::uint64_t hash) {
  hash = hash_numbers(std::vector<int>{data.degree[0], data.degree[1], data.nu, data.nv,
                                       data.orientation, data.mask_nu, data.mask_nv},
                      hash);
  hash = hash_numbers(data.knots_u, hash);
  hash = hash_numbers(data.knots_v, hash);
  hash = hash_numbers(data.control_points, hash);
  return hash_numbers(data.mask, hash);
}

/// Of the wraps that were fitted to bones.
std::uint64_t hash_wraps(const Scene& scene, std::uint64_t hash) {
  for (const WrapDescription& wrap : scene.wraps) {
    if (!wrap.fit) continue;
    std::vector<double> numbers;
    const auto add = [&](const auto& matrix) {
      numbers.insert(numbers.end(), matrix.data(), matrix.data() + matrix.size());
    };
    add(std::get<WrapEllipsoid>(wrap.shape).semi_axes);
    add(wrap.placement.R);
    add(wrap.placement.p);
    hash = hash_numbers(numbers, hash);
  }
  return hash;
}

bool close(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return std::abs(x - y) <= kSamePatch; });
}

bool close(const PatchData& a, const PatchData& b) {
  return a.degree == b.degree && a.nu == b.nu && a.nv == b.nv && a.orientation == b.orientation &&
         a.mask_nu == b.mask_nu && a.mask_nv == b.mask_nv && close(a.mask, b.mask) &&
         close(a.knots_u, b.knots_u) && close(a.knots_v, b.knots_v) &&
         std::equal(a.control_points.begin(), a.control_points.end(), b.control_points.begin(),
                    b.control_points.end(), [](const auto& p, const auto& q) {
                      return (p - q).cwiseAbs().maxCoeff() <= kSamePatch;
                    });
}

/// The first line of two texts that differs: "line 3 reads ... there".
std::string first_difference(const std::string& there, const std::string& here) {
  std::istringstream a(there), b(here);
  std::string line_a, line_b;
  for (int line = 1;; ++line) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a));
    const bool more_b = static_cast<bool>(std::getline(b, line_b));
    if (!more_a && !more_b) return "the ends of their lines differ";
    if (more_a && more_b && line_a == line_b) continue;
    const auto quoted = [](bool more, const std::string& text) {
      return more ? fmt::format("\"{}\"", text.substr(0, 80)) : std::string("missing");
    };
    return fmt::format("line {} is {} there and {} here", line, quoted(more_a, line_a),
                       quoted(more_b, line_b));
  }
}

}  // namespace

std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t hash) {
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3U;
  }
  return hash;
}

RunIdentity identity(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  RunIdentity identity{hash_bytes(scene.text), hash_bytes("")};
  for (const FittedSurface& surface : surfaces) {
    const auto* patch = dynamic_cast<const Patch*>(surface.surface.get());
    if (patch != nullptr) identity.surfaces = hash_patch(patch->data(), identity.surfaces);
  }
  identity.surfaces = hash_wraps(scene, identity.surfaces);
  return identity;
}

namespace {

void expect_same_wraps(const std::string& file, const Run& run, const Scene& scene) {
  for (std::size_t i = 0; i < scene.wraps.size(); ++i) {
    const WrapDescription &here = scene.wraps[i], &there = run.scene.wraps[i];
    if (!here.fit) continue;
    const double off = std::max({(here.placement.p - there.placement.p).cwiseAbs().maxCoeff(),
                                 (here.placement.R - there.placement.R).cwiseAbs().maxCoeff(),
                                 (std::get<WrapEllipsoid>(here.shape).semi_axes -
                                  std::get<WrapEllipsoid>(there.shape).semi_axes)
                                     .cwiseAbs()
                                     .maxCoeff()});
    if (!(off <= kSamePatch))
      throw InputError(
          fmt::format("{}: was computed with another ellipsoid for wrap \"{}\", expected the one "
                      "fitted now (the "
                      "mesh has changed, or the program)",
                      file, here.name));
  }
}

}  // namespace

void expect_same_scene(const std::string& file,
                       const Run& run,
                       const Scene& scene,
                       const std::vector<FittedSurface>& surfaces) {
  if (run.scene.text != scene.text) {
    throw InputError(fmt::format("{}: was computed from another scene, expected that of {}: {}",
                                 file, scene.file.string(),
                                 first_difference(run.scene.text, scene.text)));
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto* patch = dynamic_cast<const Patch*>(surfaces[i].surface.get());
    if (patch == nullptr) continue;
    const std::string& name = scene.surfaces[i].name;
    const RunPatch* there = patch_of(run, name);
    if (there == nullptr || !close(there->data, patch->data())) {
      throw InputError(fmt::format(
          "{}: was computed from another patch \"{}\", expected the one fitted now (the mesh has "
          "changed, or the program)",
          file, name));
    }
  }
  expect_same_wraps(file, run, scene);
}

}  // namespace condyle
