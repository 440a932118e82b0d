// Sobol's indices of Ishigami's function beside those of OpenTURNS on the same design: values,
// intervals, time; and what OpenTURNS costs a program that does nothing with it.

#include <fmt/format.h>
#include <link.h>
#include <sys/resource.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <openturns/JansenSensitivityAlgorithm.hxx>
#include <openturns/MartinezSensitivityAlgorithm.hxx>
#include <openturns/SaltelliSensitivityAlgorithm.hxx>
#include <string>
#include <vector>

#include "condyle/design/sample_design.h"
#include "condyle/study/sobol_indices.h"

namespace {

constexpr std::size_t kParameters = 3;
constexpr std::size_t kBlocks = kParameters + 2;
constexpr std::size_t kPoints = 4096;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// What the process has used before its first line.
void print_start() {
  const double seconds = processor_seconds();
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  int libraries = 0;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* count) {
        *static_cast<int*>(count) += info->dlpi_name[0] != '\0';
        return 0;
      },
      &libraries);
  fmt::print("before the first line: {:.0f} ms of processor time, {:.0f} MB, {} shared libraries\n",
             1e3 * seconds, static_cast<double>(used.ru_maxrss) / 1024, libraries);
}

double ishigami(const std::vector<double>& u) {
  const auto x = [&](std::size_t j) { return std::numbers::pi * (2 * u[j] - 1); };
  const double s1 = std::sin(x(0)), s2 = std::sin(x(1));
  return s1 + 7 * s2 * s2 + 0.1 * std::pow(x(2), 4) * s1;
}

/// By rows A B AB_1 ..., as condyle has them.
struct Design {
  std::vector<std::vector<double>> u;
  std::vector<double> y;
};

Design ishigami_design() {
  const condyle::SampleDesign points(
      {.kind = condyle::DesignKind::kSaltelli, .dimensions = kParameters, .points = kPoints});
  Design design;
  design.u.resize(points.size());
  for (std::uint64_t k = 0; k < points.size(); ++k) {
    points.point(k, design.u[k]);
    design.y.push_back(ishigami(design.u[k]));
  }
  return design;
}

void print_row(const std::string& who,
               const std::string& index,
               const std::vector<condyle::IndexEstimate>& estimates) {
  fmt::print("{:<22} {:<6}", who, index);
  for (const condyle::IndexEstimate& e : estimates)
    fmt::print("  {:7.4f} [{:7.4f}, {:7.4f}]", e.value, e.lower, e.upper);
  fmt::print("\n");
}

void print_ours(const Design& design) {
  const double start = processor_seconds();
  const condyle::SobolIndices indices =
      condyle::sobol_indices(design.y.data(), kPoints, kParameters, 1);
  const double seconds = processor_seconds() - start;
  print_row("condyle", "first", indices.first);
  print_row("condyle", "total", indices.total);
  fmt::print("{:<22} {:.2f} ms\n", "", 1e3 * seconds);
}

std::vector<condyle::IndexEstimate> estimates(const OT::Point& values,
                                              const OT::Interval& interval) {
  std::vector<condyle::IndexEstimate> list;
  for (std::size_t j = 0; j < kParameters; ++j)
    list.push_back({values[j], interval.getLowerBound()[j], interval.getUpperBound()[j]});
  return list;
}

/// Its order is block after block.
template <class Algorithm>
void print_peer(const std::string& who, const Design& design) {
  OT::Sample u(kBlocks * kPoints, kParameters), y(kBlocks * kPoints, 1);
  for (std::size_t row = 0; row < kPoints; ++row)
    for (std::size_t block = 0; block < kBlocks; ++block) {
      const std::size_t ours = row * kBlocks + block, theirs = block * kPoints + row;
      y(theirs, 0) = design.y[ours];
      for (std::size_t j = 0; j < kParameters; ++j) u(theirs, j) = design.u[ours][j];
    }
  const double start = processor_seconds();
  Algorithm algorithm(u, y, kPoints);
  algorithm.setUseAsymptoticDistribution(true);
  const auto first =
      estimates(algorithm.getFirstOrderIndices(), algorithm.getFirstOrderIndicesInterval());
  const auto total =
      estimates(algorithm.getTotalOrderIndices(), algorithm.getTotalOrderIndicesInterval());
  const double seconds = processor_seconds() - start;
  print_row(who, "first", first);
  print_row(who, "total", total);
  fmt::print("{:<22} {:.2f} ms\n", "", 1e3 * seconds);
}

}  // namespace

int main() {
  print_start();
  fmt::print("Ishigami's function, a = 7, b = 0.1, {} base points\n", kPoints);
  print_row("closed", "first",
            {{0.313905, 0.313905, 0.313905}, {0.442411, 0.442411, 0.442411}, {}});
  print_row("closed", "total",
            {{0.557589, 0.557589, 0.557589},
             {0.442411, 0.442411, 0.442411},
             {0.243684, 0.243684, 0.243684}});
  const Design design = ishigami_design();
  print_ours(design);
  print_peer<OT::SaltelliSensitivityAlgorithm>("OpenTURNS, Saltelli", design);
  print_peer<OT::JansenSensitivityAlgorithm>("OpenTURNS, Jansen", design);
  print_peer<OT::MartinezSensitivityAlgorithm>("OpenTURNS, Martinez", design);
}
