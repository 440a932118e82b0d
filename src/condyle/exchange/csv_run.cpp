#include "condyle/exchange/csv_run.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "condyle/calibration/csv_text.h"
#include "condyle/exchange/run_table.h"

namespace condyle {

std::string csv_of_poses(const Run& run, const std::vector<ShownPose>& shown) {
  const SweptQuantity quantity = swept_quantity(run);
  const std::vector<TableColumn> columns = run_columns(run, shown);
  std::string text = std::string(kTableHead) + "quantity,name,component,value,unit\n";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double swept = quantity.shown(run.sweep.poses[shown[i].index].value);
    const std::string head = fmt::format("{},{},{},", shown[i].index, swept, quantity.unit.name);
    for (const TableColumn& column : columns) {
      if (!std::isfinite(column.values[i])) continue;
      fmt::format_to(std::back_inserter(text), "{}{},{},{},{},{}\n", head, column.quantity,
                     csv_text(column.name), csv_text(column.component), column.values[i],
                     column.unit);
    }
  }
  return text;
}

}  // namespace condyle
