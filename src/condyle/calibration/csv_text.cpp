#include "condyle/calibration/csv_text.h"

namespace condyle {

std::string csv_text(std::string_view text) {
  const bool formula = !text.empty() && kGuardedStarts.find(text.front()) != text.npos;
  if (!formula && text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string cell = formula ? "\"'" : "\"";
  for (const char c : text) {
    cell += c;
    if (c == '"') cell += c;
  }
  return cell += '"';
}

}  // namespace condyle
