#include "condyle/results/study_identity.h"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/input_error.h"
#include "condyle/results/line_file.h"
#include "condyle/results/run_identity.h"
#include "condyle/version.h"

namespace condyle {
namespace {

constexpr std::string_view kStudyWords = "condyle study 1\n";
constexpr std::string_view kChecksum = "checksum";

std::uint64_t hash_numbers(const std::vector<double>& numbers, std::uint64_t hash) {
  return hash_bytes(
      {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)}, hash);
}

std::uint64_t hash_of_table(const StudyPlan& plan) {
  std::uint64_t hash = hash_bytes("");
  for (const std::vector<double>& row : plan.table) hash = hash_numbers(row, hash);
  return hash;
}

std::uint64_t hash_of_design(const StudyPlan& plan) {
  std::string words = fmt::format("{} {} {}", static_cast<int>(plan.study.design),
                                  plan.study.levels, plan.knees.size());
  for (const StudyParameter& parameter : plan.parameters) {
    const Spread& spread = parameter.spread;
    words += fmt::format("\n{} {} {} {} {}", parameter.name, static_cast<int>(spread.kind),
                         spread.sd, spread.bounds[0], spread.bounds[1]);
  }
  return hash_bytes(words);
}

std::uint64_t hash_of_meshes(const Scene& scene) {
  std::uint64_t hash = hash_bytes("");
  for (const BodyDescription& body : scene.bodies)
    if (body.mesh) hash = hash_bytes(bytes_of_file(body.mesh->path), hash);
  return hash;
}

/// simd.h has code for both.
std::uint64_t kind_of_processor() {
#if defined(__x86_64__) && defined(__GNUC__)
  return __builtin_cpu_supports("fma") ? 1 : 0;
#else
  return 0;
#endif
}

std::string head_line(const std::string& what, std::uint64_t hash) {
  return fmt::format("{} {:016x}\n", what, hash);
}

std::string lines_of(const StudyIdentity& identity) {
  std::string lines(kStudyWords);
  for (const auto& [what, hash] : identity) lines += head_line(what, hash);
  return lines;
}

/// "the scene knee.toml is not the one", "the surfaces of knee.toml are not those".
std::string not_the_same(const std::string& what) {
  for (const char* many : {"surfaces ", "meshes "})
    if (what.starts_with(many))
      return fmt::format("the {}of {} are not those", many,
                         what.substr(std::string_view(many).size()));
  return fmt::format("the {} is not the one", what);
}

}  // namespace

StudyIdentity study_identity(const StudyPlan& plan) {
  StudyIdentity identity = {
      {"study", hash_bytes(plan.study.text)},       {"seed", plan.study.seed},
      {"number of samples", plan.points},           {"design", hash_of_design(plan)},
      {"table of the design", hash_of_table(plan)}, {"program", hash_bytes(CONDYLE_VERSION)},
      {"kind of processor", kind_of_processor()}};
  for (const StudyKnee& knee : plan.knees) {
    std::string file = knee.scene.file.filename().string();
    std::replace(file.begin(), file.end(), '\n', '?');
    identity.emplace_back("scene " + file, hash_bytes(knee.scene.text));
    identity.emplace_back("meshes " + file, hash_of_meshes(knee.scene));
    identity.emplace_back("surfaces " + file,
                          condyle::identity(knee.scene, knee.surfaces).surfaces);
  }
  return identity;
}

std::string head_of(const StudyIdentity& identity) {
  std::string head = lines_of(identity);
  head += head_line(std::string(kChecksum), hash_bytes(head));
  head += '\n';
  return head;
}

bool begins_as_head(std::string_view bytes) { return bytes.starts_with(kStudyWords); }

std::size_t head_size(std::string_view bytes) {
  const std::size_t end = bytes.find("\n\n");
  if (!begins_as_head(bytes) || end == std::string_view::npos) return 0;
  const std::size_t last = bytes.rfind('\n', end - 1) + 1;
  const std::string expected = head_line(std::string(kChecksum), hash_bytes(bytes.substr(0, last)));
  return bytes.substr(last, end + 1 - last) == expected ? end + 2 : 0;
}

void expect_same_study(const std::string& file,
                       std::string_view head,
                       const StudyIdentity& identity) {
  std::string_view lines = head.substr(kStudyWords.size());
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format(
        "{}: {} that its chunks were computed from, expected the same or another output", file,
        what));
  };
  for (const auto& [what, hash] : identity) {
    const std::string line = head_line(what, hash);
    if (!lines.starts_with(line)) refuse(not_the_same(what));
    lines.remove_prefix(line.size());
  }
  if (!lines.starts_with(kChecksum)) refuse("the list of scenes is not the one");
}

}  // namespace condyle
