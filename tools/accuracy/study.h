#pragma once

/// The studies of tools/accuracy.sh. Each writes a CSV file into a folder and its part of the page.

#include <filesystem>
#include <string>

namespace condyle::accuracy {

/// Error of fitted patches against control points, degree and noise, on shapes known exactly.
[[nodiscard]] std::string study_surfaces(const std::filesystem::path& folder);

/// Newton's convergence, error against tolerance and time, and other solvers on the same equations.
[[nodiscard]] std::string study_solvers(const std::filesystem::path& folder);

/// The hard cases: status, iterations, residual, condition, error.
[[nodiscard]] std::string study_hard_cases(const std::filesystem::path& folder,
                                           const std::filesystem::path& root);

/// From meshes of the phantom to swept poses, against the same sweep on its exact surfaces.
[[nodiscard]] std::string study_whole_way(const std::filesystem::path& folder,
                                          const std::filesystem::path& root);

/// How the cost grows with poses, ligaments and contacts, and what each part of a scene costs.
[[nodiscard]] std::string study_costs(const std::filesystem::path& folder);

}  // namespace condyle::accuracy
