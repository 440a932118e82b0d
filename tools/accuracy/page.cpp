#include "accuracy/page.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace condyle::accuracy {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "processor of unknown name";
}

}  // namespace

std::string with_block(const std::string& page,
                       const std::string& name,
                       const std::string& content) {
  const std::string begin = "<!-- measured: " + name + " -->\n", end = "<!-- end -->";
  const std::size_t from = page.find(begin);
  const std::size_t to = from == std::string::npos ? from : page.find(end, from);
  if (to == std::string::npos) throw std::runtime_error("the page has no block " + name);
  return page.substr(0, from + begin.size()) + content + page.substr(to);
}

std::string machine() {
  const std::time_t now = std::time(nullptr);
  return fmt::format("Measured on {:%Y-%m-%d}: {}, {} cores, GCC {}.\n", *std::localtime(&now),
                     processor(), std::thread::hardware_concurrency(), __VERSION__);
}

}  // namespace condyle::accuracy
