#include "condyle/contact/layer_lattice.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/surface/exact_charts.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kSpan = 2;             // [mm]
constexpr double kFine = 4;             // wide enough for a surface beside a smaller one [mm]
constexpr int kFewest = 8, kMost = 64;  // a small or a great surface has them finer or coarser

/// Knots of a direction within its domain, without repetitions. Spans between which a contact could lie, as a fit with
/// few control points has them, are divided.
std::vector<double> breaks(const std::vector<double>& knots, double min, double max) {
  const double widest = std::max(kFine, (max - min) / kMost);
  std::vector<double> all;
  for (const double t : knots) {
    if (t < min || t > max || (!all.empty() && t <= all.back())) continue;
    const double last = all.empty() ? t : all.back();
    const int parts = static_cast<int>(std::ceil((t - last) / widest));
    for (int k = 1; k < parts; ++k) all.push_back(last + (t - last) * k / parts);
    all.push_back(t);
  }
  return all;
}

/// The midpoint rule of a direction in equal cells of each span; shifted, its outermost points
/// stand for half a cell.
struct Midpoints {
  std::vector<double> t, width;

  Midpoints(const std::vector<double>& spans, int cells, bool shifted) {
    for (std::size_t k = 0; k + 1 < spans.size(); ++k) {
      const double h = (spans[k + 1] - spans[k]) / cells;
      for (int i = 0; i < cells; ++i) {
        const double before = i > 0 || k == 0 ? h : (spans[k] - spans[k - 1]) / cells;
        t.push_back(spans[k] + (i + (shifted ? 0.0 : 0.5)) * h);
        width.push_back(!shifted ? h : (i == 0 && k == 0 ? h / 2 : (h + before) / 2));
      }
    }
    if (!shifted) return;
    t.push_back(spans.back());
    width.push_back((spans.back() - spans[spans.size() - 2]) / cells / 2);
  }
};

/// 0 at the edge, 1 from `width` inside it, with continuous second derivative.
double faded(double edge, double width) {
  if (!(width > 0)) return edge > 0 ? 1 : 0;
  const double x = std::clamp(edge / width, 0.0, 1.0);
  return x * x * x * (10 - x * (15 - 6 * x));
}

void add_point(const Patch& patch,
               const Eigen::Vector2d& place,
               double cell,
               double fade,
               LayerLattice& lattice) {
  const double share = faded(patch.edge_distance(Patch::place(place.x(), place.y())), fade);
  if (!(share > 0)) return;
  const PatchDerivatives d = patch.derivatives(place.x(), place.y());
  const Vector3d normal = d.c_u.cross(d.c_v);
  const double area = normal.norm() * cell;
  lattice.x.push_back(d.c);
  lattice.n.emplace_back(patch.data().orientation * normal.normalized());
  lattice.area.push_back(share * area);
  lattice.faded.push_back((1 - share) * area);
  lattice.place.push_back(place);
}

void add_point(const ExactSurface& surface,
               const SurfaceChart::At& at,
               double cell,
               LayerLattice& lattice) {
  const double share = faded(surface.edge_distance({at.c}), kFade), area = at.stretch * cell;
  if (!(share * area > 0)) return;
  lattice.x.push_back(at.c);
  lattice.n.push_back(surface.evaluate_frame({at.c}).n);
  lattice.area.push_back(share * area);
  lattice.faded.push_back((1 - share) * area);
  lattice.place.emplace_back(Eigen::Vector2d::Zero());
}

void close_block(std::size_t first, LayerLattice& lattice) {
  LayerBlock block{first, lattice.x.size() - first};
  if (block.count == 0) return;
  for (std::size_t i = first; i < lattice.x.size(); ++i) block.center += lattice.x[i];
  block.center /= static_cast<double>(block.count);
  for (std::size_t i = first; i < lattice.x.size(); ++i)
    block.radius = std::max(block.radius, (lattice.x[i] - block.center).norm());
  lattice.blocks.push_back(block);
}

/// Cells of a rectangle in blocks of neighbours, in each of which four by four go together; `add` is
/// told u, v and the size of each.
template <typename Add>
void add_blocks(
    const Midpoints& u, const Midpoints& v, int chart, LayerLattice& lattice, const Add& add) {
  constexpr std::size_t kSide = 4;  // of a block, in cells
  for (std::size_t i0 = 0; i0 < u.t.size(); i0 += kSide)
    for (std::size_t j0 = 0; j0 < v.t.size(); j0 += kSide) {
      const std::size_t first = lattice.x.size();
      for (std::size_t k = 0; k < kSide * kSide; ++k) {
        const std::size_t i = i0 + k / 8 * 2 + k % 4 / 2, j = j0 + k % 8 / 4 * 2 + k % 2;
        if (i >= u.t.size() || j >= v.t.size()) continue;
        add(Eigen::Vector2d(u.t[i], v.t[j]), u.width[i] * v.width[j]);
        lattice.cell.resize(lattice.x.size(), {chart, static_cast<int>(i), static_cast<int>(j)});
      }
      close_block(first, lattice);
    }
}

/// Which of a list of cells each is.
class CellNumbers {
 public:
  explicit CellNumbers(const std::vector<std::array<int, 3>>& cells) {
    for (const auto& [chart, row, column] : cells) {
      if (chart >= std::ssize(grids_)) grids_.resize(static_cast<std::size_t>(chart) + 1);
      Grid& grid = grids_[static_cast<std::size_t>(chart)];
      grid.rows = std::max(grid.rows, row + 1);
      grid.columns = std::max(grid.columns, column + 1);
    }
    for (Grid& grid : grids_)
      grid.number.resize(
          static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns), kNone);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto& [chart, row, column] = cells[i];
      Grid& grid = grids_[static_cast<std::size_t>(chart)];
      grid.number[grid.at(row, column)] = static_cast<std::uint32_t>(i);
    }
  }

  /// `none` for a cell that is not in the list.
  [[nodiscard]] std::uint32_t operator()(const std::array<int, 3>& cell, std::uint32_t none) const {
    const auto& [chart, row, column] = cell;
    if (chart >= std::ssize(grids_)) return none;
    const Grid& grid = grids_[static_cast<std::size_t>(chart)];
    if (row >= grid.rows || column >= grid.columns) return none;
    const std::uint32_t number = grid.number[grid.at(row, column)];
    return number == kNone ? none : number;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Grid {
    int rows = 0, columns = 0;
    std::vector<std::uint32_t> number;
    [[nodiscard]] std::size_t at(int row, int column) const {
      return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(column);
    }
  };
  std::vector<Grid> grids_;
};

/// How wide the spans of a surface are; of one without bounds infinite.
double widest_span(const std::vector<SurfaceChart>& charts) {
  double widest = charts.empty() ? std::numeric_limits<double>::infinity() : 0;
  for (const SurfaceChart& chart : charts)
    widest = std::max(
        {widest, (chart.u_max - chart.u_min) / kMost, (chart.v_max - chart.v_min) / kMost});
  return widest;
}

std::vector<double> even_breaks(double min, double max) {
  const int spans =
      static_cast<int>(std::clamp<double>(std::ceil((max - min) / kSpan), kFewest, kMost));
  std::vector<double> all;
  for (int i = 0; i <= spans; ++i) all.push_back(min + (max - min) * i / spans);
  return all;
}

}  // namespace

LayerLattice layer_lattice(const Patch& patch, int per_span, bool shifted, double fade) {
  const PatchData& data = patch.data();
  const Midpoints u(breaks(data.knots_u, patch.u_min(), patch.u_max()), per_span, shifted),
      v(breaks(data.knots_v, patch.v_min(), patch.v_max()), per_span, shifted);
  LayerLattice lattice;
  add_blocks(u, v, 0, lattice, [&](const Eigen::Vector2d& place, double cell) {
    add_point(patch, place, cell, fade, lattice);
  });
  return lattice;
}

LayerLattice layer_lattice(const Surface& surface, int per_span, bool shifted) {
  if (const auto* patch = dynamic_cast<const Patch*>(&surface))
    return layer_lattice(*patch, per_span, shifted, kFade);
  LayerLattice lattice;
  const auto* exact = dynamic_cast<const ExactSurface*>(&surface);
  if (exact == nullptr) return lattice;
  int index = 0;
  for (const SurfaceChart& chart : exact->charts()) {
    const Midpoints u(even_breaks(chart.u_min, chart.u_max), per_span, shifted),
        v(even_breaks(chart.v_min, chart.v_max), per_span, shifted);
    add_blocks(u, v, index++, lattice, [&](const Eigen::Vector2d& place, double cell) {
      add_point(*exact, chart.at(place.x(), place.y()), cell, lattice);
    });
  }
  return lattice;
}

bool has_fine_lattice(const Surface& surface) {
  const auto* exact = dynamic_cast<const ExactSurface*>(&surface);
  return exact == nullptr || widest_span(exact->charts()) <= kFine;
}

LayerCorners layer_corners(const Surface& surface, int per_span, const LayerLattice& lattice) {
  const LayerLattice shifted = layer_lattice(surface, per_span, true);
  const CellNumbers corner_of(shifted.cell);
  LayerCorners corners;
  corners.points.reserve(shifted.x.size() + 1);
  for (std::size_t i = 0; i < shifted.x.size(); ++i) {
    const Vector3d &x = shifted.x[i], &n = shifted.n[i];
    corners.points.push_back({{x[0], x[1], x[2], shifted.area[i]}, {n[0], n[1], n[2], 0}});
  }
  corners.points.push_back({});
  corners.of_cell.reserve(lattice.cell.size());
  for (const auto& [chart, row, column] : lattice.cell) {
    std::array<std::uint32_t, 4>& of_cell = corners.of_cell.emplace_back();
    for (int k = 0; k < 4; ++k)
      of_cell[static_cast<std::size_t>(k)] =
          corner_of({chart, row + k / 2, column + k % 2}, corners.none());
  }
  return corners;
}

}  // namespace condyle
